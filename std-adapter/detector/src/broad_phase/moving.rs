//! The broad phase of a mesh: its hierarchies, and their candidates.

use super::hierarchies::{BoxFit, Hierarchies};
use super::neighbours::Neighbours;
use super::pairing::Pairing;
use super::pairs::Sink;
use super::statistics::MovingStatistics;
use super::traversal::{BlockPair, Scratch};
use crate::buffer::reserve_headroom;
use crate::mesh::Topology;
use crate::parallel;
use crate::simd::Level;
use crate::step::{CollisionFilter, Motions, Step, StepError, check_length};
use selvedge_core::Position;
use selvedge_core::glam::DVec3;
use std::mem::swap;
use std::sync::Arc;

/// Finds the vertex–face and edge–edge pairs that moving boxes leave; see the [module](crate::broad_phase).
///
/// It runs on the rayon pool of the caller, if there is one, and otherwise on the calling thread.
#[derive(Debug)]
pub struct MovingBroadPhase {
    pub(crate) hierarchies: Hierarchies,
    fit: BoxFit,
    /// The tasks of VF and EE pairs.
    tasks: [Vec<BlockPair>; 2],
    stack: Vec<BlockPair>,
    collectors: Vec<Collector>,
}

#[derive(Debug)]
struct Collector {
    scratch: Scratch,
    pairs: Vec<[u32; 2]>,
    tests: u64,
    left_out: u64,
}

impl MovingBroadPhase {
    /// Makes a broad phase for a mesh.
    #[must_use]
    pub fn new(topology: impl Into<Arc<Topology>>) -> Self {
        Self {
            hierarchies: Hierarchies::new(topology.into()),
            fit: BoxFit::default(),
            tasks: [Vec::new(), Vec::new()],
            stack: Vec::new(),
            collectors: Vec::new(),
        }
    }

    /// Forces the instruction set; the default is the best that the machine has. The results are the same.
    pub const fn set_level(&mut self, level: Level) {
        self.hierarchies.set_level(level);
    }

    /// Makes pairs that come within `separation` of each other candidates too, from the next update on. The default is zero.
    ///
    /// # Errors
    /// Returns an error if `separation` is negative, infinite or NaN. The old one then stays.
    pub fn set_separation(&mut self, separation: f64) -> Result<(), StepError> {
        check_length(separation)?;
        self.fit.separation = separation;
        Ok(())
    }

    /// Sets whether boxes that overlap at different times make a candidate, from the next update on. Such swept boxes are common
    /// elsewhere. The default is false.
    pub const fn set_swept(&mut self, swept: bool) {
        self.fit.is_swept = swept;
    }

    /// Finds only pairs with a `wanted` vertex from the next update on, such as pairs of cloth but not of bodies among
    /// themselves. There is one entry for each vertex. Earlier steps then only change the order of the candidates.
    ///
    /// # Panics
    /// The next update panics if there are fewer entries than vertices.
    pub fn set_wanted(&mut self, wanted: Vec<bool>) {
        self.hierarchies.set_wanted(wanted);
    }

    /// Makes these pairs candidates only within the [separation of neighbours](Self::set_separation_of_neighbours), if that is
    /// smaller.
    ///
    /// # Panics
    /// The next update panics if there are fewer vertices than in the mesh.
    pub(crate) fn set_neighbours(&mut self, neighbours: Option<Arc<Neighbours>>) {
        self.hierarchies.set_neighbours(neighbours);
    }

    /// Sets the separation of [neighbours](Self::set_neighbours) from the next update on, if it is smaller than that of others.
    pub(crate) const fn set_separation_of_neighbours(&mut self, separation: f64) {
        self.fit.of_neighbours = separation;
    }

