//! Neighbours: pairs in one cloth with boxes that are near each other at rest.
//!
//! On a fine mesh most pairs within the thickness are neighbours, and need no push: the cloth between them holds them apart. So
//! they have a smaller thickness, and a smaller distance within which to search for candidates. Certificates keep them apart like
//! any other pair.

use super::settings::{ContactSettings, NEIGHBOURS_AT_REST, Thickness};
use selvedge::PairKind;
use selvedge::Topology;
use selvedge::broad_phase::MovingBroadPhase;
use selvedge::core::separation::closest::ClosestPoints;
use selvedge_core::glam::DVec3;
use std::sync::Arc;

/// Returns whether more pairs of one cloth are [so near](NEIGHBOURS_AT_REST) each other at rest than cloths have edges. Then it
/// pays to look them up. The cloth's vertices are those below `cloth_vertices`.
pub(super) fn are_many(topology: &Arc<Topology>, rest: &[DVec3], cloth_vertices: usize, settings: &ContactSettings) -> bool {
    let Some(distance) = settings.of_cloths().iter().map(|own| at_rest(*own)).reduce(f64::max) else {
        return false;
    };
    let mut broad_phase = MovingBroadPhase::new(Arc::clone(topology));
    let is_cloth = |vertex: usize| vertex < cloth_vertices;
    broad_phase.set_wanted((0..rest.len()).map(is_cloth).collect());
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    if broad_phase.set_separation(distance).is_ok() && broad_phase.update(rest, rest).is_ok() {
        broad_phase.candidates(&mut vertex_face, &mut edge_edge);
    }
    let near = |kind: PairKind, pair: [u32; 2]| {
        let vertices = topology.vertices_of(kind, pair).map(|v| v as usize);
        vertices.iter().all(|&vertex| is_cloth(vertex)) && {
            let [one, .., other] = vertices.map(|v| v as u32);
            let distance = || ClosestPoints::from_points(kind, vertices.map(|v| rest[v])).distance();
            settings.are_of_one_cloth(one, other) && distance() < at_rest(settings.of_cloths()[settings.cloth_of(one)])
        }
    };
    let vertex_face = vertex_face.iter().map(|&pair| (PairKind::VertexFace, pair));
    let edge_edge = edge_edge.iter().map(|&pair| (PairKind::EdgeEdge, pair));
    let all = vertex_face.chain(edge_edge);
    let found = all.filter(|&(kind, pair)| near(kind, pair));
    let is_of_cloth = |edge: &&[u32; 2]| is_cloth(edge[0] as usize);
    let enough = topology.edges().iter().filter(is_of_cloth).count() + 1;
    found.take(enough).count() == enough
}

/// The distance at rest below which pairs of a cloth are neighbours, in metres.
pub(super) fn at_rest(own: Thickness) -> f64 {
    NEIGHBOURS_AT_REST * own.thickness
}

/// Returns whether the boxes of a pair come within `distance` of each other at rest: then the pair is one of neighbours.
pub(super) fn are_neighbours(kind: PairKind, rest: [DVec3; 4], distance: f64) -> bool {
    let [a, b, c, d] = rest;
    let (low, high, other_low, other_high) = match kind {
        PairKind::VertexFace => (a, a, b.min(c).min(d), b.max(c).max(d)),
        PairKind::EdgeEdge => (a.min(b), a.max(b), c.min(d), c.max(d)),
    };
    (low - other_high).max(other_low - high).cmple(DVec3::splat(distance)).all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::sleeve::sleeve;
    use proptest::prelude::*;
    use selvedge::broad_phase::Neighbours;

    #[test]
    fn neighbours_are_many_only_on_a_fine_mesh() {
        let mesh = sleeve(1).unwrap();
        let topology = Arc::new(mesh.topology().unwrap());
        let count = mesh.positions.len();
        let many = |thickness| {
            let mut settings = ContactSettings::new([count].into_iter());
            settings.keep_from_cloth(Thickness::new(thickness));
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
        }
    }
}
