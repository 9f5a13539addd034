//! Which primitive pairs may come close in a step: the only place that knows how candidates are found.
//!
//! They come from [hierarchies of moving boxes](selvedge::verification::MovingBroadPhase), through a [sieve](super::sieve): every pair that is no
//! candidate keeps its order, and more than a distance, along some direction between the start and the end of the motion.

use super::candidate::Candidate;
use super::sieve::{Distances, Sieve};
use super::start::first_crossing;
use crate::step::{Carrier, FREE};
use selvedge::PairKind;
use selvedge::Topology;
use selvedge::verification::MovingBroadPhase;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use std::sync::Arc;

/// What is to be kept apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub(super) cloth: bool,
    pub(super) bodies: bool,
}

/// Finds candidates, with buffers that it keeps.
#[derive(Debug)]
pub(super) struct Search {
    topology: Arc<Topology>,
    wanted: Wanted,
    /// Whether the broad phase looks for pairs of a few vertices only.
    is_narrowed: bool,
    /// Of each vertex: whose motion it follows.
    carriers: Vec<Carrier>,
    /// Vertices from here on are bodies'.
    cloth_vertices: usize,
    broad_phase: MovingBroadPhase,
    sieve: Sieve,
    vertex_face: Vec<[u32; 2]>,
    edge_edge: Vec<[u32; 2]>,
    sorted: Vec<[u32; 2]>,
    places: Vec<u32>,
}

