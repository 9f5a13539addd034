//! Candidate vertex–face and edge–edge pairs, straight from hierarchies of moving boxes.
//!
//! Each vertex, edge and face has its box at the start and its box at the end of the step
//! ([`selvedge_core::boxes::moving`]). Two of them whose boxes keep one order along an axis cannot meet; the others are
//! candidates, unless they have a vertex in common. That holds for groups of them as well, so three hierarchies, over
//! vertices, edges and faces, find the candidates without looking at every pair: no triangle pairs, no distribution, no
//! pair twice.
//!
//! ```
//! use selvedge::{CandidateBoxes, CollisionDetector, Topology, glam::DVec3};
//!
//! // A small triangle falls through a large one.
//! let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?;
//! let mut start = vec![DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
//! start.extend([DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.1), DVec3::new(0.0, 1.0, 1.2)]);
//! let mut end = start.clone();
//! for vertex in &mut end[3..] {
//!     vertex.z -= 4.0;
//! }
//!
//! let mut detector = CollisionDetector::<f64>::new(topology);
//! let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
//! detector.candidates(&start, &end, CandidateBoxes::Moving, &mut vertex_face, &mut edge_edge)?;
//! vertex_face.sort();
//! assert_eq!(vertex_face, [[3, 0], [4, 0], [5, 0]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Which pairs
//! Exactly those that [relative boxes along three axes](selvedge_core::boxes::relative::three_axes) leave, of `f32` positions
//! and of `f64` positions that are `f32` numbers, unless the mesh is far from the origin for its size. Other `f64` positions are
//! [rounded to `f32`](selvedge_core::boxes::mapping) for the boxes: pairs that are apart by less than that are candidates too, none is lost.
//!
//! The order of the candidates depends on the hierarchies, and so on the steps before: the same sequence of steps gives the
//! same candidates in the same order, on any number of threads and every instruction set.

mod degradation;
mod hierarchies;
mod neighbours;
mod order;
mod over_meshes;
mod pairing;
mod pairs;
mod rows;
mod traversal;
mod tree;

pub use degradation::{Degradation, Prices};
pub(crate) use hierarchies::{Fit, Hierarchies, Share, mapping_within};
pub use neighbours::Neighbours;
pub use order::{Centre, LEAF, order};
pub(crate) use over_meshes::MeshHierarchy;
pub(crate) use pairing::Pairing;
pub(crate) use pairs::{CHUNK, Sink};
pub(crate) use rows::{RowSlices, Rows};
pub(crate) use traversal::{BlockPair, Scratch};

use crate::PairKind;
use crate::buffer::settle;
use crate::mesh::Topology;
use crate::parallel;
use crate::simd::Level;
use crate::step::{CollisionFilter, Step, StepError, check_length};
use selvedge_core::Position;
use selvedge_core::glam::DVec3;
use std::mem::swap;
use std::sync::Arc;

/// What a [`MovingBroadPhase`] has done so far. Counts do not depend on the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MovingStatistics {
    /// How often the hierarchies were built, the first time included.
    pub builds: usize,
    /// Tests of the last traversal, each of one box against sixteen.
    pub box_tests: u64,
    /// Candidates of the last traversal.
    pub candidates: usize,
}

/// Finds the vertex–face and edge–edge pairs that moving boxes leave; see the module.
///
/// On the rayon pool in which it is called; outside of one on the calling thread.
#[derive(Debug)]
pub struct MovingBroadPhase {
    pub(crate) hierarchies: Hierarchies,
    fit: Fit,
    collectors: Vec<Collector>,
}

/// One share of the work, and what it found.
#[derive(Debug)]
struct Collector {
    scratch: Scratch,
    pairs: Vec<[u32; 2]>,
    tests: u64,
    left_out: u64,
}

impl MovingBroadPhase {
    /// A broad phase for a mesh.
    #[must_use]
    pub fn new(topology: impl Into<Arc<Topology>>) -> Self {
        Self {
            hierarchies: Hierarchies::new(topology.into()),
            fit: Fit::default(),
            collectors: Vec::new(),
        }
    }

    /// Forces the instruction set; the best that the machine has is the default. Changes no result.
    pub const fn set_level(&mut self, level: Level) {
        self.hierarchies.set_level(level);
    }

