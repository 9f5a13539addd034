//! The larger and the smaller of two vectors, in one instruction. Where a number is NaN, the result may be either.

use fearless_simd::{Simd, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

/// The larger and the smaller, lane by lane.
pub(super) trait Extremes {
    fn larger_of(one: Self, other: Self) -> Self;
    fn smaller_of(one: Self, other: Self) -> Self;
}

/// One instruction of the processor.
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
macro_rules! extremes {
    ($($vector:ident),+) => {$(
        impl<V: Simd> Extremes for $vector<V> {
            #[inline(always)]
            fn larger_of(one: Self, other: Self) -> Self {
                fearless_simd::SimdBase::max(one, other)
            }

            #[inline(always)]
            fn smaller_of(one: Self, other: Self) -> Self {
                fearless_simd::SimdBase::min(one, other)
            }
        }
    )+};
}
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
extremes!(f32x4, f32x8, f32x16, f64x2, f64x4, f64x8);

/// WebAssembly's `pmax` and `pmin`, which engines translate into one instruction of x86. `max` and `min`, which `fearless_simd`
/// uses, return NaN where either number is NaN; that takes eight instructions.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod pseudo {
    use super::{Extremes, Simd, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
    use core::arch::wasm32 as instructions;
    use fearless_simd::{ExtractToken, SimdCombine, SimdFrom, SimdSplit};

    macro_rules! register {
        ($vector:ident, $max:ident, $min:ident, $extract:ident, [$($lane:literal),+]) => {
            impl<V: Simd> Extremes for $vector<V> {
                #[inline(always)]
                fn larger_of(one: Self, other: Self) -> Self {
                    let [one_row, other_row] = [one, other].map(|own| instructions::$vector($(own[$lane]),+));
                    let chosen = instructions::$max(other_row, one_row);
                    Self::simd_from(one.token(), [$(instructions::$extract::<$lane>(chosen)),+])
                }

                #[inline(always)]
                fn smaller_of(one: Self, other: Self) -> Self {
                    let [one_row, other_row] = [one, other].map(|own| instructions::$vector($(own[$lane]),+));
                    let chosen = instructions::$min(other_row, one_row);
                    Self::simd_from(one.token(), [$(instructions::$extract::<$lane>(chosen)),+])
                }
            }
        };
    }
    register!(f32x4, f32x4_pmax, f32x4_pmin, f32x4_extract_lane, [0, 1, 2, 3]);
    register!(f64x2, f64x2_pmax, f64x2_pmin, f64x2_extract_lane, [0, 1]);

    macro_rules! registers {
        ($($vector:ident),+) => {$(
            impl<V: Simd> Extremes for $vector<V> {
                #[inline(always)]
                fn larger_of(one: Self, other: Self) -> Self {
                    let ((a, b), (c, d)) = (one.split(), other.split());
                    Extremes::larger_of(a, c).combine(Extremes::larger_of(b, d))
                }

                #[inline(always)]
                fn smaller_of(one: Self, other: Self) -> Self {
                    let ((a, b), (c, d)) = (one.split(), other.split());
                    Extremes::smaller_of(a, c).combine(Extremes::smaller_of(b, d))
                }
            }
        )+};
    }
    registers!(f32x8, f32x16, f64x4, f64x8);
}
