//! Which primitive pairs may come close in a step: the only place that knows how candidates are found.
//!
//! They come from [hierarchies of moving boxes](crate::broad_phase::moving): along each axis every pair that is no candidate
//! keeps its order, and more than the thickness, between the start and the end of the step.

use super::pair::Pair;
use crate::PairKind;
use crate::broad_phase::moving::MovingBroadPhase;
use crate::mesh::{Topology, TopologyError};
use crate::simulation::plan::{FREE, Frame};
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
pub(super) struct Detector {
    topology: Arc<Topology>,
    wanted: Wanted,
    /// Of each vertex: whose motion it follows.
    carriers: Vec<Frame>,
    /// Vertices from here on are bodies'.
    cloth_vertices: usize,
    broad_phase: MovingBroadPhase<f64>,
    vertex_face: Vec<[u32; 2]>,
    edge_edge: Vec<[u32; 2]>,
    sorted: Vec<[u32; 2]>,
    places: Vec<u32>,
}

impl Detector {
    /// `triangles`: the cloth's, then the bodies'; `carriers` of each vertex; vertices from `cloth_vertices` on are bodies'.
    pub(super) fn new(
        triangles: &[[u32; 3]],
        carriers: &[Frame],
        cloth_vertices: usize,
        thickness: f64,
        wanted: Wanted,
    ) -> Result<Self, TopologyError> {
        let topology = Arc::new(Topology::new(carriers.len(), triangles.to_vec())?);
        let mut broad_phase = MovingBroadPhase::new(Arc::clone(&topology));
        let accepted = broad_phase.set_separation(thickness);
        // Bodies among themselves are of no interest.
        broad_phase.set_wanted((0..carriers.len()).map(|v| v < cloth_vertices).collect());
        debug_assert!(accepted.is_ok(), "scenes give a positive thickness");
        Ok(Self {
            topology,
            wanted,
            carriers: carriers.to_vec(),
            cloth_vertices,
            broad_phase,
            vertex_face: Vec::new(),
            edge_edge: Vec::new(),
            sorted: Vec::new(),
            places: Vec::new(),
        })
    }

    /// Replaces `pairs` by the candidates of the motion from `start` to `end`, in ascending order of their keys: whatever order
    /// the hierarchies find them in, which depends on the steps before.
    ///
    /// # Panics
    /// If a position is not finite.
    pub(super) fn candidates(&mut self, start: &[DVec3], end: &[DVec3], pairs: &mut Vec<Pair>) {
        let Self {
            topology,
            broad_phase,
            vertex_face,
            edge_edge,
            sorted,
            places,
            ..
        } = self;
        broad_phase
            .update(start, end)
            .expect("the solver keeps every position finite");
        broad_phase.candidates(vertex_face, edge_edge);
        sort(vertex_face, topology.vertex_count(), sorted, places);
        sort(edge_edge, topology.edges().len(), sorted, places);
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
    fn pair(&self, kind: PairKind, [first, second]: [u32; 2]) -> Option<Pair> {
        let vertices = kind.vertices([first, second], &self.topology);
        let last_of_first = match kind {
            PairKind::VertexFace => vertices[0],
            PairKind::EdgeEdge => vertices[1],
        };
        let body = match (self.body(last_of_first), self.body(vertices[3])) {
            (FREE, FREE) if self.wanted.cloth => FREE,
            (FREE, body) | (body, FREE) if body != FREE && self.wanted.bodies => body,
            _ => return None,
        };
        let [a, b, c, d] = vertices.map(|v| self.carriers[v as usize]);
        if a != FREE && a == b && a == c && a == d {
            return None;
        }
        let key = u64::from(kind == PairKind::EdgeEdge) << 63
            | u64::from(first) << 32
            | u64::from(second);
        Some(Pair::new(key, kind, vertices, body))
    }

    /// The body of a vertex; [`FREE`] for cloth, pinned or not.
    fn body(&self, vertex: u32) -> Frame {
        match vertex as usize {
            vertex if vertex < self.cloth_vertices => FREE,
            vertex => self.carriers[vertex],
        }
    }
}

/// Sorts pairs whose first numbers are below `count`: by counting, then each few with the same first number.
fn sort(
    pairs: &mut Vec<[u32; 2]>,
    count: usize,
    sorted: &mut Vec<[u32; 2]>,
    places: &mut Vec<u32>,
) {
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
    sorted
        .chunk_by_mut(|a, b| a[0] == b[0])
        .for_each(|same| same.sort_unstable());
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
