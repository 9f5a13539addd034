//! Sixteen pairs, from any source of points.

use super::mask::LANES;
use super::rows::VertexRow;
use super::tile::Tile;
use crate::kind::PairKind;
use crate::motion::PrimitivePair;
use crate::scalar::{Family, Scalar};
use core::marker::PhantomData;

/// The four points of each of sixteen pairs.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Sixteen<'a, S> {
    /// Indices of rows.
    Mesh {
        rows: &'a [VertexRow<S>],
        indices: &'a [[u32; 4]; LANES],
    },
    Tile(&'a Tile<S>),
}

pub(super) struct InEitherFormat<'a>(PhantomData<&'a ()>);

impl<'a> Family for InEitherFormat<'a> {
    type Of<S: Scalar> = Sixteen<'a, S>;
}

impl<S: Scalar> Sixteen<'_, S> {
    /// Returns the pair in one lane. Its coordinates are NaN if there is no such pair.
    #[inline(always)]
    pub(super) fn pair(self, kind: PairKind, lane: usize) -> PrimitivePair<S> {
        let motions = match self {
            Self::Tile(tile) => tile.motions(lane),
            Self::Mesh { rows, indices } => {
                let unknown = VertexRow([S::INFINITY * S::ZERO; 8]);
                let indices = indices.get(lane).copied().unwrap_or([u32::MAX; 4]);
                indices.map(|index| rows.get(index as usize).unwrap_or(&unknown).motion())
            }
        };
        PrimitivePair { kind, motions }
    }
}
