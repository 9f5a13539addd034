//! A binary floating-point format of a few bits, so that tests can try all inputs of a grid.
//!
//! Core's kernels are generic over [`Lanes`]: the source that runs on `f32` and `f64` runs on this format unchanged.

use crate::generator::power_of_two;
use selvedge_core::kernels::lanes::{Lanes, Rounding};
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Rounding to nearest, ties to even; subnormal numbers are kept.
pub const TO_NEAREST: u32 = 0;
pub const DOWNWARD: u32 = 1;
pub const UPWARD: u32 = 2;
pub const TOWARDS_ZERO: u32 = 3;
/// The flag that is added to a direction to flush subnormal numbers: such results become zero, and such operands count as zero.
pub const FLUSHING: u32 = 4;

/// A number of one sign bit, `E` exponent bits and `F` fraction bits, as in IEEE 754, with subnormal numbers, infinities and NaN.
/// `ENVIRONMENT` is one of the directions above, with or without [`FLUSHING`].
///
/// An operation is computed in `f64`, where it is exact, and rounded once. (A product has 2F + 2 bits, and a sum spans at most
/// 2^E + F bits; both are below 53.)
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct Minifloat<const E: u32, const F: u32, const ENVIRONMENT: u32 = TO_NEAREST>(f64);

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Minifloat<E, F, ENVIRONMENT> {
    /// Two to this power is the smallest positive number.
    pub const MIN_EXPONENT: i32 = Self::LOWEST_NORMAL - F.cast_signed();
    const SMALLEST_NORMAL: f64 = 1.0 / (1_u64 << -Self::LOWEST_NORMAL) as f64;
    const LOWEST_NORMAL: i32 = 2 - (1 << (E - 1));
    const HIGHEST_NORMAL: i32 = (1 << (E - 1)) - 1;
    const LARGEST: f64 = power_of_two(Self::HIGHEST_NORMAL) * (2.0 - power_of_two(-F.cast_signed()));
    const DIRECTION: u32 = ENVIRONMENT & 3;
    const FLUSHES: bool = ENVIRONMENT & FLUSHING != 0;
    const FITS: () = assert!(
        E >= 2 && E <= 5 && F >= 1 && F <= 10 && ENVIRONMENT < 8,
        "operations must be exact in f64"
    );

    /// Returns the number nearest to `value`. Of two equally near ones, it is the one whose last bit is 0. It is infinite from
    /// half a step above the largest number.
    pub fn nearest(value: f64) -> Self {
        let () = Self::FITS;
        if !value.is_finite() {
            return Self(value);
        }
        // The sum's last bit is worth a step of this format, so the rounding of `f64` is that of this format.
        let shift = const { 1.5 * power_of_two(52) } * Self::step(value);
        let rounded = (value + shift) - shift;
        if rounded.abs() <= Self::LARGEST {
            // This keeps the sign of zero.
            Self(rounded.copysign(value))
        } else {
            Self(f64::INFINITY.copysign(value))
        }
    }

    /// Returns the result of an operation whose exact result is `value`. It is not inlined, since kernels have hundreds of
    /// operations, in several formats, and would take a minute to compile.
    #[inline(never)]
    fn rounded(value: f64) -> Self {
        let mut number = Self::nearest(value);
        if Self::DIRECTION != TO_NEAREST && value.is_finite() {
            let upwards = match Self::DIRECTION {
                UPWARD => true,
                DOWNWARD => false,
                _ => value < 0.0,
            };
            // Moves one step from the nearest number if that is on the wrong side.
            if number.0.is_infinite() {
                let resume = upwards == (value > 0.0);
                number.0 = if resume { number.0 } else { Self::LARGEST.copysign(value) };
            } else if upwards && number.0 < value {
                number = Self::nearest(number.0 + Self::step(value));
            } else if !upwards && number.0 > value {
                number = Self::nearest(number.0 - Self::step(value));
            }
        }
        if Self::FLUSHES { number.flushed() } else { number }
    }

    /// Returns the value of the operand in an operation.
    fn operand(self) -> f64 {
        if Self::FLUSHES { self.flushed().0 } else { self.0 }
    }

    fn flushed(self) -> Self {
        if self.0.abs() < Self::SMALLEST_NORMAL {
            Self(0.0_f64.copysign(self.0))
        } else {
            self
        }
    }

    /// Returns the distance of neighbours at `value`'s exponent. `value` is zero or normal in f64.
    fn step(value: f64) -> f64 {
        let exponent = ((value.to_bits() >> 52 & 0x7ff) as i32 - 1023).max(Self::LOWEST_NORMAL);
        power_of_two(exponent - F.cast_signed())
    }

    /// Returns the same number, exactly.
    pub const fn value(self) -> f64 {
        self.0
    }

    /// Returns the number as a multiple of the smallest positive one.
    ///
    /// # Panics
    /// Panics if it is NaN or infinite.
    pub fn units(self) -> i64 {
        assert!(self.0.is_finite(), "{self:?} is no multiple of anything");
        (self.0 * power_of_two(-Self::MIN_EXPONENT)) as i64
    }

    /// Iterates over every finite number, in order, zero once.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for exponent in Self::LOWEST_NORMAL..=Self::HIGHEST_NORMAL {
            let step = power_of_two(exponent - F.cast_signed());
            let first = if exponent == Self::LOWEST_NORMAL { 0 } else { 1 << F };
            all.extend((first..2 << F).map(|mantissa| Self(f64::from(mantissa) * step)));
        }
        let negative = all[1..].iter().rev().map(|&number| -number);
        let all: Vec<Self> = negative.chain(all.iter().copied()).collect();
        all
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Add for Minifloat<E, F, ENVIRONMENT> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::rounded(self.operand() + other.operand())
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Sub for Minifloat<E, F, ENVIRONMENT> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::rounded(self.operand() - other.operand())
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Mul for Minifloat<E, F, ENVIRONMENT> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::rounded(self.operand() * other.operand())
    }
}

