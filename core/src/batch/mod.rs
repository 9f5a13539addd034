//! Sixteen pairs side by side: the same tests, at the machine's width.
//!
//! A test here is the one-pair test, from the same source, on vectors of lanes. Its verdicts are **the same, bit for
//! bit**, for every instruction set: each operation rounds on its own, and nothing is fused or reassociated.
//!
//! Pairs come from a mesh, as indices into [`VertexRow`]s: any number of them. [`culled_from_rows`] answers with one [`Mask`] for every
//! sixteen pairs: a set bit says that the pair is culled. [`advance_from_rows`] is one round of the certified
//! [time of impact](crate::elementary::advance) for each, for pairs that tests leave. [`largest_strays_from_rows`] says how far points may
//! stray for each pair to keep its distance, [`closest_points`] where each is closest. (The feature `verification` adds tests of boxes, and
//! pairs that lie side by side already.)
//!
//! The caller names the instruction set by a [`Level`]; `selvedge` detects the best one at run time.
//!
//! ```
//! use selvedge_core::batch::{culled_from_rows, Level, VertexRow};
//! use selvedge_core::filter::{Filter, Tier};
//! use selvedge_core::{glam::Vec3, Motion, PairKind};
//!
//! // A triangle, and twenty vertices above it: the first nineteen stay there, the last falls through.
//! let mut rows = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| VertexRow::new(Motion::resting(corner))).to_vec();
//! rows.extend((1..=20).map(|k| {
//!     let end = Vec3::new(0.2, 0.2, 19.5 - k as f32);
//!     VertexRow::new(Motion::new(Vec3::new(0.2, 0.2, 2.0), end))
//! }));
//! let pairs: Vec<_> = (3..23).map(|vertex| [vertex, 0, 1, 2]).collect();
//! let mut masks = [0; 2];
//! culled_from_rows(Level::baseline(), PairKind::VertexFace, Filter::new(Tier::Permanent), &rows, &pairs, &mut masks);
//! assert_eq!(masks, [0xFFFF, 0b0111]);
//! ```

#[macro_use]
mod kernels;
mod advance;
mod alone;
mod chunk;
mod closest;
mod compared;
mod lane_test;
mod rows;
#[cfg(not(unoptimised))]
mod simd;
mod strays;
#[cfg(feature = "verification")]
mod tile;

pub use advance::{Round, RoundQuestion, advance_from_rows};
pub use closest::closest_points;
pub use compared::{Compares, Loop, in_lanes};
pub use fearless_simd::Level;
#[cfg(feature = "verification")]
pub use lane_test::{ByPoints, ByVolume, PointsTest, Test, VolumeTest};
use rows::Padded;
pub use rows::VertexRow;
pub use strays::largest_strays_from_rows;
#[cfg(feature = "verification")]
pub use tile::{Tile, culled, culled_from_tiles};

use crate::PairKind;
use crate::coplanarity::Decision;
use crate::filter::Filter;
use crate::scalar::Scalar;
pub(crate) use kernels::{BatchScalar, Sixteen};

/// How many pairs go side by side.
pub const LANES: usize = 16;

/// One bit for each of sixteen pairs, the first pair's lowest. Bits past the last pair are zero.
pub type Mask = u16;

/// The lowest set lane, which is then cleared.
#[inline(always)]
pub(crate) fn next_lane(lanes: &mut Mask) -> usize {
    let lane = lanes.trailing_zeros() as usize % LANES;
    *lanes &= lanes.wrapping_sub(1);
    lane
}

/// What can be asked of a batch: a [`Filter`] of any tier and separation; with the feature `verification` a test of boxes as well, or a
/// caller's own.
pub trait BatchTest<S: Scalar>: Copy + sealed::Sealed {
    /// Which of sixteen pairs of this kind it culls; of those that are not `wanted` it may say no. `None` if an index is not in the
    /// rows.
    #[doc(hidden)]
    fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, wanted: Mask) -> Option<Mask>;
}

mod sealed {
    pub trait Sealed {}
    impl<S> Sealed for super::Filter<S> {}
    #[cfg(feature = "verification")]
    impl Sealed for super::Test {}
    #[cfg(feature = "verification")]
    impl<T> Sealed for super::ByPoints<T> {}
    #[cfg(feature = "verification")]
    impl<T> Sealed for super::ByVolume<T> {}
}

impl<S: Scalar> BatchTest<S> for Filter<S> {
    /// Side by side as far as the tier's bound goes, then one by one.
    #[inline(always)]
    fn sixteen(self, level: Level, kind: PairKind, pairs: Sixteen<'_, S>, wanted: Mask) -> Option<Mask> {
        let Decision { mut culled, settled } = S::by_filter(level, kind, self.positive_separation(), pairs, wanted)?;
        // One by one, of those that the tier has more to say of.
        let mut open = self.tier().open(culled, settled) & wanted;
        while open != 0 {
            let lane = next_lane(&mut open);
            if S::culls_open(&self, &pairs.pair(kind, lane)) {
                culled |= 1 << lane;
            }
        }
        Some(culled)
    }
}

/// Which of the pairs that `indices` name `test` culls, sixteen to a mask. An index that is not in `rows` keeps the pair. Masks past
/// the last pair are not touched; pairs past the last mask are not looked at.
///
/// The four indices of a pair are those of its vertices: vertex, face; or first edge, second edge. Pairs that follow
/// one another should name rows that are close in memory.
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
