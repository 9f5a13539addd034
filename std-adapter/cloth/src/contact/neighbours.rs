//! Neighbours: pairs of cloth whose boxes are near each other at rest already.
//!
//! On a fine mesh they are nearly all pairs within the thickness, and nothing has to push them apart: the cloth between them does. So they
//! have a smaller thickness, and candidates of theirs are looked for within less. Certificates hold them apart like any other pair.

use selvedge::PairKind;
use selvedge::Topology;
use selvedge::core::separation::closest::Closest;
use selvedge::verification::MovingBroadPhase;
use selvedge_core::glam::{DVec3, Vec3A};
use selvedge_core::separation::clearance::{are_boxes_within, nearness};
use selvedge_core::separation::largest_coordinate;
use std::sync::Arc;

/// Whether so many pairs of cloth, vertices below `cloth_vertices`, are nearer to each other than `distance` at rest that looking them
/// up costs less than it saves: more than there are edges.
pub(super) fn are_many(topology: &Arc<Topology>, rest: &[DVec3], cloth_vertices: usize, distance: f64) -> bool {
    let mut broad_phase = MovingBroadPhase::new(Arc::clone(topology));
    let is_cloth = |vertex: usize| vertex < cloth_vertices;
    let accepted = broad_phase.set_separation(distance);
    debug_assert!(accepted.is_ok(), "scenes give a positive thickness");
    broad_phase.set_wanted((0..rest.len()).map(is_cloth).collect());
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    if broad_phase.update(rest, rest).is_ok() {
        broad_phase.candidates(&mut vertex_face, &mut edge_edge);
    }
    let near = |kind: PairKind, pair: [u32; 2]| {
        let vertices = topology.vertices_of(kind, pair).map(|v| v as usize);
        vertices.iter().all(|&vertex| is_cloth(vertex)) && Closest::of(kind, vertices.map(|v| rest[v])).distance() < distance
    };
    let vertex_face = vertex_face.iter().map(|&pair| (PairKind::VertexFace, pair));
    let edge_edge = edge_edge.iter().map(|&pair| (PairKind::EdgeEdge, pair));
    let all = vertex_face.chain(edge_edge);
    let found = all.filter(|&(kind, pair)| near(kind, pair));
    let enough = topology.edges().len() + 1;
    found.take(enough).count() == enough
}

/// Whether the boxes of a pair come within `distance` of each other at rest: then it is one of neighbours.
pub(super) fn are_neighbours(kind: PairKind, rest: [DVec3; 4], distance: f64) -> bool {
    let [a, b, c, d] = rest;
    let (low, high, other_low, other_high) = match kind {
        PairKind::VertexFace => (a, a, b.min(c).min(d), b.max(c).max(d)),
        PairKind::EdgeEdge => (a.min(b), a.max(b), c.min(d), c.max(d)),
    };
    (low - other_high).max(other_low - high).cmple(DVec3::splat(distance)).all()
}

/// Which pairs are neighbours, for many of them.
#[derive(Debug)]
pub(super) struct Neighbours {
    /// Where vertices are at rest, in `f32`, NaN for bodies, which have no neighbours; empty if there are no neighbours at all.
    rest: Vec<Vec3A>,
    /// How near boxes of neighbours are at rest, rounded down.
    within: f32,
}

impl Neighbours {
    /// Pairs among vertices below `cloth_vertices` whose boxes come within `distance` at rest.
    pub(super) fn new(rest: &[DVec3], cloth_vertices: usize, distance: f64) -> Self {
        let at_rest = |(vertex, rest): (usize, &DVec3)| {
            if vertex < cloth_vertices {
                rest.as_vec3a()
            } else {
                Vec3A::NAN
            }
        };
        Self {
            rest: rest.iter().enumerate().map(at_rest).collect(),
            within: nearness(distance, largest_coordinate(rest)),
        }
    }

    /// No pair.
    pub(super) const fn none() -> Self {
        Self {
            rest: Vec::new(),
            within: f32::NEG_INFINITY,
        }
    }

    #[inline(always)]
    pub(super) fn are(&self, kind: PairKind, vertices: [u32; 4]) -> bool {
        // Written out: `map` would not be inlined here.
        !self.rest.is_empty() && {
            let rest = |corner: usize| self.rest[vertices[corner] as usize];
            are_boxes_within(kind, [rest(0), rest(1), rest(2), rest(3)], self.within)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sleeve::sleeve;
    use proptest::prelude::*;

    #[test]
    fn neighbours_are_many_only_on_a_fine_mesh() {
        let mesh = sleeve(1).unwrap();
        let topology = Arc::new(mesh.topology().unwrap());
        let count = mesh.positions.len();
        let many = |distance| are_many(&topology, &mesh.positions, count, distance);
        assert!(!many(0.006) && many(0.05));
    }

    proptest! {
        #[test]
        fn what_is_found_by_vertices_are_neighbours_and_none_of_a_body(
            rest in prop::array::uniform4(prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)),
            distance in 0.0..1.0_f64,
            bodies in 0..3_usize,
            is_edge in any::<bool>(),
        ) {
            let kind = if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace };
            let of_first = if is_edge { 2 } else { 1 };
            let cloth = [4, of_first, 0][bodies];
            let found = Neighbours::new(&rest, cloth, distance).are(kind, [0, 1, 2, 3]);
            prop_assert!(!found || (cloth == 4 && are_neighbours(kind, rest, distance)));
            prop_assert!(found || cloth < 4 || !are_neighbours(kind, rest, distance - 1e-4));
            prop_assert!(!Neighbours::none().are(kind, [0, 1, 2, 3]));
        }
    }
}
