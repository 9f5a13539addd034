//! Translates between positions in the hierarchies and the numbers of the mesh.

use super::Hierarchies;
use selvedge_core::Motion;
use selvedge_core::PairKind;
use selvedge_core::batch::VertexRow;

impl Hierarchies {
    /// Returns the motion of a vertex of the mesh in the last update, if it has a triangle.
    pub(crate) fn motion_of(&self, vertex: usize) -> Option<Motion<f64>> {
        let position = *self.positions.get(vertex)?;
        self.rows.double().get(position as usize).map(VertexRow::motion)
    }

    pub(crate) fn vertex_positions(&self) -> usize {
        self.vertices.len()
    }

    /// Returns the positions of the ends of each edge, by its own position.
    pub(crate) fn edge_ends(&self) -> &[[u32; 2]] {
        &self.edges.vertices
    }

    #[inline(always)]
    pub(crate) fn face_corners(&self, face: u32) -> [u32; 3] {
        self.faces.vertices[face as usize]
    }

    /// Returns the position of a vertex of the mesh that has a triangle.
    #[inline(always)]
    pub(crate) fn position_of(&self, vertex: u32) -> u32 {
        self.positions[vertex as usize]
    }

    /// Returns a face and an edge as the topology numbers them.
    pub(crate) fn face_edge_in_mesh(&self, [face, edge]: [u32; 2]) -> [u32; 2] {
        [self.faces.primitives[face as usize], self.edges.primitives[edge as usize]]
    }

    /// Returns the positions of the four vertices of a pair: vertex and face, or two edges. The edge with the smaller number in
    /// the mesh comes first, so that results do not depend on the order of the hierarchy.
    #[inline(always)]
    pub(crate) fn vertices(&self, kind: PairKind, [first, second]: [u32; 2]) -> [u32; 4] {
        let (first, second) = (first as usize, second as usize);
        match kind {
            PairKind::VertexFace => {
                let [a, b, c] = self.faces.vertices[second];
                [first as u32, a, b, c]
            }
            PairKind::EdgeEdge => {
                let (first, second) = (&self.edge_ends[first], &self.edge_ends[second]);
                let ([a, b], [c, d]) = (first.ends, second.ends);
                if first.edge < second.edge {
                    [a, b, c, d]
                } else {
                    [c, d, a, b]
                }
            }
        }
    }

    /// Replaces `vertices` by those of many pairs of one kind.
    pub(crate) fn vertices_of_all(&self, kind: PairKind, pairs: &[[u32; 2]], vertices: &mut [[u32; 4]]) {
        let filled = vertices.iter_mut().zip(pairs);
        match kind {
            PairKind::VertexFace => {
                for (vertices, &pair) in filled {
                    *vertices = self.vertices(PairKind::VertexFace, pair);
                }
            }
            PairKind::EdgeEdge => {
                for (vertices, &pair) in filled {
                    *vertices = self.vertices(PairKind::EdgeEdge, pair);
                }
            }
        }
    }

    /// Returns the pair as the topology numbers it: vertex and face, or two edges with the smaller number first.
    #[inline(always)]
    pub(crate) fn in_mesh(&self, kind: PairKind, [first, second]: [u32; 2]) -> [u32; 2] {
        let (first, second) = (first as usize, second as usize);
        match kind {
            PairKind::VertexFace => [self.vertices.primitives[first], self.faces.primitives[second]],
            PairKind::EdgeEdge => {
                let (a, b) = (self.edges.primitives[first], self.edges.primitives[second]);
                [a.min(b), a.max(b)]
            }
        }
    }
}

/// The positions of an edge's ends, and its number in the mesh. The alignment keeps an item on one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(super) struct EdgeEnds {
    pub(super) ends: [u32; 2],
    pub(super) edge: u32,
}

/// Marks a vertex without a position.
pub(super) const NOWHERE: u32 = u32::MAX;
