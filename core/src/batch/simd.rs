//! Lanes: one number, or `f32` and `f64` vectors.

use crate::lanes::Lanes;
#[cfg(not(unoptimised))]
use fearless_simd::{ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdMask, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

/// What advancing needs beyond [`Lanes`].
pub(super) trait Quotients: Lanes {
    /// `self / divisor`, lane by lane.
    fn over(self, divisor: Self) -> Self;
    /// One or the other, lane by lane.
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self;
    /// The lanes that are false.
    fn not(mask: Self::Mask) -> Self::Mask;
}

macro_rules! one_lane {
    ($scalar:ident) => {
        impl Quotients for $scalar {
            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }

            #[inline(always)]
            fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
                if mask { if_true } else { if_false }
            }

            #[inline(always)]
            fn not(mask: bool) -> bool {
                !mask
            }
        }
    };
}

one_lane!(f32);
one_lane!(f64);

#[cfg(not(unoptimised))]
macro_rules! lanes {
    ($vector:ident, $scalar:ty) => {
        impl<V: Simd> Lanes for $vector<V> {
            type Scalar = $scalar;
            type Mask = <Self as SimdBase<V>>::Mask;

            #[inline(always)]
            fn splat(self, value: $scalar) -> Self {
                <Self as SimdBase<V>>::splat(self.token(), value)
            }

            #[inline(always)]
            fn any(mask: Self::Mask) -> bool {
                mask.any_true()
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <Self as SimdBase<V>>::abs(self)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                <Self as SimdBase<V>>::max(self, other)
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                <Self as SimdBase<V>>::min(self, other)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }
        }

        impl<V: Simd> Quotients for $vector<V> {
            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }

            #[inline(always)]
            fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
                mask.select(if_true, if_false)
            }

            #[inline(always)]
            fn not(mask: Self::Mask) -> Self::Mask {
                !mask
            }
        }
    };
}

#[cfg(not(unoptimised))]
mod vectors {
    use super::*;

    lanes!(f32x4, f32);
    lanes!(f32x8, f32);
    lanes!(f32x16, f32);
    lanes!(f64x2, f64);
    lanes!(f64x4, f64);
    lanes!(f64x8, f64);
}
