//! Culling tests of many pairs.

use super::kernels;
use super::mask::{LANES, Mask, next_lane};
use super::rows::{Padded, VertexRow};
use super::sixteen::Sixteen;
use crate::coplanarity::Decision;
use crate::filter::Filter;
use crate::kind::PairKind;
use crate::scalar::Scalar;
use fearless_simd::Level;

/// A test for batches: a [`Filter`] of any tier and separation. With the feature `verification`, also a test of boxes or of the
/// caller's own.
pub trait BatchTest<S: Scalar>: Copy + sealed::Sealed {
    /// Returns the pairs that it culls. It may keep pairs that are not `wanted`. Returns `None` if an index is not in the rows.
    #[doc(hidden)]
    fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, wanted: Mask) -> Option<Mask>;
}

mod sealed {
    pub trait Sealed {}
    impl<S> Sealed for crate::filter::Filter<S> {}
    #[cfg(feature = "verification")]
    impl Sealed for crate::batch::Test {}
    #[cfg(feature = "verification")]
    impl<T> Sealed for crate::batch::ByPoints<T> {}
    #[cfg(feature = "verification")]
    impl<T> Sealed for crate::batch::ByVolume<T> {}
}

impl<S: Scalar> BatchTest<S> for Filter<S> {
    /// The tier's bound decides side by side, and what it leaves open is decided one by one.
    #[inline(always)]
    fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, wanted: Mask) -> Option<Mask> {
        let Decision { mut culled, settled } = kernels::by_filter(level, kind, self.positive_separation(), pairs)?;
        let mut open = self.tier().open(culled, settled) & wanted;
        while open != 0 {
            let lane = next_lane(&mut open);
            if kernels::culls_open(self, pairs.pair(kind, lane)) {
                culled |= 1 << lane;
            }
        }
        Some(culled)
    }
}

/// Writes which of the pairs that `indices` name `test` culls, sixteen to a mask. An index that is not in `rows` keeps the pair. Masks
/// past the last pair are not changed; pairs past the last mask are ignored.
///
/// The four indices of a pair are those of its vertices: vertex, face; or first edge, second edge. It is fastest where pairs that
/// follow one another name rows that are close in memory.
pub fn culled_from_rows<S: Scalar>(
    level: Level,
    kind: PairKind,
    test: impl BatchTest<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    masks: &mut [Mask],
) {
    for (indices, mask) in indices.chunks(LANES).zip(masks) {
        let all = |indices: &_, wanted| test.sixteen(level, kind, Sixteen::Mesh { rows, indices }, wanted);
        let whole = indices.first_chunk().and_then(|indices| all(indices, Mask::MAX));
        *mask = whole.unwrap_or_else(|| {
            let padded = Padded::new(indices, rows.len());
            padded
                .and_then(|padded| Some(all(&padded.indices, padded.known)? & padded.known))
                .unwrap_or(0)
        });
    }
}
