//! Neighbours: pairs in one cloth whose boxes are near each other at rest already.
//!
//! On a fine mesh they are nearly all pairs within the thickness, and nothing has to push them apart: the cloth between them does. So they
//! have a smaller thickness, and candidates of theirs are looked for within less. Certificates hold them apart like any other pair.

use super::settings::{ContactSettings, NEIGHBOURS_AT_REST, Thickness};
use selvedge::PairKind;
use selvedge::Topology;
use selvedge::core::separation::closest::Closest;
use selvedge::verification::MovingBroadPhase;
use selvedge_core::glam::{DVec3, Vec3A};
use selvedge_core::separation::clearance::{are_boxes_within, nearness};
use selvedge_core::separation::largest_coordinate;
use std::sync::Arc;

/// Whether so many pairs in one cloth, vertices below `cloth_vertices`, are [so near](NEIGHBOURS_AT_REST) each other at rest that looking
/// them up costs less than it saves: more than there are edges.
pub(super) fn are_many(topology: &Arc<Topology>, rest: &[DVec3], cloth_vertices: usize, settings: &ContactSettings) -> bool {
    let Some(distance) = settings.of_cloths().iter().map(|own| at_rest(*own)).reduce(f64::max) else {
        return false;
    };
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
        vertices.iter().all(|&vertex| is_cloth(vertex)) && {
            let [one, .., other] = vertices.map(|v| v as u32);
            let distance = || Closest::of(kind, vertices.map(|v| rest[v])).distance();
            settings.are_of_one_cloth(one, other) && distance() < at_rest(settings.of_cloths()[settings.cloth_of(one)])
        }
    };
    let vertex_face = vertex_face.iter().map(|&pair| (PairKind::VertexFace, pair));
    let edge_edge = edge_edge.iter().map(|&pair| (PairKind::EdgeEdge, pair));
    let all = vertex_face.chain(edge_edge);
    let found = all.filter(|&(kind, pair)| near(kind, pair));
    let enough = topology.edges().len() + 1;
    found.take(enough).count() == enough
}

/// How near each other neighbours in a cloth are at rest, in metres.
pub(super) fn at_rest(own: Thickness) -> f64 {
    NEIGHBOURS_AT_REST * own.thickness
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
    /// Of each cloth: the vertex after its last one, and how near boxes of neighbours are at rest, rounded down.
    of_cloths: Vec<(u32, f32)>,
}

impl Neighbours {
    /// Pairs in one of the cloths, of each of which is told the vertex after its last one, whose boxes come within its distance at rest.
    pub(super) fn new(rest: &[DVec3], of_cloths: impl Iterator<Item = (u32, f64)>) -> Self {
        let largest = largest_coordinate(rest);
        let of_cloths: Vec<_> = of_cloths.map(|(end, distance)| (end, nearness(distance, largest))).collect();
        let cloth_vertices = of_cloths.last().map_or(0, |&(end, _)| end);
        let at_rest = |(vertex, rest): (usize, &DVec3)| {
            if vertex < cloth_vertices as usize {
                rest.as_vec3a()
            } else {
                Vec3A::NAN
            }
        };
        Self {
            rest: rest.iter().enumerate().map(at_rest).collect(),
            of_cloths,
        }
    }

    /// No pair.
    pub(super) const fn none() -> Self {
        Self {
            rest: Vec::new(),
            of_cloths: Vec::new(),
        }
    }

    #[inline(always)]
    pub(super) fn are(&self, kind: PairKind, vertices: [u32; 4]) -> bool {
        // Written out: `map` would not be inlined here.
        !self.rest.is_empty() && {
            let rest = |corner: usize| self.rest[vertices[corner] as usize];
            are_boxes_within(
                kind,
                [rest(0), rest(1), rest(2), rest(3)],
                self.within(vertices[0], vertices[3]),
            )
        }
    }

    /// How near two vertices' boxes are if they are neighbours': of no distance in different cloths.
    #[inline(always)]
    fn within(&self, one: u32, other: u32) -> f32 {
        if let [(_, only)] = self.of_cloths.as_slice() {
            return *only;
        }
        let cloth_of = |vertex: u32| self.of_cloths.partition_point(|&(end, _)| end <= vertex);
        let own = self.of_cloths.get(cloth_of(one)).filter(|_| cloth_of(one) == cloth_of(other));
        own.map_or(f32::NEG_INFINITY, |&(_, within)| within)
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
        let many = |thickness| {
            let mut settings = ContactSettings::new([count].into_iter());
            settings.keep_from_cloth(0, Thickness::of(thickness));
            are_many(&topology, &mesh.positions, count, &settings)
        };
        assert!(!many(0.003) && many(0.025));
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
            let are = |cloths: &[u32]| Neighbours::new(&rest, cloths.iter().map(|&end| (end, distance))).are(kind, [0, 1, 2, 3]);
            let found = are(&[cloth]);
            prop_assert_eq!(are(&[4]), are(&[4, 4]));
            prop_assert!(!are(&[of_first, 4]), "of two cloths");
            prop_assert!(!found || (cloth == 4 && are_neighbours(kind, rest, distance)));
            prop_assert!(found || cloth < 4 || !are_neighbours(kind, rest, distance - 1e-4));
            prop_assert!(!Neighbours::none().are(kind, [0, 1, 2, 3]));
        }
    }
}
