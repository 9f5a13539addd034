//! Loops of the caller over sixteen numbers or boxes at a time, for traversals of hierarchies.
//!
//! ```
//! use selvedge_core::batch::{Compares, Level, Loop, Mask, in_lanes};
//!
//! /// How many numbers of all rows are above a limit.
//! struct CountAbove<'a>(&'a [[f32; 16]], f32);
//!
//! impl Loop for CountAbove<'_> {
//!     type Output = u32;
//!
//!     #[inline(always)]
//!     fn run(self, lanes: impl Compares) -> u32 {
//!         self.0.iter().map(|row| lanes.above(row, &[self.1; 16]).count_ones()).sum()
//!     }
//! }
//!
//! let rows = [[1.0; 16], std::array::from_fn(|k| k as f32)];
//! assert_eq!(in_lanes(Level::baseline(), CountAbove(&rows, 12.0)), 3);
//! ```

use super::mask::{LANES, Mask, next_lane};
use crate::boxes::Aabb;
use crate::boxes::block::BoxBlock;
use crate::boxes::moving::{MovingBlock, MovingBox};
use fearless_simd::Level;
#[cfg(not(unoptimised))]
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16, u32x16};

/// Sixteen comparisons, with the instructions of a [`Level`]. The results are the same for each level.
pub trait Compares: Copy {
    /// Returns the lanes `among` these whose box is not [apart from](MovingBox::is_apart_from) `other`.
    fn near(self, block: &MovingBlock, other: &MovingBox<f32>, among: Mask) -> Mask;
    /// Returns the lanes `among` these whose box comes [within](Aabb::is_within) `distance` of `other`.
    fn within(self, block: &BoxBlock, other: &Aabb<f32>, distance: f32, among: Mask) -> Mask;
    /// Returns the lanes whose number is above its limit; false where either is NaN.
    fn above(self, numbers: &[f32; LANES], limits: &[f32; LANES]) -> Mask;
    /// Returns the lanes `among` these that have one of the `wanted` numbers in one of the rows.
    fn equal<const M: usize, const N: usize>(self, rows: &[[u32; LANES]; M], wanted: &[u32; N], among: Mask) -> Mask;
}

/// A loop that is compiled for each instruction set. `run`, and every function that it calls, must be `#[inline(always)]`: a
/// function that is not inlined has none of the instructions.
pub trait Loop {
    /// The loop's result.
    type Output;
    /// Runs the loop.
    fn run(self, lanes: impl Compares) -> Self::Output;
}

/// Runs a loop with the instructions of `level`.
#[inline(always)]
pub fn in_lanes<L: Loop>(level: Level, work: L) -> L::Output {
    #[cfg(not(unoptimised))]
    {
        macro_rules! run {
            ($token:expr) => {
                if let Some(token) = $token {
                    return token.vectorize(
                        #[inline(always)]
                        || {
                            super::frame::align();
                            work.run(VectorComparisons(token))
                        },
                    );
                }
            };
        }
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            run!(level.as_avx512());
            run!(level.as_avx2());
            run!(level.as_sse2());
        }
        #[cfg(target_arch = "aarch64")]
        run!(level.as_neon());
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        run!(level.as_wasm_simd128());
    }
    let _ = level;
    work.run(OneByOne)
}

/// Comparisons one by one, for machines without vectors and builds without optimisation.
#[derive(Clone, Copy)]
struct OneByOne;

impl Compares for OneByOne {
    #[inline(always)]
    fn near(self, block: &MovingBlock, other: &MovingBox<f32>, among: Mask) -> Mask {
        block.near(other, among)
    }

    #[inline(always)]
    fn within(self, block: &BoxBlock, other: &Aabb<f32>, distance: f32, among: Mask) -> Mask {
        block.within(other, distance, among)
    }

    #[inline(always)]
    fn above(self, numbers: &[f32; LANES], limits: &[f32; LANES]) -> Mask {
        let lanes = numbers.iter().zip(limits).enumerate();
        lanes.fold(0, |above, (lane, (number, limit))| above | Mask::from(number > limit) << lane)
    }

    #[inline(always)]
    fn equal<const M: usize, const N: usize>(self, rows: &[[u32; LANES]; M], wanted: &[u32; N], among: Mask) -> Mask {
        let (mut asked, mut equal) = (among, 0);
        while asked != 0 {
            let lane = next_lane(&mut asked);
            let is_equal = rows.iter().any(|row| wanted.contains(&row[lane]));
            equal |= Mask::from(is_equal) << lane;
        }
        equal
    }
}

/// Comparisons with the vectors of a token.
#[cfg(not(unoptimised))]
#[derive(Clone, Copy)]
struct VectorComparisons<V>(V);

#[cfg(not(unoptimised))]
impl<V: Simd> Compares for VectorComparisons<V> {
    #[inline(always)]
    fn near(self, block: &MovingBlock, other: &MovingBox<f32>, among: Mask) -> Mask {
        let ([a, b, c, d, e, f], [g, h, i, j, k, l]) = block.rows();
        macro_rules! above {
            ($row:expr, $limit:expr) => {
                f32x16::load_array_ref(self.0, $row).simd_gt(f32x16::splat(self.0, $limit))
            };
        }
        macro_rules! below {
            ($row:expr, $limit:expr) => {
                f32x16::load_array_ref(self.0, $row).simd_lt(f32x16::splat(self.0, $limit))
            };
        }
        let (start, end) = (&other.start, &other.end);
        let x = (above!(a, start.upper[0]) & above!(g, end.upper[0])) | (below!(d, start.lower[0]) & below!(j, end.lower[0]));
        let y = (above!(b, start.upper[1]) & above!(h, end.upper[1])) | (below!(e, start.lower[1]) & below!(k, end.lower[1]));
        let z = (above!(c, start.upper[2]) & above!(i, end.upper[2])) | (below!(f, start.lower[2]) & below!(l, end.lower[2]));
        !((x | y | z).to_bitmask() as Mask) & among
    }

    #[inline(always)]
    fn within(self, block: &BoxBlock, other: &Aabb<f32>, distance: f32, among: Mask) -> Mask {
        let [a, b, c, d, e, f] = block.rows();
        let distance = f32x16::splat(self.0, distance);
        macro_rules! within {
            ($lower:expr, $upper:expr, $axis:expr) => {{
                let ahead = f32x16::load_array_ref(self.0, $lower) - f32x16::splat(self.0, other.upper[$axis]);
                let behind = f32x16::splat(self.0, other.lower[$axis]) - f32x16::load_array_ref(self.0, $upper);
                ahead.simd_le(distance) & behind.simd_le(distance)
            }};
        }
        let all = within!(a, d, 0) & within!(b, e, 1) & within!(c, f, 2);
        all.to_bitmask() as Mask & among
    }

    #[inline(always)]
    fn above(self, numbers: &[f32; LANES], limits: &[f32; LANES]) -> Mask {
        let (numbers, limits) = (
            f32x16::load_array_ref(self.0, numbers),
            f32x16::load_array_ref(self.0, limits),
        );
        numbers.simd_gt(limits).to_bitmask() as Mask
    }

    #[inline(always)]
    fn equal<const M: usize, const N: usize>(self, rows: &[[u32; LANES]; M], wanted: &[u32; N], among: Mask) -> Mask {
        let mut equal = 0;
        for row in rows {
            let row = u32x16::load_array_ref(self.0, row);
            for &number in wanted {
                equal |= row.simd_eq(u32x16::splat(self.0, number)).to_bitmask() as Mask;
            }
        }
        equal & among
    }
}
