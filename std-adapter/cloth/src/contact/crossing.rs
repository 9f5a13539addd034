//! Surfaces that pass through each other: the exact test finds which edges meet which faces.
//!
//! The certified pass keeps apart pairs that are apart. It would never notice two surfaces that pass through each other far from
//! any vertex and any other edge. So the detector's [exact test](CollisionDetector::intersections) looks for edges that meet
//! faces.

use super::candidate::Candidate;
use selvedge::core::glam::DVec3;
use selvedge::{CollisionDetector, Intersection, PairKind, StepError, Topology};
use std::fmt;
use std::sync::Arc;

/// An edge and a face that have a point, but no vertex, in common.
///
/// Neighbours that are folded flat onto each other may touch without such an edge and face. So may pairs that are nearer than
/// rounding can distinguish. Then the edge is a vertex, (v, v), or the face an edge, (a, b, b).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The vertices of the edge, those of bodies after the cloth's.
    pub edge: [u32; 2],
    /// The vertices of the face.
    pub face: [u32; 3],
    /// The point where they meet, in metres.
    pub point: DVec3,
    /// The body that one of them belongs to; `None` if both are cloth.
    pub body: Option<usize>,
}

/// Names both by their vertices, as in `the edge 3, 4 and the face 0, 1, 2`.
impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} and {}", in_words(&self.edge), in_words(&self.face))
    }
}

/// Names a vertex, an edge or a face by its vertices, of which the last may be there twice.
fn in_words(vertices: &[u32]) -> String {
    let mut vertices = vertices.to_vec();
    vertices.dedup();
    let kind = ["vertex", "edge", "face"][vertices.len() - 1];
    let numbers: Vec<_> = vertices.iter().map(u32::to_string).collect();
    format!("the {kind} {}", numbers.join(", "))
}

/// The name of a pair in the lists of candidates.
pub(crate) type PairKey = (PairKind, [u32; 2]);

/// Finds what meets; its hierarchies are used again.
#[derive(Debug)]
pub(super) struct CrossingFinder {
    detector: CollisionDetector<f64>,
    found: Vec<Intersection>,
}

impl CrossingFinder {
    pub(super) fn new(topology: &Arc<Topology>) -> Self {
        Self {
            detector: CollisionDetector::new(Arc::clone(topology)),
            found: Vec::new(),
        }
    }

    /// The edges and faces that meet at `positions`, in ascending order, if a vertex of one and a vertex of the other pass
    /// `are_asked`.
    pub(super) fn find(
        &mut self,
        positions: &[DVec3],
        are_asked: impl Fn(u32, u32) -> bool,
    ) -> Result<&[Intersection], StepError> {
        let Self { detector, found } = self;
        detector.intersections(positions, found)?;
        found.retain(|own| {
            let (edge, face) = edge_and_face(detector.topology(), own);
            are_asked(edge[0], face[0])
        });
        Ok(found)
    }
}

/// The vertices of both, in the form of [`Crossing`].
fn edge_and_face(topology: &Topology, intersection: &Intersection) -> ([u32; 2], [u32; 3]) {
    let edge = |edge: u32| topology.edges()[edge as usize];
    let face = |face: u32| topology.triangles()[face as usize];
    match *intersection {
        Intersection::EdgeFace { edge: own, face: other } => (edge(own), face(other)),
        Intersection::VertexFace { vertex, face: other } => ([vertex; 2], face(other)),
        Intersection::EdgeEdge { edges: [own, other] } => {
            let [a, b] = edge(other);
            (edge(own), [a, b, b])
        }
    }
}

impl Crossing {
    /// Makes the crossing of two primitives of the cloth that meet.
    pub(super) fn new(topology: &Topology, intersection: &Intersection, positions: &[DVec3]) -> Self {
        let (edge, face) = edge_and_face(topology, intersection);
        let point = |vertex: u32| positions[vertex as usize];
        Self {
            edge,
            face,
            point: meeting_point(edge.map(point), face.map(point)),
            body: None,
        }
    }

