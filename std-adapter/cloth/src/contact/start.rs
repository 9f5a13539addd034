//! Whether a mesh passes through itself, where a simulation starts.
//!
//! The certified pass keeps apart what is apart. It would never notice two surfaces that pass through each other far from any vertex
//! and any other edge: edges that pass through faces are asked for by themselves.

use selvedge::core::glam::DVec3;
use selvedge::{CollisionDetector, Intersection, Topology};
use std::sync::Arc;

/// An edge and a face that it meets, if a vertex of the one and a vertex of the other `are_asked` about; in words.
pub(super) fn first_crossing(
    topology: &Arc<Topology>,
    positions: &[DVec3],
    are_asked: impl Fn(u32, u32) -> bool,
) -> Option<String> {
    let mut detector = CollisionDetector::<f64>::new(Arc::clone(topology));
    let mut found = Vec::new();
    if let Err(error) = detector.intersections(positions, &mut found) {
        return Some(error.to_string());
    }
    found.into_iter().find_map(|intersection| {
        // Vertices and faces, and edges, are the pass's own.
        let Intersection::EdgeFace { edge, face } = intersection else {
            return None;
        };
        let [from, to] = topology.edges()[edge as usize];
        let [a, b, c] = topology.triangles()[face as usize];
        are_asked(from, a).then(|| format!("the pair of the edge {from}, {to} and the face {a}, {b}, {c}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_through_a_face_is_found_and_one_beside_it_is_not() {
        let topology = Arc::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).unwrap());
        let mut positions = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [1.0, 1.0, -1.0],
            [1.0, 1.0, 1.0],
            [1.2, 1.2, 5.0],
        ]
        .map(DVec3::from);
        let found = |positions: &[DVec3], asked| first_crossing(&topology, positions, |_, _| asked);
        let expected = "the pair of the edge 3, 4 and the face 0, 1, 2";
        assert_eq!(found(&positions, true).as_deref(), Some(expected));
        assert_eq!(found(&positions, false), None);
        (positions[3].x, positions[4].x) = (2.5, 2.5);
        assert_eq!(found(&positions, true), None);
    }

    #[test]
    fn neighbours_on_a_mesh_do_not_count_unless_they_pass_through_each_other() {
        let topology = Arc::new(Topology::new(5, vec![[0, 1, 2], [0, 3, 4]]).unwrap());
        let mut positions = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
        ]
        .map(DVec3::from);
        assert_eq!(first_crossing(&topology, &positions, |_, _| true), None);
        (positions[3], positions[4]) = (DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.0, 1.0, 1.0));
        assert!(first_crossing(&topology, &positions, |_, _| true).is_some());
    }
}
