//! The faces and the points of intersections.

use selvedge::{Intersection, Scalar, Topology};
use selvedge_cloth::glam::DVec3;

/// Returns the pairs of faces that share a point of an intersection, each once, the smaller number first.
pub(crate) fn face_pairs(found: &[Intersection], topology: &Topology) -> Vec<[u32; 2]> {
    if found.is_empty() {
        return Vec::new();
    }
    let mut of_edges = vec![Vec::new(); topology.edges().len()];
    for (edges, face) in topology.triangle_edges().iter().zip(0_u32..) {
        let own = edges.iter().filter(|edge| **edge != Topology::NO_EDGE);
        own.for_each(|&edge| of_edges[edge as usize].push(face));
    }
    let mut pairs = Vec::new();
    for intersection in found {
        let (first, second) = match *intersection {
            Intersection::EdgeFace { edge, face } => (of_edges[edge as usize].clone(), vec![face]),
            Intersection::VertexFace { vertex, face } => {
                let faces = topology.triangles().iter().zip(0_u32..);
                let around = faces.filter(|(corners, _)| corners.contains(&vertex));
                (around.map(|(_, face)| face).collect(), vec![face])
            }
            Intersection::EdgeEdge { edges: [one, other] } => (of_edges[one as usize].clone(), of_edges[other as usize].clone()),
        };
        let all = first
            .iter()
            .flat_map(|&one| second.iter().map(move |&other| [one.min(other), one.max(other)]));
        pairs.extend(all.filter(|[one, other]| one != other));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Returns a point of each intersection. It is rounded; which pairs intersect is exact.
pub(crate) fn points<S: Scalar>(
    found: &[Intersection],
    topology: &Topology,
    positions: &[[S; 3]],
) -> impl Iterator<Item = [f64; 3]> {
    let at = |vertex: u32| DVec3::from(positions[vertex as usize].map(S::to_f64));
    found.iter().map(move |intersection| {
        let point = match *intersection {
            Intersection::EdgeFace { edge, face } => {
                let [from, to] = topology.edges()[edge as usize].map(at);
                let [a, b, c] = topology.triangles()[face as usize].map(at);
                let normal = (b - a).cross(c - a);
                let share = (a - from).dot(normal) / (to - from).dot(normal);
                // An edge in the plane of the face meets it in many points.
                from.lerp(to, if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 })
            }
            Intersection::VertexFace { vertex, .. } => at(vertex),
            Intersection::EdgeEdge { edges: [one, other] } => {
                let [ends, others] = [one, other].map(|edge| topology.edges()[edge as usize].map(at));
                nearest(ends, others)
            }
        };
        point.to_array()
    })
}

/// Returns the point of a segment that is nearest to another segment, if the two are not parallel; otherwise the end of one that
/// is nearest to an end of the other.
fn nearest([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> DVec3 {
    let (along, other, between) = (b - a, d - c, a - c);
    let (aa, ab, bb) = (along.dot(along), along.dot(other), other.dot(other));
    let share = (ab * other.dot(between) - bb * along.dot(between)) / (aa * bb - ab * ab);
    if share.is_finite() {
        return a.lerp(b, share.clamp(0.0, 1.0));
    }
    let ends = [a, b, c, d];
    let far = |end: &DVec3| {
        ends.iter()
            .filter(|one| *one != end)
            .map(|one| one.distance(*end))
            .fold(f64::INFINITY, f64::min)
    };
    ends.into_iter().min_by(|one, two| far(one).total_cmp(&far(two))).unwrap_or(a)
}
