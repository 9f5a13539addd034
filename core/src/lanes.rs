//! Numbers that the kernels compute with: one per pair, or several pairs side by side.
//!
//! A kernel is written once, generic over [`Lanes`]. With `f32` or `f64` it serves one pair; with a type that
//! holds several numbers it serves as many pairs, one per lane, and comparisons yield a mask instead of a
//! `bool`. Verification instantiates the same source with tiny number formats and tries every input.

use core::ops::{Add, BitAnd, BitOr, Mul, Neg, Sub};

/// The constants of a binary floating-point format that rounding-error bounds are made of.
///
/// The bounds assume IEEE 754 arithmetic that rounds to nearest, with subnormal numbers.
pub trait Rounding: Copy {
    /// The unit roundoff u: a rounded result differs from the exact one by at most u times its magnitude,
    /// unless it is subnormal. 2⁻²⁴ for `f32`, 2⁻⁵³ for `f64`.
    const UNIT_ROUNDOFF: Self;
    /// A bound η of what underflow can add to an error, as derived in [`coplanarity`](crate::coplanarity): 2⁻¹¹⁹ for
    /// `f32`, 2⁻¹⁰⁰⁰ for `f64`.
    ///
    /// 32·η₀ would do, η₀ = 2⁻¹⁵⁰ or 2⁻¹⁰⁷⁵ being half of the smallest subnormal number. But many processors take a hundred
    /// cycles for a product with a subnormal operand, and that made the certified filter four times slower. A normal
    /// number costs culls only where volumes are that small: features of a few 10⁻¹² (`f32`) units of length.
    const UNDERFLOW: Self;
    /// One.
    const ONE: Self;
    /// Positive infinity.
    const INFINITY: Self;
    /// A small whole number, exactly. The kernels ask for no more than 10.
    fn small(count: u8) -> Self;
}

/// One or more numbers of the same format, with arithmetic lane by lane.
///
/// Every operation rounds to nearest, on its own: no fused multiply-add, no reassociation. That is what makes
/// verdicts the same for every number of lanes.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The number format of each lane.
    type Scalar: Rounding;
    /// One truth value per lane: `bool`, or a mask.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask>;

    /// The same value in each lane. It takes `self` (and ignores its value) because a vector type may need a
    /// witness that the machine has its instructions.
    #[must_use]
    fn splat(self, value: Self::Scalar) -> Self;
    /// The magnitude of each lane.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of two, lane by lane. Where one of them is NaN the result may be either: only for
    /// magnitudes whose NaN is noticed elsewhere.
    #[must_use]
    fn larger(self, other: Self) -> Self;
    /// The smaller of two, lane by lane. NaN as in [`larger`](Self::larger).
    #[must_use]
    fn smaller(self, other: Self) -> Self;
    /// `self > other`, lane by lane; false where either is NaN.
    #[must_use]
    fn greater(self, other: Self) -> Self::Mask;
}

macro_rules! one_lane {
    ($scalar:ty, $roundoff:expr, $underflow:expr) => {
        impl Rounding for $scalar {
            const UNIT_ROUNDOFF: Self = $roundoff;
            const UNDERFLOW: Self = $underflow;
            const ONE: Self = 1.0;
            const INFINITY: Self = <$scalar>::INFINITY;

            #[inline(always)]
            fn small(count: u8) -> Self {
                count.into()
            }
        }

        impl Lanes for $scalar {
            type Scalar = Self;
            type Mask = bool;

            #[inline(always)]
            fn splat(self, value: Self) -> Self {
                value
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$scalar>::abs(self)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                if self > other { self } else { other }
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                if self < other { self } else { other }
            }

            #[inline(always)]
            fn greater(self, other: Self) -> bool {
                self > other
            }
        }
    };
}

// The exponent field, biased by 127 or 1023, makes a power of two.
one_lane!(f32, f32::EPSILON / 2.0, f32::from_bits((127 - 119) << 23));
one_lane!(f64, f64::EPSILON / 2.0, f64::from_bits((1023 - 1000) << 52));

#[cfg(test)]
mod tests {
    use super::Rounding;

    #[test]
    fn constants_are_the_documented_powers_of_two() {
        assert_eq!(f64::from(f32::UNIT_ROUNDOFF), libm::exp2(-24.0));
        assert_eq!(f64::from(f32::UNDERFLOW), libm::exp2(-119.0));
        assert_eq!(f64::UNIT_ROUNDOFF, libm::exp2(-53.0));
        assert_eq!(f64::UNDERFLOW, libm::exp2(-1000.0));
    }
}