    pub(crate) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.hierarchies.set_filter(filter);
    }

    /// Finds only pairs with a `wanted` vertex from the next update on. Only wanted vertices may have moved since the last
    /// update. The hierarchies are not built then.
    pub(crate) fn narrow_to(&mut self, wanted: Vec<bool>) {
        self.hierarchies.narrow_to(wanted);
    }

    /// Builds the hierarchies from these positions if they have degraded, so that the next [`update`](Self::update) need not.
    pub(crate) fn build_if_degraded(&mut self, start: &[DVec3], end: &[DVec3]) {
        self.hierarchies.build_if_degraded(&Step::of_finite(start, end));
    }

    /// Takes the positions of a step. Refits the hierarchies, or builds them in the first step and when they have degraded.
    ///
    /// Hierarchies have degraded when the searches since they were built have cost more than a new build, beyond what they would
    /// cost just after it.
    ///
    /// # Errors
    /// Returns an error if a frame's length is not the mesh's number of vertices, or a coordinate is NaN or infinite.
    pub fn update<P: Position>(&mut self, start: &[P], end: &[P]) -> Result<(), StepError> {
        let step = Step::checked(start, end, self.hierarchies.topology().vertex_count())?;
        let fit = self.fit;
        self.fit_boxes(&step, &fit);
        Ok(())
    }

    /// Takes the positions of a step as [`update`](Self::update) does, without a check: there is one for each vertex, and all are
    /// finite.
    pub(crate) fn update_finite(&mut self, start: &[DVec3], end: &[DVec3]) {
        let fit = self.fit;
        self.fit_boxes(&Step::of_finite(start, end), &fit);
    }

    pub(crate) fn fit_boxes(&mut self, motions: &dyn Motions, fit: &BoxFit) {
        self.hierarchies.fit_boxes(motions, fit);
    }

    /// Replaces `vertex_face` and `edge_edge` by the candidates of the last update. They are numbered as in the topology: vertex
    /// and face, or two edges with the smaller number first.
    pub fn candidates(&mut self, vertex_face: &mut Vec<[u32; 2]>, edge_edge: &mut Vec<[u32; 2]>) {
        self.candidates_until(&|_| true, vertex_face, edge_edge);
    }

    /// Finds [candidates](Self::candidates) until `continues` returns false. Its argument is the number of pairs that come next.
    pub(crate) fn candidates_until(
        &mut self,
        continues: &(dyn Fn(usize) -> bool + Sync),
        vertex_face: &mut Vec<[u32; 2]>,
        edge_edge: &mut Vec<[u32; 2]>,
    ) {
        let pairings = Pairing::all_within(&self.hierarchies);
        let mut tests = 0;
        for (pairing, tasks) in pairings.iter().zip(&mut self.tasks) {
            tasks.clear();
            tests += pairing.find_tasks(&mut self.stack, tasks);
            reserve_headroom(tasks);
        }
        // With many shares, a slow one does not keep the other threads waiting.
        let shares = match parallel::threads() {
            1 => 1,
            threads => SHARES * threads,
        };
        self.collectors.resize_with(2 * shares, Collector::new);
        let lists = [&mut *vertex_face, &mut *edge_edge];
        let of_kinds = self.collectors.chunks_mut(shares);
        // The first share of each kind writes into the caller's list: on one thread that is all.
        for (collectors, list) in of_kinds.zip(lists) {
            swap(&mut collectors[0].pairs, list);
        }
        let tasks = &self.tasks;
        parallel::for_each(&mut self.collectors, |index, collector| {
            let (kind, share) = (index / shares, index % shares);
            let place = |share: usize| tasks[kind].len() * share / shares;
            collector.collect(&pairings[kind], &tasks[kind][place(share)..place(share + 1)], continues);
        });
        let mut candidates = 0;
        let lists = [vertex_face, edge_edge];
        for (collectors, list) in self.collectors.chunks_mut(shares).zip(lists) {
            swap(&mut collectors[0].pairs, list);
            for collector in &mut collectors[1..] {
                list.extend_from_slice(&collector.pairs);
                reserve_headroom(&mut collector.pairs);
            }
            reserve_headroom(list);
            candidates += list.len();
            tests += collectors.iter().map(|collector| collector.tests).sum::<u64>();
        }
        self.hierarchies.observe(tests, candidates);
    }

    /// Returns how many neighbours the last traversal left out, though they are within the separation of others.
    pub(crate) fn neighbours_left_out(&self) -> u64 {
        self.collectors.iter().map(|collector| collector.left_out).sum()
    }

    /// Returns counts of the work so far.
    #[must_use]
    pub const fn statistics(&self) -> MovingStatistics {
        self.hierarchies.statistics()
    }
}

/// The number of shares of a traversal for each thread and kind.
const SHARES: usize = 16;

impl Collector {
    fn new() -> Self {
        Self {
            scratch: Scratch::new(),
            pairs: Vec::new(),
            tests: 0,
            left_out: 0,
        }
    }

    fn collect(&mut self, pairing: &Pairing<'_>, tasks: &[BlockPair], continues: &(dyn Fn(usize) -> bool + Sync)) {
        self.pairs.clear();
        let mut collected = Collected {
            pairing,
            pairs: &mut self.pairs,
            continues,
        };
        self.tests = pairing.visit(tasks, &mut self.scratch, &mut collected).unwrap_or(0);
        self.left_out = self.scratch.left_out;
    }
}

struct Collected<'a> {
    pairing: &'a Pairing<'a>,
    pairs: &'a mut Vec<[u32; 2]>,
    continues: &'a (dyn Fn(usize) -> bool + Sync),
}

impl Sink for Collected<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        if !(self.continues)(pairs.len()) {
            return false;
        }
        let [hierarchies, _] = self.pairing.meshes;
        let in_mesh = |&pair| hierarchies.in_mesh(self.pairing.kind, pair);
        self.pairs.extend(pairs.iter().map(in_mesh));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns two rows of points; the tighter their curve, the nearer they are to each other.
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
