//! Primitive pairs by the numbers of their features, and the points that belong to them.

use crate::PairKind;
use crate::mesh::Topology;
use selvedge_core::batch::VertexRow;
use selvedge_core::{EdgeEdge, Motion, Scalar, VertexFace};

/// A pair that the elementary test found to touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<S> {
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
    /// The vertex and the face, or the two edges, as numbered by the [`Topology`].
    pub pair: [u32; 2],
    /// When, in [0, 1] of the step. With the certified time of impact not after the exact time, and hardly before
    /// it; with the plain cubic as computed.
    pub time: S,
}

/// The mesh with the motion of each vertex in one row: where the stages gather a pair's points from.
#[derive(Clone, Copy)]
pub(super) struct MovingMesh<'a, S: Scalar> {
    pub(super) topology: &'a Topology,
    pub(super) rows: &'a [VertexRow<S>],
}

impl<S: Scalar> MovingMesh<'_, S> {
    #[inline(always)]
    fn motion(&self, vertex: u32) -> Motion<S> {
        self.rows[vertex as usize].motion()
    }

    #[inline(always)]
    pub(super) fn vertex_face(&self, [vertex, face]: [u32; 2]) -> VertexFace<S> {
        VertexFace {
            vertex: self.motion(vertex),
            face: self.topology.triangles()[face as usize].map(|vertex| self.motion(vertex)),
        }
    }

    #[inline(always)]
    pub(super) fn edge_edge(&self, [first, second]: [u32; 2]) -> EdgeEdge<S> {
        let edge =
            |edge: u32| self.topology.edges()[edge as usize].map(|vertex| self.motion(vertex));
        EdgeEdge {
            first: edge(first),
            second: edge(second),
        }
    }
}
