//! Whether triangles pass through each other, where a simulation starts.
//!
//! The certified pass keeps apart what is apart. It would never notice two surfaces that pass through each other far from any vertex
//! and any other edge. Two triangles without a common vertex have a point in common exactly if an edge of one of them meets the
//! other, and an edge is the way of a point that moves from one of its ends to the other: so the exact verdict on that point and the
//! face decides. Of triangles with a common vertex only the edges without it are asked about.

use selvedge::broad_phase::{BroadPhase, SweptBox};
use selvedge_core::boxes::mapping::image;
use selvedge_core::elementary::contact::{Contact, contact};
use selvedge_core::glam::DVec3;
use selvedge_core::{Motion, VertexFace};

/// An edge and a face that it meets, of two triangles that `are_asked` about; in words.
pub(super) fn first_crossing(
    triangles: &[[u32; 3]],
    positions: &[DVec3],
    are_asked: impl Fn(&[u32; 3], &[u32; 3]) -> bool,
) -> Option<String> {
    let boxes: Vec<SweptBox> = triangles
        .iter()
        .map(|triangle| around(&triangle.map(|v| positions[v as usize])))
        .collect();
    let mut broad_phase = BroadPhase::new();
    broad_phase.update(&boxes);
    let mut pairs = Vec::new();
    broad_phase.candidate_triangle_pairs(&mut pairs);
    pairs.into_iter().find_map(|[one, other]| {
        let [a, b] = [one, other].map(|triangle| &triangles[triangle as usize]);
        if !are_asked(a, b) {
            return None;
        }
        edge_through(a, b, positions).or_else(|| edge_through(b, a, positions))
    })
}

/// An edge of `triangle` that meets `face`, if it has no vertex in common with it.
fn edge_through(triangle: &[u32; 3], face: &[u32; 3], positions: &[DVec3]) -> Option<String> {
    let face_points = face.map(|v| positions[v as usize]);
    let bounds = around(&face_points);
    (0..3).find_map(|corner| {
        let [from, to] = [triangle[corner], triangle[(corner + 1) % 3]];
        if face.contains(&from) || face.contains(&to) {
            return None;
        }
        let ends = [from, to].map(|v| positions[v as usize]);
        if are_apart(&around(&ends), &bounds) {
            return None;
        }
        let pair = VertexFace {
            vertex: Motion::new(ends[0], ends[1]),
            face: face_points.map(Motion::resting),
        };
        let [a, b, c] = face;
        let meets = contact(&pair) != Contact::Never;
        meets.then(|| format!("the pair of the edge {from}, {to} and the face {a}, {b}, {c}"))
    })
}

/// The box of some points: rounded, which leaves it in no other order with others.
fn around(points: &[DVec3]) -> SweptBox {
    let lower = points.iter().fold(DVec3::INFINITY, |all, &p| all.min(p));
    let upper = points.iter().fold(DVec3::NEG_INFINITY, |all, &p| all.max(p));
    SweptBox {
        lower: lower.to_array().map(image),
        upper: upper.to_array().map(image),
    }
}

fn are_apart(a: &SweptBox, b: &SweptBox) -> bool {
    (0..3).any(|axis| a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_through_a_face_is_found_and_one_beside_it_is_not() {
        let triangles = [[0, 1, 2], [3, 4, 5]];
        let mut positions = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [1.0, 1.0, -1.0],
            [1.0, 1.0, 1.0],
            [1.2, 1.2, 5.0],
        ]
        .map(DVec3::from);
        let found = |positions: &[DVec3], asked| first_crossing(&triangles, positions, |_, _| asked);
        let expected = "the pair of the edge 3, 4 and the face 0, 1, 2";
        assert_eq!(found(&positions, true).as_deref(), Some(expected));
        assert_eq!(found(&positions, false), None);
        (positions[3].x, positions[4].x) = (2.5, 2.5);
        assert_eq!(found(&positions, true), None);
    }

    #[test]
    fn neighbours_on_a_mesh_do_not_count_unless_they_pass_through_each_other() {
        let triangles = [[0, 1, 2], [0, 3, 4]];
        let mut positions = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
        ]
        .map(DVec3::from);
        assert_eq!(first_crossing(&triangles, &positions, |_, _| true), None);
        (positions[3], positions[4]) = (DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.0, 1.0, 1.0));
        assert!(first_crossing(&triangles, &positions, |_, _| true).is_some());
    }
}
