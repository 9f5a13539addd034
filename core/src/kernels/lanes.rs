//! The numbers of the kernels: one per pair, or several pairs side by side.
//!
//! A kernel is written once, generic over [`Lanes`]. With `f32` or `f64` it serves one pair. With a type that holds several
//! numbers it serves one pair per lane, and comparisons yield a mask instead of a `bool`. Verification instantiates the same
//! source with tiny number formats and tries every input.

use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// The constants of a binary floating-point format for rounding-error bounds.
///
/// # Floating-point environments
/// Bounds with these constants hold in every environment of a thread. It may round to nearest or in any direction, and keep
/// subnormal numbers or flush them to zero, as results or as operands. An operation's result differs from the exact one by at
/// most 2u times its magnitude (u to nearest). Where subnormal numbers are flushed, λ is added, the smallest normal number, and
/// an operand below λ may count as zero. One set of constants serves all environments: doubling them for directed rounding costs
/// neither time nor, on real scenes, culls.
pub trait Rounding: Copy {
    /// The unit roundoff u: 2⁻²⁴ for `f32`, 2⁻⁵³ for `f64`. A result that is not subnormal differs from the exact one by at most
    /// u times its magnitude if rounded to nearest, otherwise by 2u times.
    const UNIT_ROUNDOFF: Self;
    /// η, a bound of what underflow can add to an error, as derived in [`coplanarity`](crate::coplanarity): 2⁻¹¹⁷ for `f32`,
    /// 2⁻¹⁰⁰⁰ for `f64`.
    ///
    /// It is at least 512·λ, with λ = 2⁻¹²⁶ or 2⁻¹⁰²² the smallest normal number, so that it covers threads that flush subnormal
    /// numbers. It must itself be normal: many processors take a hundred cycles for a product with a subnormal operand. It costs
    /// culls only where volumes are that small: features of a few 10⁻¹² (`f32`) units of length.
    const UNDERFLOW: Self;
    /// The difference of two points' coordinates from which on pairs are kept: 2³⁰ for `f32`, 2²⁵⁰ for `f64`.
    ///
    /// Below it, no intermediate result of the filters overflows: volumes stay below 18·2⁹⁰ (18·2⁷⁵⁰), squares of normals below
    /// 3·(8·2⁶⁰)², which is 2¹²⁷·⁶ (3·(8·2⁵⁰⁰)²). In rounding to nearest, overflow is infinite, and every test keeps infinite
    /// values. But rounding towards zero stops at the largest finite number, which no test would notice.
    const LARGEST_EDGE: Self;
    /// The largest differences of points along an axis for which the time of impact proves anything: 2²⁹ for `f32`, 2²⁵⁰ for
    /// `f64`. Products of four numbers of eight times this size do not overflow.
    const LARGEST_EXTENT: Self;
    /// μ, which is added to the extent of a pair along each axis: 2⁻¹⁰⁰ for `f32`, 2⁻⁹⁶⁰ for `f64`. 20u·μ exceeds the seven λ
    /// that flushing takes from a component.
    const EXTENT_UNDERFLOW: Self;
    /// The sum of squares above which less than a part u is lost to flushing: 2⁻¹⁰⁰ for `f32`, 2⁻⁹⁰⁰ for `f64`.
    const SAFE_SQUARE: Self;
    /// A bound of the length of a vector whose squares underflow: 2⁻⁶² for `f32`, 2⁻⁵¹⁰ for `f64`.
    const LENGTH_UNDERFLOW: Self;
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// One half.
    const HALF: Self;
    /// Positive infinity.
    const INFINITY: Self;
    /// Returns a small whole number, exactly.
    fn small(count: u8) -> Self;
}