    /// From the next update on: pairs that come within `separation` of each other are candidates too. Zero at first.
    ///
    /// # Errors
    /// If it is negative, infinite or NaN. Then it stays as it was.
    pub fn set_separation(&mut self, separation: f64) -> Result<(), StepError> {
        check_length(separation)?;
        self.fit.separation = separation;
        Ok(())
    }

    /// From the next update on: whether boxes that overlap at different times make a candidate, as swept boxes do, the common
    /// choice elsewhere. Off at first.
    pub const fn set_swept(&mut self, swept: bool) {
        self.fit.is_swept = swept;
    }

    /// From the next update on only pairs with a vertex that is `wanted` are candidates, one entry for each vertex of the mesh:
    /// pairs of cloth, say, and not those of bodies among themselves. What is found then does not depend on the steps before but for
    /// its order.
    ///
    /// # Panics
    /// At the next update, if there are fewer entries than vertices.
    pub fn set_wanted(&mut self, wanted: Vec<bool>) {
        self.hierarchies.set_wanted(wanted);
    }

    /// From the next update on these pairs are candidates only if they come within the [separation](Self::set_separation_of_neighbours) of
    /// their own, if that is smaller.
    ///
    /// # Panics
    /// At the next update, if they are of fewer vertices.
    pub(crate) fn set_neighbours(&mut self, neighbours: Option<Arc<Neighbours>>) {
        self.hierarchies.set_neighbours(neighbours);
    }

    /// From the next update on: the separation of [neighbours](Self::set_neighbours), if it is smaller than that of others.
    pub(crate) const fn set_separation_of_neighbours(&mut self, separation: f64) {
        self.fit.of_neighbours = separation;
    }

    /// From the next update on only pairs that the filter allows are candidates; `None`: all.
    pub(crate) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.hierarchies.set_filter(filter);
    }

    /// From the next update on only pairs with a `wanted` vertex are candidates, and only such vertices have moved since the last
    /// update. Hierarchies are not built then.
    pub fn narrow_to(&mut self, wanted: Vec<bool>) {
        self.hierarchies.narrow_to(wanted);
    }

    /// Builds the hierarchies from these positions if they have degraded, so that the next [`update`](Self::update) need not.
    pub(crate) fn build_if_degraded(&mut self, start: &[DVec3], end: &[DVec3]) {
        self.hierarchies.build_if_degraded(&Step::of_finite(start, end));
    }

    /// Takes the positions of a step. Builds the hierarchies in the first step and when they have degraded, refits them
    /// otherwise.
    ///
    /// They have degraded when the candidates found since they were built have cost more, beyond what they cost just after,
    /// than building them anew.
    ///
    /// # Errors
    /// If a frame's length is not the mesh's number of vertices, or a coordinate is NaN or infinite.
    pub fn update<P: Position>(&mut self, start: &[P], end: &[P]) -> Result<(), StepError> {
        let step = Step::checked(start, end, self.hierarchies.topology().vertex_count())?;
        self.hierarchies.update(&step, &self.fit);
        Ok(())
    }

    /// Replaces `vertex_face` and `edge_edge` by the candidates of the last update: vertex and face, or two edges, the smaller
    /// number first, as the topology numbers them.
    pub fn candidates(&mut self, vertex_face: &mut Vec<[u32; 2]>, edge_edge: &mut Vec<[u32; 2]>) {
        self.candidates_until(&|_| true, vertex_face, edge_edge);
    }

    /// As [`candidates`](Self::candidates), as long as `goes_on`, which is told of how many more pairs there are.
    pub(crate) fn candidates_until(
        &mut self,
        goes_on: &(dyn Fn(usize) -> bool + Sync),
        vertex_face: &mut Vec<[u32; 2]>,
        edge_edge: &mut Vec<[u32; 2]>,
    ) {
        let shares = self.hierarchies.shares();
        self.collectors.resize_with(shares, Collector::new);
        let hierarchies = &self.hierarchies;
        // The first share of each kind goes straight into the caller's list; on one thread that is all.
        let firsts = [0, shares / 2];
        swap(&mut self.collectors[firsts[0]].pairs, vertex_face);
        swap(&mut self.collectors[firsts[1]].pairs, edge_edge);
        parallel::for_each(&mut self.collectors, |index, collector| {
            collector.collect(hierarchies, hierarchies.share(index), goes_on);
        });
        swap(&mut self.collectors[firsts[0]].pairs, vertex_face);
        swap(&mut self.collectors[firsts[1]].pairs, edge_edge);
        for (index, collector) in self.collectors.iter_mut().enumerate() {
            if firsts.contains(&index) {
                continue;
            }
            let found = match self.hierarchies.share(index).kind {
                PairKind::VertexFace => &mut *vertex_face,
                PairKind::EdgeEdge => &mut *edge_edge,
            };
            found.extend_from_slice(&collector.pairs);
            settle(&mut collector.pairs);
        }
        settle(vertex_face);
        settle(edge_edge);
        let tests = self.collectors.iter().map(|collector| collector.tests);
        self.hierarchies.observe(tests.sum(), vertex_face.len() + edge_edge.len());
    }

    /// How many neighbours the last traversal left out, though they are within the separation of others.
    pub(crate) fn neighbours_left_out(&self) -> u64 {
        self.collectors.iter().map(|collector| collector.left_out).sum()
    }

    /// Counts of what was done.
    #[must_use]
    pub const fn statistics(&self) -> MovingStatistics {
        self.hierarchies.statistics()
    }
}

