//! The number formats of positions: `f32` and `f64`.

use crate::lanes::{Number, power_of_two_f64};
use core::fmt::{Debug, Display};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for glam::Vec3 {}
    impl Sealed for glam::DVec3 {}
    impl<S: super::Scalar> Sealed for [S; 3] {}
}

/// `f32` or `f64`: the format of a caller's positions, with its [`glam`] vector type.
///
/// The trait is sealed: the guarantees are verified for these two formats only.
pub trait Scalar: Number + Debug + Display + Default + Send + Sync + 'static + sealed::Sealed {
    /// The vector type, [`glam::Vec3`] or [`glam::DVec3`].
    type Vector: Position<Scalar = Self>;

    /// The name, `"f32"` or `"f64"`.
    const NAME: &'static str;
    /// The stored bits of the significand, without the leading one: 23 or 52.
    const FRACTION_BITS: u32;
    /// The bits of the exponent field: 8 or 11.
    const EXPONENT_BITS: u32;

    /// Returns the number's IEEE 754 encoding; `f32` in the low half.
    ///
    /// This is not a floating-point operation: denormals-are-zero does not change it.
    fn encoding(self) -> u64;
    /// Returns the nearest number of this format, or infinity if `value` is out of range.
    fn from_f64(value: f64) -> Self;
    /// Rounds `value` towards zero by cutting off digits, in any rounding direction. The result is the largest finite number if
    /// `value` is beyond it, and zero below the normal numbers of `f32`. Infinity and NaN are kept.
    fn truncated(value: f64) -> Self;
    /// Returns the next larger number.
    fn next_up(self) -> Self;
    /// Returns the same number as `f64`, exactly, even in a thread that treats subnormal operands as zero.
    fn to_f64(self) -> f64;
    /// Returns whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Returns the smallest normal number for a positive subnormal one, and any other number unchanged.
    ///
    /// For lengths that are safe to overstate: a thread that flushes compares a subnormal length as zero.
    fn raised_to_normal(self) -> Self;
    /// Names the format of a value that is generic over it, so that code for one format can be called.
    #[doc(hidden)]
    fn in_format<F: Family>(value: F::Of<Self>) -> InFormat<F>;
}

/// A family of types, one for each format.
#[doc(hidden)]
pub trait Family {
    /// The type for a format.
    type Of<S: Scalar>;
}

/// A value of a family, and its format.
#[doc(hidden)]
pub enum InFormat<F: Family> {
    /// A value in `f32`.
    Single(F::Of<f32>),
    /// A value in `f64`.
    Double(F::Of<f64>),
}

/// A position whose [`Scalar`] can be inferred: [`glam::Vec3`], [`glam::DVec3`], `[f32; 3]` or `[f64; 3]`. The trait is sealed.
pub trait Position:
    Copy + Debug + Default + PartialEq + Send + Sync + From<[Self::Scalar; 3]> + Into<[Self::Scalar; 3]> + sealed::Sealed
{
    /// The format of the three coordinates.
    type Scalar: Scalar;
}

impl<S: Scalar> Position for [S; 3] {
    type Scalar = S;
}

macro_rules! scalar {
    ($scalar:ident, $format:ident, $vector:ty, $exponent_bits:literal, $to_f64:path, $truncated:path) => {
        impl Position for $vector {
            type Scalar = $scalar;
        }

        impl Scalar for $scalar {
            type Vector = $vector;
            const NAME: &'static str = stringify!($scalar);
            const FRACTION_BITS: u32 = <$scalar>::MANTISSA_DIGITS - 1;
            const EXPONENT_BITS: u32 = $exponent_bits;

            #[inline(always)]
            fn encoding(self) -> u64 {
                self.to_bits().into()
            }

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "rounding to nearest is the purpose")]
            fn from_f64(value: f64) -> Self {
                value as $scalar
            }

            #[inline(always)]
            fn truncated(value: f64) -> Self {
                $truncated(value)
            }

            #[inline(always)]
            fn next_up(self) -> Self {
                <$scalar>::next_up(self)
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                $to_f64(self)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                <$scalar>::is_finite(self)
            }

            #[inline(always)]
            fn raised_to_normal(self) -> Self {
                let is_subnormal = self.to_bits().wrapping_sub(1) < <$scalar>::MIN_POSITIVE.to_bits() - 1;
                if is_subnormal { <$scalar>::MIN_POSITIVE } else { self }
            }

            #[inline(always)]
            fn in_format<F: Family>(value: F::Of<Self>) -> InFormat<F> {
                InFormat::$format(value)
            }
        }
    };
}