/// One or more numbers of the same format, with arithmetic lane by lane.
///
/// Every operation rounds on its own: no fused multiply-add, no reassociation. So verdicts are the same for every number of
/// lanes.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The number format of each lane.
    type Scalar: Rounding;
    /// One truth value per lane: `bool`, or a mask.
    type Mask: Copy
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + BitXor<Output = Self::Mask>
        + Not<Output = Self::Mask>;

    /// Returns the same value in each lane. It takes `self`, and ignores its value, because a vector type may need a witness that
    /// the machine has its instructions.
    #[must_use]
    fn splat(self, value: Self::Scalar) -> Self;
    #[must_use]
    /// Returns whether any lane of a mask is true.
    fn any(mask: Self::Mask) -> bool;
    /// Returns the square root of each lane, rounded once.
    #[must_use]
    fn sqrt(self) -> Self;
    #[must_use]
    /// Returns the magnitude of each lane.
    fn abs(self) -> Self;
    /// Returns the larger of two, lane by lane. If one is NaN, the result may be either. Use it only for magnitudes whose NaN is
    /// noticed elsewhere.
    #[must_use]
    fn larger(self, other: Self) -> Self;
    /// Returns the smaller of two, lane by lane. NaN is treated as in [`larger`](Self::larger).
    #[must_use]
    fn smaller(self, other: Self) -> Self;
    /// Returns `self > other`, lane by lane; false where either is NaN.
    #[must_use]
    fn greater(self, other: Self) -> Self::Mask;
    /// Returns `self <= other`, lane by lane; false where either is NaN.
    #[must_use]
    fn at_most(self, other: Self) -> Self::Mask;
    #[must_use]
    /// Selects one or the other, lane by lane.
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self;
    /// Returns true if no lane is `open`, so that the rest of a computation can be left out. With several lanes it always returns
    /// false: they agree so rarely that the test costs more than it saves.
    #[inline(always)]
    #[must_use]
    fn may_leave(open: Self::Mask) -> bool {
        let _ = open;
        false
    }
}

/// One lane alone, whose comparisons are a `bool` for early exits: `f32`, `f64`, and number types of other crates.
pub trait Number: Lanes<Scalar = Self, Mask = bool> + Rounding + PartialOrd {}

impl<T: Lanes<Scalar = T, Mask = bool> + Rounding + PartialOrd> Number for T {}

/// Returns 1 − `count`·u in the lanes of `like`: a factor that makes up for the rounding of a few operations.
#[inline(always)]
pub(crate) fn less_roundoffs<L: Lanes>(like: L, count: u8) -> L {
    like.splat(L::Scalar::ONE) - roundoffs(like, count)
}

/// Returns 1 + `count`·u.
#[inline(always)]
pub(crate) fn more_roundoffs<L: Lanes>(like: L, count: u8) -> L {
    like.splat(L::Scalar::ONE) + roundoffs(like, count)
}

/// Returns `count`·u.
#[inline(always)]
pub(crate) fn roundoffs<L: Lanes>(like: L, count: u8) -> L {
    like.splat(L::Scalar::small(count)) * like.splat(L::Scalar::UNIT_ROUNDOFF)
}