impl Collector {
    fn new() -> Self {
        Self {
            scratch: Scratch::new(),
            pairs: Vec::new(),
            tests: 0,
            left_out: 0,
        }
    }

    fn collect(&mut self, hierarchies: &Hierarchies, share: Share<'_>, goes_on: &(dyn Fn(usize) -> bool + Sync)) {
        self.pairs.clear();
        let mut collected = Collected {
            hierarchies,
            kind: share.kind,
            pairs: &mut self.pairs,
            goes_on,
        };
        let tests = hierarchies.visit(share, &mut self.scratch, &mut collected);
        self.tests = tests.unwrap_or(0);
        self.left_out = self.scratch.left_out;
    }
}

struct Collected<'a> {
    hierarchies: &'a Hierarchies,
    kind: PairKind,
    pairs: &'a mut Vec<[u32; 2]>,
    goes_on: &'a (dyn Fn(usize) -> bool + Sync),
}

impl Sink for Collected<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        if !(self.goes_on)(pairs.len()) {
            return false;
        }
        let in_mesh = |&pair| self.hierarchies.in_mesh(self.kind, pair);
        self.pairs.extend(pairs.iter().map(in_mesh));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows of points, as near each other as their curve is tight.
    fn strip(radius: f64) -> Vec<DVec3> {
        let at = |k: u32| {
            let (angle, side) = (f64::from(k / 2) / radius, f64::from(k % 2));
            DVec3::new(radius * angle.cos(), radius * angle.sin(), side)
        };
        (0..400).map(at).collect()
    }

    #[test]
    fn what_is_found_with_wanted_vertices_does_not_depend_on_the_steps_before() {
        let triangles = (0..398).map(|k| [k, k + 1, k + 2]).collect();
        let topology = Arc::new(Topology::new(400, triangles).unwrap());
        let found = |broad_phase: &mut MovingBroadPhase, positions: &[DVec3]| {
            let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
            broad_phase.update(positions, positions).unwrap();
            broad_phase.candidates(&mut vertex_face, &mut edge_edge);
            let in_order = (vertex_face.clone(), edge_edge.clone());
            vertex_face.sort_unstable();
            edge_edge.sort_unstable();
            (in_order, [vertex_face, edge_edge])
        };
        let of_all = || {
            let mut broad_phase = MovingBroadPhase::new(Arc::clone(&topology));
            broad_phase.set_wanted(vec![true; 400]);
            broad_phase
        };
        let (wide, tight) = (strip(100.0), strip(2.5));
        let (order, fresh) = found(&mut of_all(), &tight);
        assert!(fresh.iter().all(|pairs| !pairs.is_empty()));
        let mut old = of_all();
        found(&mut old, &wide);
        let (order_of_wide, later) = found(&mut old, &tight);
        assert!(order_of_wide != order, "hierarchies of the wide one");
        assert!(later == fresh);
    }
}
