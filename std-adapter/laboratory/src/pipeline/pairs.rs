//! Primitive pairs by the numbers of their features, with the points that belong to them.

use selvedge::Topology;
use selvedge_core::batch::VertexRow;
use selvedge_core::{PairKind, PrimitivePair, Scalar};

/// The mesh with the motion of each vertex in one row, from which stages gather a pair's points.
#[derive(Clone, Copy)]
pub(super) struct MovingMesh<'a, S: Scalar> {
    pub(super) topology: &'a Topology,
    pub(super) rows: &'a [VertexRow<S>],
}

impl<S: Scalar> MovingMesh<'_, S> {
    #[inline(always)]
    pub(super) fn pair(&self, kind: PairKind, pair: [u32; 2]) -> PrimitivePair<S> {
        PrimitivePair::new(
            kind,
            self.topology
                .vertices_of(kind, pair)
                .map(|vertex| self.rows[vertex as usize].motion()),
        )
    }
}
