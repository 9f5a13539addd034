//! `f32` and `f64` vectors as [`Lanes`].

use super::extremes::Extremes;
use crate::lanes::Lanes;
use fearless_simd::{ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdMask, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

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
                Extremes::larger_of(self, other)
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                Extremes::smaller_of(self, other)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> Self::Mask {
                self.simd_le(other)
            }

            #[inline(always)]
            fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
                mask.select(if_true, if_false)
            }
        }
    };
}

lanes!(f32x4, f32);
lanes!(f32x8, f32);
lanes!(f32x16, f32);
lanes!(f64x2, f64);
lanes!(f64x4, f64);
lanes!(f64x8, f64);
