//! `f32` and `f64`, the two number formats that positions come in.

use crate::batch::BatchScalar;
use crate::lanes::{Lanes, Rounding};
use core::fmt::{Debug, Display};
use core::ops::Div;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// `f32` or `f64`: the format of a caller's positions, with the [`glam`] vector type that goes with it.
///
/// Sealed: the adapter's promises are checked for these two formats only.
pub trait Scalar:
    Lanes<Scalar = Self, Mask = bool>
    + Rounding
    + BatchScalar
    + Div<Output = Self>
    + PartialOrd
    + Debug
    + Display
    + Default
    + Send
    + Sync
    + 'static
    + sealed::Sealed
{
    /// [`glam::Vec3`] or [`glam::DVec3`].
    type Vector: Position<Scalar = Self>;

    /// `"f32"` or `"f64"`.
    const NAME: &'static str;
    /// Zero.
    const ZERO: Self;
    /// Stored bits of the significand, the leading one not counted: 23 or 52.
    const FRACTION_BITS: u32;
    /// Bits of the exponent field: 8 or 11.
    const EXPONENT_BITS: u32;

    /// The number's IEEE 754 encoding; `f32` in the low half.
    ///
    /// Not an operation in floating point: denormals-are-zero does not change it, as it does change
    /// [`to_f64`](Self::to_f64).
    fn encoding(self) -> u64;
    /// The nearest number of this format; infinite if `value` is out of range.
    fn from_f64(value: f64) -> Self;
    /// The same number as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The correctly rounded square root.
    #[must_use]
    fn sqrt(self) -> Self;
}

/// [`glam::Vec3`] or [`glam::DVec3`]: a position, from which its [`Scalar`] can be inferred. Sealed with it.
pub trait Position:
    Copy + Debug + Default + PartialEq + Send + Sync + From<[Self::Scalar; 3]> + Into<[Self::Scalar; 3]>
{
    /// The format of the three coordinates.
    type Scalar: Scalar<Vector = Self>;
}

macro_rules! scalar {
    ($scalar:ident, $vector:ty, $exponent_bits:literal, $sqrt:path) => {
        impl Position for $vector {
            type Scalar = $scalar;
        }

        impl Scalar for $scalar {
            type Vector = $vector;
            const NAME: &'static str = stringify!($scalar);
            const ZERO: Self = 0.0;
            const FRACTION_BITS: u32 = <$scalar>::MANTISSA_DIGITS - 1;
            const EXPONENT_BITS: u32 = $exponent_bits;

            #[inline(always)]
            fn encoding(self) -> u64 {
                self.to_bits().into()
            }

            #[inline(always)]
            #[allow(
                clippy::cast_possible_truncation,
                reason = "rounding to nearest is the purpose"
            )]
            fn from_f64(value: f64) -> Self {
                value as $scalar
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                <$scalar>::is_finite(self)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
        }
    };
}

scalar!(f32, glam::Vec3, 8, libm::sqrtf);
scalar!(f64, glam::DVec3, 11, libm::sqrt);
