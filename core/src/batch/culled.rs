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
pub use shown::{culled, culled_from_tiles};

/// A test for batches: a [`Filter`] of any tier and separation. Also a test of boxes or of the
/// caller's own.
pub trait BatchTest<S: Scalar>: Copy + sealed::Sealed {
    /// Returns the pairs that it culls. It may keep pairs that are not `wanted`. Returns `None` if an index is not in the rows.
    #[doc(hidden)]
    fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, wanted: Mask) -> Option<Mask>;
}

mod sealed {
    pub trait Sealed {}
    impl<S> Sealed for crate::filter::Filter<S> {}
}

impl<S: Scalar> BatchTest<S> for Filter<S> {
    /// Decides by the tier's bound side by side, and pairs that the bound leaves open one by one.
    #[inline(always)]
    fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, wanted: Mask) -> Option<Mask> {
        let Decision { mut culled, settled } = kernels::by_filter(level, kind, self.separation(), pairs)?;
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

/// Writes which of the pairs in `indices` the test culls, sixteen to a mask. An index that is not in `rows` keeps the pair. Masks
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

/// Tests of boxes or of the caller, and pairs that lie side by side.
mod shown {
    use super::{BatchTest, sealed::Sealed};
    use crate::batch::kernels;
    use crate::batch::lane_test::{ByPoints, ByVolume, PointsTest, Test, VolumeTest};
    use crate::batch::mask::{LANES, Mask};
    use crate::batch::sixteen::Sixteen;
    use crate::batch::tile::Tile;
    use crate::kind::PairKind;
    use crate::motion::PrimitivePair;
    use crate::scalar::Scalar;
    use fearless_simd::Level;

    impl Sealed for Test {}
    impl<T> Sealed for ByPoints<T> {}
    impl<T> Sealed for ByVolume<T> {}

    impl<S: Scalar> BatchTest<S> for Test {
        #[inline(always)]
        fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, _: Mask) -> Option<Mask> {
            kernels::by_test(level, kind, self, pairs)
        }
    }

    impl<S: Scalar, T: PointsTest> BatchTest<S> for ByPoints<T> {
        #[inline(always)]
        fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, _: Mask) -> Option<Mask> {
            kernels::by_points(level, kind, self.0, pairs)
        }
    }

    impl<S: Scalar, T: VolumeTest> BatchTest<S> for ByVolume<T> {
        #[inline(always)]
        fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, _: Mask) -> Option<Mask> {
            Some(kernels::by_volume(level, kind, self.0, pairs)?.culled)
        }
    }

    /// Writes which of `pairs`, of either kind, the test culls, sixteen to a mask. Masks past the last pair are not changed;
    /// pairs past the last mask are ignored.
    pub fn culled<S: Scalar>(level: Level, test: impl BatchTest<S>, pairs: &[PrimitivePair<S>], masks: &mut [Mask]) {
        for (pairs, mask) in pairs.chunks(LANES).zip(masks) {
            *mask = 0;
            for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
                if !pairs.iter().any(|pair| pair.kind == kind) {
                    continue;
                }
                // Pairs of the other kind are unknown, so that they are kept.
                let mut tile = Tile::unknown();
                for (lane, pair) in pairs.iter().enumerate().filter(|(_, pair)| pair.kind == kind) {
                    tile.set(lane, pair.motions);
                }
                *mask |= of_tile(level, kind, test, &tile);
            }
        }
    }

    /// Writes which pairs of `tiles` the test culls, a mask for each tile. This is the fastest form for pairs that already lie
    /// side by side.
    pub fn culled_from_tiles<S: Scalar>(
        level: Level,
        kind: PairKind,
        test: impl BatchTest<S>,
        tiles: &[Tile<S>],
        masks: &mut [Mask],
    ) {
        for (tile, mask) in tiles.iter().zip(masks) {
            *mask = of_tile(level, kind, test, tile);
        }
    }

    fn of_tile<S: Scalar>(level: Level, kind: PairKind, test: impl BatchTest<S>, tile: &Tile<S>) -> Mask {
        // A tile has no indices that could be wrong.
        test.sixteen(level, kind, Sixteen::Tile(tile), Mask::MAX).unwrap_or(0)
    }
}