    /// Makes the crossing of a pair that is nearer than rounding can distinguish.
    pub(super) fn of_touching(pair: &Candidate, positions: &[DVec3]) -> Self {
        let [a, b, c, d] = pair.vertices;
        let (edge, face) = match pair.kind {
            PairKind::VertexFace => ([a, a], [b, c, d]),
            PairKind::EdgeEdge => ([a, b], [c, d, d]),
        };
        let closest = pair.closest(positions);
        let of_first = closest
            .weights
            .into_iter()
            .zip(pair.vertices)
            .filter(|(weight, _)| *weight > 0.0);
        Self {
            edge,
            face,
            point: of_first.map(|(weight, vertex)| positions[vertex as usize] * weight).sum(),
            body: pair.data.is_with_body().then_some(pair.data.body as usize),
        }
    }
}

/// Returns where an edge meets the plane of a face, as a share of the way from its first end to its second. An edge in the plane
/// gives one half.
pub(super) fn share_to_plane([a, b]: [DVec3; 2], [c, d, e]: [DVec3; 3]) -> f64 {
    let normal = (d - c).cross(e - c);
    let [above, below] = [normal.dot(a - c), normal.dot(b - c)];
    let share = above / (above - below);
    if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 }
}

/// Returns the point of the edge in the face; of two edges, (c, d, d), that in the plane through (c, d) that both cross upright.
fn meeting_point([a, b]: [DVec3; 2], [c, d, e]: [DVec3; 3]) -> DVec3 {
    let third = if d == e { c + (b - a).cross(d - c) } else { e };
    a.lerp(b, share_to_plane([a, b], [c, d, third]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossings(positions: &[DVec3], triangles: Vec<[u32; 3]>, are_asked: bool) -> Vec<Crossing> {
        let topology = Arc::new(Topology::new(positions.len(), triangles).unwrap());
        let mut finder = CrossingFinder::new(&topology);
        let found = finder.find(positions, |_, _| are_asked).unwrap();
        found.iter().map(|own| Crossing::new(&topology, own, positions)).collect()
    }

    #[test]
    fn an_edge_through_a_face_is_found_with_its_place_and_one_beside_it_is_not() {
        let mut positions = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [1.0, 1.0, -1.0],
            [1.0, 1.0, 3.0],
            [1.2, 1.2, 5.0],
        ]
        .map(DVec3::from);
        let found = |positions: &[DVec3], are_asked| crossings(positions, vec![[0, 1, 2], [3, 4, 5]], are_asked);
        let first = found(&positions, true)[0];
        assert_eq!((first.edge, first.face, first.body), ([3, 4], [0, 1, 2], None));
        assert_eq!(first.point, DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(found(&positions, false), []);
        (positions[3].x, positions[4].x) = (2.5, 2.5);
        assert_eq!(found(&positions, true), []);
    }

    #[test]
    fn neighbours_on_a_mesh_do_not_count_unless_they_pass_through_each_other() {
        let mut positions = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
        ]
        .map(DVec3::from);
        let found = |positions: &[DVec3]| crossings(positions, vec![[0, 1, 2], [0, 3, 4]], true);
        assert_eq!(found(&positions), []);
        (positions[3], positions[4]) = (DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.0, 1.0, 1.0));
        assert!(!found(&positions).is_empty());
    }

    #[test]
    fn neighbours_that_are_folded_flat_onto_each_other_are_named_by_a_vertex_or_by_two_edges() {
        let fold = |x: f64, y: f64| {
            let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(x, y, 0.0)];
            crossings(&corners, vec![[0, 1, 2], [1, 0, 3]], true)
        };
        // Lines in the same plane meet where x + y = 1 and 4x = 9y.
        let place = fold(0.9, 0.4)[0].point;
        assert!(place.distance(DVec3::new(9.0, 4.0, 0.0) / 13.0) < 1e-15, "{place}");
        assert_eq!(fold(0.9, 0.4)[0].to_string(), "the edge 1, 2 and the edge 0, 3");
        assert_eq!(fold(0.2, 0.2)[0].to_string(), "the vertex 3 and the face 0, 1, 2");
        let named = |found: Vec<Crossing>| -> Vec<_> { found.iter().map(|own| (own.edge, own.face)).collect() };
        assert_eq!(named(fold(0.2, 0.2)), [([3, 3], [0, 1, 2])]);
        assert_eq!(named(fold(0.8, 0.8)), [([1, 2], [0, 3, 3])]);
        assert_eq!(named(fold(0.2, -0.2)), []);
    }
}