macro_rules! one_lane {
    ($scalar:ty, [$sqrt:path, $larger:path, $smaller:path], $power_of_two:path, $constants:expr) => {
        impl Rounding for $scalar {
            const UNIT_ROUNDOFF: Self = <$scalar>::EPSILON / 2.0;
            const UNDERFLOW: Self = $power_of_two($constants.underflow);
            const LARGEST_EDGE: Self = $power_of_two($constants.largest_edge);
            const LARGEST_EXTENT: Self = $power_of_two($constants.largest_extent);
            const EXTENT_UNDERFLOW: Self = $power_of_two($constants.extent_underflow);
            const SAFE_SQUARE: Self = $power_of_two($constants.safe_square);
            const LENGTH_UNDERFLOW: Self = $power_of_two($constants.length_underflow);
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
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
            fn any(mask: bool) -> bool {
                mask
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$scalar>::abs(self)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                $larger(self, other)
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                $smaller(self, other)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> bool {
                self > other
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> bool {
                self <= other
            }

            #[inline(always)]
            fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
                if mask { if_true } else { if_false }
            }

            #[inline(always)]
            fn may_leave(open: bool) -> bool {
                !open
            }
        }
    };
}

/// Returns a power of two; the exponent field is biased by 127.
const fn power_of_two_f32(exponent: i64) -> f32 {
    f32::from_bits(((127 + exponent) as u32) << 23)
}

/// Returns a power of two; the exponent field is biased by 1023.
pub(crate) const fn power_of_two_f64(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// A format's constants, as powers of two.
struct Exponents {
    underflow: i64,
    largest_edge: i64,
    largest_extent: i64,
    extent_underflow: i64,
    safe_square: i64,
    length_underflow: i64,
}

const SINGLE: Exponents = Exponents {
    underflow: -117,
    largest_edge: 30,
    largest_extent: 29,
    extent_underflow: -100,
    safe_square: -100,
    length_underflow: -62,
};

const DOUBLE: Exponents = Exponents {
    underflow: -1000,
    largest_edge: 250,
    largest_extent: 250,
    extent_underflow: -960,
    safe_square: -900,
    length_underflow: -510,
};

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod single {
    pub(super) use libm::{sqrt, sqrtf};

    macro_rules! extremes {
        ($scalar:ty, $larger:ident, $smaller:ident) => {
            #[inline(always)]
            pub(super) fn $larger(one: $scalar, other: $scalar) -> $scalar {
                if one > other { one } else { other }
            }

            #[inline(always)]
            pub(super) fn $smaller(one: $scalar, other: $scalar) -> $scalar {
                if one < other { one } else { other }
            }
        };
    }
    extremes!(f32, larger_f32, smaller_f32);
    extremes!(f64, larger_f64, smaller_f64);
}

/// WebAssembly's instructions for vectors, with the same bits.
///
/// `libm` computes square roots there without an instruction. Engines make a branch of a comparison that selects a number, which
/// costs more than the rest where it cannot be predicted; `pmax` and `pmin` are one instruction of x86.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod single {
    use core::arch::wasm32::{f32x4_extract_lane, f32x4_pmax, f32x4_pmin, f32x4_splat, f32x4_sqrt};
    use core::arch::wasm32::{f64x2_extract_lane, f64x2_pmax, f64x2_pmin, f64x2_splat, f64x2_sqrt};

    macro_rules! instructions {
        ($scalar:ty, $splat:ident $extract:ident, $sqrt:ident $root:ident, $larger:ident $max:ident, $smaller:ident $min:ident) => {
            #[inline(always)]
            pub(super) fn $sqrt(square: $scalar) -> $scalar {
                $extract::<0>($root($splat(square)))
            }

            #[inline(always)]
            pub(super) fn $larger(one: $scalar, other: $scalar) -> $scalar {
                $extract::<0>($max($splat(other), $splat(one)))
            }

            #[inline(always)]
            pub(super) fn $smaller(one: $scalar, other: $scalar) -> $scalar {
                $extract::<0>($min($splat(other), $splat(one)))
            }
        };
    }
    instructions!(f32, f32x4_splat f32x4_extract_lane, sqrtf f32x4_sqrt, larger_f32 f32x4_pmax, smaller_f32 f32x4_pmin);
    instructions!(f64, f64x2_splat f64x2_extract_lane, sqrt f64x2_sqrt, larger_f64 f64x2_pmax, smaller_f64 f64x2_pmin);
}

one_lane!(
    f32,
    [single::sqrtf, single::larger_f32, single::smaller_f32],
    power_of_two_f32,
    SINGLE
);
one_lane!(
    f64,
    [single::sqrt, single::larger_f64, single::smaller_f64],
    power_of_two_f64,
    DOUBLE
);

#[cfg(test)]
mod tests {
    use super::Rounding;

    #[test]
    fn constants_are_the_documented_powers_of_two() {
        assert_eq!(f64::from(f32::UNIT_ROUNDOFF), libm::exp2(-24.0));
        assert_eq!(f64::from(f32::UNDERFLOW), libm::exp2(-117.0));
        assert_eq!(f64::from(f32::LARGEST_EDGE), libm::exp2(30.0));
        assert_eq!(f64::UNIT_ROUNDOFF, libm::exp2(-53.0));
        assert_eq!(f64::UNDERFLOW, libm::exp2(-1000.0));
        assert_eq!(f64::LARGEST_EDGE, libm::exp2(250.0));
    }

    #[test]
    fn underflow_covers_512_of_the_smallest_normal_number() {
        let single = (f64::from(f32::UNDERFLOW), f64::from(f32::MIN_POSITIVE));
        for (underflow, smallest_normal) in [single, (f64::UNDERFLOW, f64::MIN_POSITIVE)] {
            assert!(underflow >= 512.0 * smallest_normal);
        }
    }
}