scalar!(f32, Single, glam::Vec3, 8, widened, truncated);
scalar!(f64, Double, glam::DVec3, 11, core::convert::identity, core::convert::identity);

/// Converts a subnormal number through its digits, since a thread may treat it as zero in arithmetic.
#[inline(always)]
fn widened(value: f32) -> f64 {
    const SMALLEST_SUBNORMAL: f64 = power_of_two_f64(-149);
    let magnitude = value.to_bits() & 0x7fff_ffff;
    if magnitude < 1 << 23 {
        let digits = f64::from(magnitude) * SMALLEST_SUBNORMAL;
        if value.is_sign_negative() { -digits } else { digits }
    } else {
        value.into()
    }
}

/// Rounds like [`Scalar::truncated`] for `f32`.
#[inline(always)]
fn truncated(value: f64) -> f32 {
    const DROPPED: u32 = f64::MANTISSA_DIGITS - f32::MANTISSA_DIGITS;
    let bits = value.to_bits();
    let magnitude = bits & !(1 << 63);
    let truncated = if magnitude < f64::from(f32::MIN_POSITIVE).to_bits() {
        0.0
    } else if magnitude <= f64::from(f32::MAX).to_bits() {
        // The exponents of both formats are counted from numbers of their own.
        let bias = (f64::MAX_EXP - f32::MAX_EXP) as u64;
        f32::from_bits(((magnitude >> DROPPED) - (bias << (f32::MANTISSA_DIGITS - 1))) as u32)
    } else if magnitude < f64::INFINITY.to_bits() {
        f32::MAX
    } else if magnitude == f64::INFINITY.to_bits() {
        f32::INFINITY
    } else {
        f32::NAN
    };
    if value.is_sign_negative() { -truncated } else { truncated }
}

#[cfg(test)]
mod tests {
    use super::Scalar;

    #[test]
    fn truncation_is_the_next_number_towards_zero() {
        for bits in [0x0080_0000, 0x0080_0001, 0x3f7f_ffff, 0x3f80_0000, 0x7f7f_fffe, 0x7f7f_ffff] {
            let number = f32::from_bits(bits);
            let between = f64::from(number).midpoint(f64::from(number) * (1.0 + 2.0_f64.powi(-23)));
            for value in [f64::from(number), f64::from(number).next_up(), between] {
                assert_eq!(f32::truncated(value), number, "{value:e}");
                assert_eq!(f32::truncated(-value), -number, "{value:e}");
            }
            let below = f64::from(number).next_down();
            let expected = if bits == 0x0080_0000 { 0.0 } else { f32::from_bits(bits - 1) };
            assert_eq!(f32::truncated(below), expected, "{below:e}");
        }
        assert_eq!(f32::truncated(1e300), f32::MAX);
        assert_eq!(f32::truncated(f64::NEG_INFINITY), f32::NEG_INFINITY);
        assert!(f32::truncated(f64::NAN).is_nan());
        assert_eq!(f64::truncated(0.1), 0.1);
    }

    #[test]
    fn widening_is_exact() {
        for bits in [0, 1, 2, 0x007f_ffff, 0x0080_0000, 0x3f80_0001, 0x7f7f_ffff, 0x7f80_0000] {
            for value in [f32::from_bits(bits), -f32::from_bits(bits)] {
                assert_eq!(value.to_f64().to_bits(), f64::from(value).to_bits());
            }
        }
        assert!(f32::NAN.to_f64().is_nan());
    }

    #[test]
    fn only_positive_subnormal_numbers_are_raised() {
        let smallest = f64::MIN_POSITIVE;
        for subnormal in [f64::from_bits(1), 4e-310, smallest.next_down()] {
            assert_eq!(subnormal.raised_to_normal().to_bits(), smallest.to_bits());
            let negative = -subnormal;
            assert_eq!(negative.raised_to_normal().to_bits(), negative.to_bits());
        }
        for other in [0.0, -0.0, smallest, 1.0, -1.0, f64::INFINITY, f64::NAN] {
            assert_eq!(other.raised_to_normal().to_bits(), other.to_bits());
        }
    }
}