/// A quotient of two such numbers that is no such number differs from all of them, and their middles, by at least 2⁻²ᶠ⁻² of its
/// size. So the rounding of `f64` does not make it one.
impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Div for Minifloat<E, F, ENVIRONMENT> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self::rounded(self.operand() / other.operand())
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Neg for Minifloat<E, F, ENVIRONMENT> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Rounding for Minifloat<E, F, ENVIRONMENT> {
    const UNIT_ROUNDOFF: Self = Self(1.0 / (2 << F) as f64);
    /// The derivation is that of `coplanarity`: 512·λ if subnormal numbers are flushed. Otherwise only products lose, each at
    /// most a smallest subnormal number e. That is 18·M + 6 times e in 3k₁, and (1 + M)²·32·e is more, by far enough for terms of
    /// second order.
    const UNDERFLOW: Self = if Self::FLUSHES {
        Self(512.0 / (1_u64 << -Self::LOWEST_NORMAL) as f64)
    } else {
        Self(32.0 / (1_u64 << -Self::MIN_EXPONENT) as f64)
    };
    /// An overflow to nearest is infinite and the pair is kept, so no limit is needed. Otherwise volumes must stay below the
    /// largest number: 18·L³ < 2⁵·L³.
    const LARGEST_EDGE: Self = if Self::DIRECTION == TO_NEAREST {
        Self(f64::INFINITY)
    } else {
        assert!(Self::HIGHEST_NORMAL >= 4, "the smallest limit is 1");
        Self((1_u64 << ((Self::HIGHEST_NORMAL - 4) / 3)) as f64)
    };
    /// Squares of normals, 3·(8·x²)² < 2⁸·x⁴, stay below the largest number, and so does everything else:
    /// `verification/gappa/range.g`. The limit also holds to nearest, since it is the time of impact's only guard.
    const LARGEST_EXTENT: Self = {
        assert!(Self::HIGHEST_NORMAL >= 7, "the smallest limit is 1");
        Self((1_u64 << ((Self::HIGHEST_NORMAL - 7) / 4)) as f64)
    };
    /// The limit that `corners.g` requires: 20u·μ ≥ 7λ, with a margin for terms of second order.
    const EXTENT_UNDERFLOW: Self = Self(0.5 * Self::SMALLEST_NORMAL / Self::UNIT_ROUNDOFF.0);
    /// A number whose product with u is at least 3λ.
    const SAFE_SQUARE: Self = Self(4.0 * Self::SMALLEST_NORMAL / Self::UNIT_ROUNDOFF.0);
    /// A number whose square is at least 3λ.
    const LENGTH_UNDERFLOW: Self = Self(2.0 / (1_u64 << (-Self::LOWEST_NORMAL / 2)) as f64);
    const ZERO: Self = Self(0.0);
    const HALF: Self = Self(0.5);
    const ONE: Self = Self(1.0);
    const INFINITY: Self = Self(f64::INFINITY);

    /// Returns a small integer, rounded up if the format has too few bits for it.
    fn small(count: u8) -> Self {
        let nearest = Self::nearest(count.into());
        if nearest.0 < f64::from(count) {
            let exponent = (nearest.0.to_bits() >> 52) as i32 - 1023;
            Self(nearest.0 + power_of_two(exponent - F.cast_signed()))
        } else {
            nearest
        }
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> Lanes for Minifloat<E, F, ENVIRONMENT> {
    type Scalar = Self;
    type Mask = bool;

    fn splat(self, value: Self) -> Self {
        value
    }

    fn any(mask: bool) -> bool {
        mask
    }

    /// This is rounded once: f64 has more than twice the bits, so a root that is not a number of this format does not become one.
    fn sqrt(self) -> Self {
        Self::rounded(self.operand().sqrt())
    }

    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    fn larger(self, other: Self) -> Self {
        if self.greater(other) { self } else { other }
    }

    fn smaller(self, other: Self) -> Self {
        if other.greater(self) { self } else { other }
    }

    fn greater(self, other: Self) -> bool {
        self.operand() > other.operand()
    }

    fn at_most(self, other: Self) -> bool {
        self.operand() <= other.operand()
    }

    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }

    fn may_leave(open: bool) -> bool {
        !open
    }
}

impl<const E: u32, const F: u32, const ENVIRONMENT: u32> fmt::Debug for Minifloat<E, F, ENVIRONMENT> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

/// Returns the numbers with these values.
///
/// # Panics
/// Panics if the format lacks one of them.
pub fn numbers<const E: u32, const F: u32, const ENVIRONMENT: u32, const N: usize>(
    values: [f64; N],
) -> [Minifloat<E, F, ENVIRONMENT>; N] {
    let numbers = values.map(Minifloat::nearest);
    assert_eq!(numbers.map(Minifloat::value), values, "the format has these numbers");
    numbers
}

/// Calls `visit` with every way to choose `N` of `values`, in counting order.
pub fn every<T: Copy, const N: usize>(values: &[T], mut visit: impl FnMut([T; N])) {
    let mut digits = [0; N];
    loop {
        visit(digits.map(|digit| values[digit]));
        let Some(place) = digits.iter().position(|&digit| digit + 1 < values.len()) else {
            return;
        };
        digits[..place].fill(0);
        digits[place] += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cmp::Ordering;

    type Small = Minifloat<4, 3>;

    #[test]
    fn there_are_as_many_numbers_as_codes() {
        // There are 2⁸ codes, without 2 · 2³ for infinity and NaN, and with one zero.
        let all = Small::all();
        assert_eq!(all.len(), 256 - 16 - 1);
        assert!(all.is_sorted_by(|a, b| a.value() < b.value()));
        assert_eq!((all[0].value(), all[238].value()), (-240.0, 240.0));
        assert_eq!(all[120].value(), 1.0 / 512.0);
    }

    /// This is the closest number by definition, or the even one of two that are equally close.
    #[test]
    fn sums_and_products_of_all_numbers_are_rounded_to_nearest_even() {
        let all = Small::all();
        let closest = |exact: f64| {
            let after = all.partition_point(|number| number.value() < exact);
            if after == all.len() || after == 0 {
                // 248 is halfway from 240 to the next number, 256, which is even.
                return if exact.abs() < 248.0 {
                    240.0_f64.copysign(exact)
                } else {
                    f64::INFINITY.copysign(exact)
                };
            }
            let (low, high) = (all[after - 1], all[after]);
            match (exact - low.value()).total_cmp(&(high.value() - exact)) {
                Ordering::Less => low.value(),
                Ordering::Greater => high.value(),
                // Even and odd numbers alternate, and zero, in the middle, is even.
                Ordering::Equal if (after - 1).abs_diff(all.len() / 2) % 2 == 0 => low.value(),
                Ordering::Equal => high.value(),
            }
        };
        for &a in &all {
            for &b in &all {
                for (computed, exact) in [
                    (a + b, a.value() + b.value()),
                    (a - b, a.value() - b.value()),
                    (a * b, a.value() * b.value()),
                ] {
                    assert_eq!(computed.value(), closest(exact), "{a:?} and {b:?}");
                }
            }
        }
    }

    /// This is the last number before, or the first one after, by definition.
    fn rounds_in_its_direction<const ENVIRONMENT: u32>() {
        type Directed<const ENVIRONMENT: u32> = Minifloat<4, 3, ENVIRONMENT>;
        let flushes = ENVIRONMENT & FLUSHING != 0;
        let flushed = |x: f64| {
            if flushes && x.abs() < 1.0 / 64.0 { 0.0 } else { x }
        };
        let all = Directed::<ENVIRONMENT>::all();
        let neighbour = |exact: f64| {
            let upwards = match ENVIRONMENT & 3 {
                UPWARD => true,
                DOWNWARD => false,
                _ => exact < 0.0,
            };
            let number = if upwards {
                let after = all.partition_point(|number| number.value() < exact);
                all.get(after).map_or(f64::INFINITY, |number| number.value())
            } else {
                let after = all.partition_point(|number| number.value() <= exact);
                let before = after.checked_sub(1).map(|before| all[before].value());
                before.unwrap_or(f64::NEG_INFINITY)
            };
            flushed(number)
        };
        for &a in &all {
            for &b in &all {
                let (x, y) = (flushed(a.value()), flushed(b.value()));
                for (computed, exact) in [(a + b, x + y), (a - b, x - y), (a * b, x * y)] {
                    assert_eq!(computed.value(), neighbour(exact), "{a:?} and {b:?}");
                }
                assert_eq!(a.greater(b), x > y, "{a:?} and {b:?}");
            }
        }
    }

    #[test]
    fn sums_and_products_of_all_numbers_are_rounded_as_the_environment_says() {
        rounds_in_its_direction::<DOWNWARD>();
        rounds_in_its_direction::<UPWARD>();
        rounds_in_its_direction::<TOWARDS_ZERO>();
        rounds_in_its_direction::<{ DOWNWARD | FLUSHING }>();
        rounds_in_its_direction::<{ UPWARD | FLUSHING }>();
        rounds_in_its_direction::<{ TOWARDS_ZERO | FLUSHING }>();
    }

    #[test]
    fn infinity_and_nan_go_on() {
        let infinite = Small::nearest(f64::INFINITY);
        assert_eq!((infinite + Small::ONE).value(), f64::INFINITY);
        assert!((infinite - infinite).value().is_nan());
        assert!((infinite * Small::nearest(0.0)).value().is_nan());
        assert!(!(infinite - infinite).greater(Small::ONE));
        assert!(!Small::ONE.greater(infinite - infinite));
    }

    #[test]
    fn constants_are_those_of_the_format() {
        assert_eq!(Small::UNIT_ROUNDOFF.value(), 1.0 / 16.0);
        assert_eq!(Small::UNDERFLOW.value(), 32.0 / 512.0);
        assert_eq!(Small::LARGEST_EDGE.value(), f64::INFINITY);
        type Flushing = Minifloat<5, 8, { TOWARDS_ZERO | FLUSHING }>;
        assert_eq!(Flushing::UNDERFLOW.value(), 512.0 / 16_384.0);
        assert_eq!(Flushing::LARGEST_EDGE.value(), 8.0);
        assert_eq!((Small::small(16).value(), Small::small(20).value()), (16.0, 20.0));
        assert_eq!(Minifloat::<4, 1>::small(20).value(), 24.0);
        for number in Small::all() {
            assert_eq!(number.units() as f64 / 512.0, number.value());
        }
    }
}
