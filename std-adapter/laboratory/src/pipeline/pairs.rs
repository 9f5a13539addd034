//! Primitive pairs by the numbers of their features, and the points that belong to them.

use selvedge::Topology;
use selvedge_core::batch::VertexRow;
use selvedge_core::{EdgeEdge, Motion, Scalar, VertexFace};

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
        let edge = |edge: u32| self.topology.edges()[edge as usize].map(|vertex| self.motion(vertex));
        EdgeEdge {
            first: edge(first),
            second: edge(second),
        }
    }
}
