//! Features so closely connected that every edge of one has a vertex of the other.

use super::adjacency::Adjacency;
use super::topology::{Topology, is_degenerate};

/// Two triangles with a common edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hinge {
    triangles: [u32; 2],
    edge: u32,
}

/// The hinges of a mesh, and its loose edges and points.
#[derive(Debug)]
pub(crate) struct Hinges {
    /// The triangles of each edge, without those that name a vertex twice.
    triangles: Adjacency<u32>,
    /// The ends of the loose edges, in both orders, ascending.
    loose: Vec<[u32; 2]>,
    /// The vertices of points, ascending.
    points: Vec<u32>,
    /// Loose edges that are also an edge of a triangle: the opposite vertex of the triangle, then the ends, the smaller first.
    /// The list ascends.
    opposite: Vec<[u32; 3]>,
}

impl Hinges {
    pub(crate) fn new(topology: &Topology) -> Self {
        let triangles = topology.triangles();
        let edges = (0..).zip(topology.triangle_edges()).zip(triangles);
        let proper = edges.filter(|(_, triangle)| !is_degenerate(triangle));
        let keyed = proper.flat_map(|((triangle, edges), _)| edges.map(|edge| (edge, triangle)));
        let degenerate = triangles.iter().filter(|triangle| is_degenerate(triangle));
        let mut points: Vec<_> = degenerate
            .clone()
            .filter(|[a, b, c]| a == b && b == c)
            .map(|&[a, ..]| a)
            .collect();
        points.sort_unstable();
        points.dedup();
        let ends = degenerate.flat_map(|&[a, b, c]| [[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
        let mut loose: Vec<_> = ends.filter(|[a, b]| a != b).collect();
        loose.sort_unstable();
        loose.dedup();
        let of_edges = Adjacency::new(topology.edges().len(), || keyed.clone()).sorted();
        let degenerate = topology.triangle_edges().iter().zip(triangles);
        let named = degenerate
            .filter(|(_, triangle)| is_degenerate(triangle))
            .flat_map(|(edges, _)| edges);
        let mut opposite: Vec<_> = named
            .filter(|&&edge| edge != Topology::NO_EDGE)
            .flat_map(|&edge| of_edges.of(edge as usize).iter().map(move |&triangle| [triangle, edge]))
            .map(|[triangle, edge]| {
                let ends @ [u, v] = topology.edges()[edge as usize];
                [opposite_vertex(topology, triangle, ends), u, v]
            })
            .collect();
        opposite.sort_unstable();
        opposite.dedup();
        Self {
            triangles: of_edges,
            loose,
            points,
            opposite,
        }
    }

    pub(crate) fn at(&self, edge: u32) -> impl Iterator<Item = Hinge> {
        let triangles = self.triangles.of(edge as usize);
        let pairs = triangles
            .iter()
            .enumerate()
            .flat_map(|(k, &first)| triangles[k + 1..].iter().map(move |&second| [first, second]));
        pairs.map(move |triangles| Hinge { triangles, edge })
    }

    /// Returns whether a triangle names a vertex twice: an edge or a point.
    pub(crate) fn has_loose_features(&self) -> bool {
        !self.loose.is_empty() || !self.points.is_empty()
    }

    /// Returns whether neither an edge of the vertex nor a hinge shows that the vertex touches the triangle. Then the vertex is a
    /// point, or a loose edge joins it with a corner. Or the triangle is a loose edge that lies on the opposite edge of a
    /// triangle of the vertex.
    pub(crate) fn may_touch_unseen(&self, vertex: u32, triangle: [u32; 3]) -> bool {
        let is_loose = |&corner: &u32| self.loose.binary_search(&[vertex, corner]).is_ok();
        let lies_opposite = || {
            let (least, most) = triangle
                .iter()
                .fold((u32::MAX, 0), |(a, b), &corner| (a.min(corner), b.max(corner)));
            is_degenerate(&triangle) && self.opposite.binary_search(&[vertex, least, most]).is_ok()
        };
        self.points.binary_search(&vertex).is_ok() || triangle.iter().any(is_loose) || lies_opposite()
    }
}

/// Returns the vertex of a triangle that is not on one of its edges.
#[inline(always)]
fn opposite_vertex(topology: &Topology, triangle: u32, [u, v]: [u32; 2]) -> u32 {
    let vertices = topology.triangles()[triangle as usize];
    // This is exact: the two vertices of the edge cancel.
    vertices[0] ^ vertices[1] ^ vertices[2] ^ u ^ v
}

impl Hinge {
    /// Returns the ends of the edge and the opposite vertex of each triangle, or `None` if these are the same.
    #[inline(always)]
    pub(crate) fn vertices(&self, topology: &Topology) -> Option<[u32; 4]> {
        let ends @ [u, v] = topology.edges()[self.edge as usize];
        let [a, b] = self.triangles.map(|triangle| opposite_vertex(topology, triangle, ends));
        (a != b).then_some([u, v, a, b])
    }

    /// Returns the pairs of the two triangles that have no vertex in common, by kind. They are each opposite vertex with the
    /// other triangle, and an edge of each, with the smaller number first.
    pub(crate) fn pairs(&self, topology: &Topology) -> Option<[[[u32; 2]; 2]; 2]> {
        let [u, v, a, b] = self.vertices(topology)?;
        let [first, second] = self.triangles;
        let edge_of = |triangle: u32, end: u32, other: u32| {
            let vertices = topology.triangles()[triangle as usize];
            let joins = |k: &usize| {
                let [from, to] = [vertices[*k], vertices[(*k + 1) % 3]];
                [from, to] == [end, other] || [from, to] == [other, end]
            };
            let place = (0..3).find(joins)?;
            Some(topology.triangle_edges()[triangle as usize][place])
        };
        let edges = |end, other| {
            let (one, other) = (edge_of(first, end, a)?, edge_of(second, other, b)?);
            Some([one.min(other), one.max(other)])
        };
        Some([[[a, second], [b, first]], [edges(u, v)?, edges(v, u)?]])
    }
}