impl Search {
    /// Of each vertex its place at rest is in `rest`, its motion in `carriers`; vertices from `cloth_vertices` on are bodies'. Pairs that
    /// come within their thickness and what is looked for beyond it, along every direction, will be candidates.
    pub(super) fn new(
        topology: Arc<Topology>,
        rest: &[DVec3],
        carriers: &[Carrier],
        cloth_vertices: usize,
        distances: Distances,
        wanted: Wanted,
    ) -> Self {
        let mut broad_phase = MovingBroadPhase::new(Arc::clone(&topology));
        let reach = distances.thickness + distances.beyond;
        let accepted = broad_phase.set_separation(reach);
        debug_assert!(accepted.is_ok(), "scenes give a positive thickness");
        broad_phase.set_wanted(cloth(carriers.len(), cloth_vertices));
        Self {
            sieve: Sieve::new(rest, cloth_vertices, distances),
            topology,
            wanted,
            is_narrowed: false,
            carriers: carriers.to_vec(),
            cloth_vertices,
            broad_phase,
            vertex_face: Vec::new(),
            edge_edge: Vec::new(),
            sorted: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Forgets the steps before. When the hierarchies are built depends on them, and so do the candidates: those of a
    /// [few vertices](Self::candidates_of) are added to what is known, or replace it if there was a build.
    pub(super) fn forget(&mut self) {
        self.broad_phase.forget();
    }

    /// Replaces `pairs` by the candidates of the motion from `start` to `end`, in ascending order of their keys: whatever order
    /// the hierarchies find them in, which depends on the steps before.
    ///
    /// # Panics
    /// If a position is not finite.
    pub(super) fn candidates(&mut self, motion: [&[DVec3]; 2], pairs: &mut Vec<Candidate>) {
        if std::mem::take(&mut self.is_narrowed) {
            let all = cloth(self.carriers.len(), self.cloth_vertices);
            self.broad_phase.set_wanted(all);
        }
        self.update(motion);
        self.find(motion, None, pairs);
    }

    /// Replaces `pairs` by those with a vertex that is in `only`, the only ones whose motion is not that of the last search. Returns
    /// whether it is so; else all are there.
    ///
    /// # Panics
    /// If a position is not finite.
    pub(super) fn candidates_of(&mut self, only: &[bool], motion: [&[DVec3]; 2], pairs: &mut Vec<Candidate>) -> bool {
        let builds = self.broad_phase.statistics().builds;
        self.broad_phase.narrow_to(only.to_vec());
        self.is_narrowed = true;
        self.update(motion);
        // After a build the broad phase takes what a traversal costs for the measure of later ones: so that must be a whole one.
        let is_narrow = self.broad_phase.statistics().builds == builds;
        if is_narrow {
            self.find(motion, Some(only), pairs);
        } else {
            self.candidates(motion, pairs);
        }
        is_narrow
    }

    fn update(&mut self, [start, end]: [&[DVec3]; 2]) {
        let updated = self.broad_phase.update(start, end);
        updated.expect("the solver keeps every position finite");
    }

    fn find(&mut self, motion: [&[DVec3]; 2], only: Option<&[bool]>, pairs: &mut Vec<Candidate>) {
        let Self {
            topology,
            broad_phase,
            sieve,
            vertex_face,
            edge_edge,
            sorted,
            places,
            ..
        } = self;
        broad_phase.candidates(vertex_face, edge_edge);
        sieve.set_motion(motion, only);
        let counts = [topology.vertex_count(), topology.edges().len()];
        for (kind, found, count) in [
            (PairKind::VertexFace, &mut *vertex_face, counts[0]),
            (PairKind::EdgeEdge, &mut *edge_edge, counts[1]),
        ] {
            parallel::retain(found, |&pair| !sieve.keep_apart(kind, topology.vertices_of(kind, pair)));
            sort(found, count, sorted, places);
        }
        pairs.clear();
        for (kind, found) in [
            (PairKind::VertexFace, &self.vertex_face),
            (PairKind::EdgeEdge, &self.edge_edge),
        ] {
            pairs.extend(found.iter().filter_map(|&pair| self.pair(kind, pair)));
        }
    }

    /// The pair, unless nobody asked for it, or all of it follows one motion, which never changes it.
    #[inline(always)]
    fn pair(&self, kind: PairKind, [first, second]: [u32; 2]) -> Option<Candidate> {
        let vertices = self.topology.vertices_of(kind, [first, second]);
        let last_of_first = match kind {
            PairKind::VertexFace => vertices[0],
            PairKind::EdgeEdge => vertices[1],
        };
        let body = self.body_of_pair(last_of_first, vertices[3])?;
        let [a, b, c, d] = vertices.map(|v| self.carriers[v as usize]);
        if a != FREE && a == b && a == c && a == d {
            return None;
        }
        let key = u64::from(kind == PairKind::EdgeEdge) << 63 | u64::from(first) << 32 | u64::from(second);
        Some(Candidate::new(key, kind, vertices, body))
    }

    /// An edge that passes through a face, of those that are to be kept apart; in words.
    pub(super) fn first_crossing(&self, positions: &[DVec3]) -> Option<String> {
        first_crossing(&self.topology, positions, |a, b| self.body_of_pair(a, b).is_some())
    }

    /// The body of two vertices that are to be kept apart, [`FREE`] for cloth and cloth; `None` if nobody asked for that.
    #[inline(always)]
    fn body_of_pair(&self, one: u32, other: u32) -> Option<Carrier> {
        match (self.body(one), self.body(other)) {
            (FREE, FREE) if self.wanted.cloth => Some(FREE),
            (FREE, body) | (body, FREE) if body != FREE && self.wanted.bodies => Some(body),
            _ => None,
        }
    }

    /// The body of a vertex; [`FREE`] for cloth, pinned or not.
    fn body(&self, vertex: u32) -> Carrier {
        match vertex as usize {
            vertex if vertex < self.cloth_vertices => FREE,
            vertex => self.carriers[vertex],
        }
    }
}

/// Of each vertex whether it is of interest: bodies among themselves are not.
fn cloth(vertices: usize, cloth_vertices: usize) -> Vec<bool> {
    (0..vertices).map(|vertex| vertex < cloth_vertices).collect()
}

/// Sorts pairs whose first numbers are below `count`: by counting, then each few with the same first number.
fn sort(pairs: &mut Vec<[u32; 2]>, count: usize, sorted: &mut Vec<[u32; 2]>, places: &mut Vec<u32>) {
    places.clear();
    places.resize(count + 1, 0);
    for &[first, _] in &*pairs {
        places[first as usize + 1] += 1;
    }
    for first in 0..count {
        places[first + 1] += places[first];
    }
    sorted.clear();
    sorted.resize(pairs.len(), [0; 2]);
    for &pair in &*pairs {
        let place = &mut places[pair[0] as usize];
        sorted[*place as usize] = pair;
        *place += 1;
    }
    sorted.chunk_by_mut(|a, b| a[0] == b[0]).for_each(|same| same.sort_unstable());
    std::mem::swap(pairs, sorted);
}

#[cfg(test)]
mod tests {
    use super::sort;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pairs_come_out_sorted(mut pairs in prop::collection::vec([0..9_u32, 0..99_u32], 0..60)) {
            let mut expected = pairs.clone();
            expected.sort_unstable();
            sort(&mut pairs, 9, &mut Vec::new(), &mut Vec::new());
            prop_assert_eq!(pairs, expected);
        }
    }
}
