//! Magnitudes of 64 bits with an exponent that cannot overflow, rounded down or up, without floating point.

use super::integer::Words;

/// A bound of a non-negative number: `significand` · 2^`exponent`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Magnitude {
    /// The significand is zero, or its top bit is set.
    significand: u64,
    exponent: i32,
}

/// The side of the exact value on which the bound lies. Each operation is off by less than 2⁻⁶³ of the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bound {
    Lower,
    Upper,
}

impl Magnitude {
    pub(super) const ZERO: Self = Self {
        significand: 0,
        exponent: 0,
    };

    pub(super) const fn is_zero(self) -> bool {
        self.significand == 0
    }

    /// Returns `significand` · 2^`exponent`, exactly.
    pub(super) fn exact(significand: u64, exponent: i32) -> Self {
        Self::rounded(significand.into(), false, exponent, Bound::Lower)
    }

    /// Returns a bound of a whole number's magnitude times 2^`exponent`.
    #[inline(never)]
    pub(super) fn of(number: Words<'_>, exponent: i32, bound: Bound) -> Self {
        let dropped = number.bits().saturating_sub(64);
        let is_cut = number.trailing_zeros() < dropped;
        let above = number.word_above(dropped);
        // −x is one more than the complement of x, whose lower bits are those cut off.
        let value = if number.sign().is_lt() {
            u128::from(!above) + u128::from(!is_cut)
        } else {
            above.into()
        };
        Self::rounded(value, is_cut, exponent + dropped.cast_signed(), bound)
    }

    /// Returns a bound of `value` · 2^`exponent`, and of a little more if `is_cut`, which needs a `value` of at least 2⁶³.
    fn rounded(value: u128, is_cut: bool, exponent: i32, bound: Bound) -> Self {
        if value == 0 {
            return Self::ZERO;
        }
        let zeros = value.leading_zeros();
        let value = value << zeros;
        let (significand, dropped) = ((value >> 64) as u64, value as u64);
        let exponent = exponent + 64 - zeros.cast_signed();
        let is_inexact = dropped != 0 || is_cut;
        if bound == Bound::Lower || !is_inexact {
            return Self { significand, exponent };
        }
        match significand.checked_add(1) {
            Some(significand) => Self { significand, exponent },
            None => Self {
                significand: 1 << 63,
                exponent: exponent + 1,
            },
        }
    }

    pub(super) fn times(self, other: Self, bound: Bound) -> Self {
        let product = u128::from(self.significand) * u128::from(other.significand);
        Self::rounded(product, false, self.exponent + other.exponent, bound)
    }

    pub(super) fn squared(self, bound: Bound) -> Self {
        self.times(self, bound)
    }

    /// Returns an upper bound of the sum.
    pub(super) fn plus(self, other: Self) -> Self {
        let (large, small) = if self.exceeds(other) { (self, other) } else { (other, self) };
        if small.is_zero() {
            return large;
        }
        // At bit 63 of 128 there is room for the carry, and 63 bits for what is shifted out of `small`.
        let (high, low) = (u128::from(large.significand) << 63, u128::from(small.significand) << 63);
        let shift = large.exponent.abs_diff(small.exponent);
        let shifted = low.checked_shr(shift).unwrap_or(0);
        let is_cut = shifted.checked_shl(shift) != Some(low);
        Self::rounded(high + shifted, is_cut, large.exponent - 63, Bound::Upper)
    }

    pub(super) fn exceeds(self, other: Self) -> bool {
        if self.is_zero() || other.is_zero() {
            return !self.is_zero();
        }
        (self.exponent, self.significand) > (other.exponent, other.significand)
    }
}

#[cfg(test)]
mod tests {
    use super::{Bound, Magnitude};
    use crate::exact::integer::{Integer, Whole};

    fn exact(significand: u64, exponent: i32) -> Magnitude {
        Magnitude::exact(significand, exponent)
    }

    #[test]
    fn a_number_has_one_form() {
        assert_eq!(exact(6, -1), exact(3, 0));
        assert_eq!(exact(0, 5), Magnitude::ZERO);
    }

    #[test]
    fn a_whole_number_gives_the_bounds_of_its_magnitude() {
        let bounds = |number: &Integer<4>| [Bound::Lower, Bound::Upper].map(|bound| Magnitude::of(number.words(), 3, bound));
        let one = Integer::shifted(1, 0);
        assert_eq!(bounds(&Integer::ZERO), [Magnitude::ZERO; 2]);
        for shift in [0_u32, 1, 63, 64, 127, 128, 192] {
            let power = shift.cast_signed() + 3;
            for sevenfold in [Integer::shifted(7, shift), Integer::shifted(-7, shift)] {
                assert_eq!(bounds(&sevenfold), [exact(7, power); 2]);
            }
            // From 2⁶⁴ on one more, or less, does not fit.
            if shift > 64 {
                let above = exact((7 << 61) + 1, power - 61);
                assert_eq!(bounds(&Integer::shifted(7, shift).plus(&one)), [exact(7, power), above]);
                assert_eq!(bounds(&Integer::shifted(-7, shift).minus(&one)), [exact(7, power), above]);
                let below = exact((7 << 61) - 1, power - 61);
                assert_eq!(bounds(&Integer::shifted(7, shift).minus(&one)), [below, exact(7, power)]);
            }
        }
        // 2⁶⁴ − 1 fits, and 2⁶⁴ + 1 does not.
        let two_to_64 = Integer::shifted(1, 64);
        assert_eq!(bounds(&two_to_64.minus(&one)), [exact(u64::MAX, 3); 2]);
        assert_eq!(bounds(&two_to_64.plus(&one)), [exact(1, 67), exact((1 << 63) + 1, 4)]);
    }

    #[test]
    fn products_are_rounded_to_the_side_asked_for() {
        let m = u64::MAX;
        // (2⁶⁴ − 1)² = (2⁶⁴ − 2)·2⁶⁴ + 1.
        assert_eq!(exact(m, 3).squared(Bound::Lower), exact(m - 1, 70));
        assert_eq!(exact(m, 3).squared(Bound::Upper), exact(m, 70));
        // (2⁶⁴ − 1)·(2³² + 1) = 2⁹⁶ + 2⁶⁴ − 2³² − 1 = (2⁶³ + 2³¹ − 1)·2³³ + …
        let other = exact((1 << 32) + 1, 0);
        let below = (1 << 63) + (1 << 31) - 1;
        assert_eq!(exact(m, 0).times(other, Bound::Lower), exact(below, 33));
        assert_eq!(exact(m, 0).times(other, Bound::Upper), exact(below + 1, 33));
        for bound in [Bound::Lower, Bound::Upper] {
            assert_eq!(exact(3, 0).times(exact(5, 1), bound), exact(15, 1));
            assert_eq!(exact(3, 0).times(Magnitude::ZERO, bound), Magnitude::ZERO);
        }
    }

    #[test]
    fn sums_are_rounded_up() {
        let m = u64::MAX;
        let both_orders = |a: Magnitude, b: Magnitude, sum| {
            assert_eq!(a.plus(b), sum);
            assert_eq!(b.plus(a), sum);
        };
        both_orders(exact(3, 0), exact(5, 1), exact(13, 0));
        both_orders(exact(3, 0), Magnitude::ZERO, exact(3, 0));
        both_orders(Magnitude::ZERO, Magnitude::ZERO, Magnitude::ZERO);
        // 2⁶⁴ − 1 and anything more is 2⁶⁴.
        for exponent in [0, -1, -62, -63, -64, -127, -128, -129, i32::MIN / 2] {
            both_orders(exact(m, 0), exact(1, exponent), exact(1, 64));
        }
        // 2⁶⁴ + 2⁶³ and anything up to 2 more.
        for exponent in [1, 0, -63, -64, -5000] {
            both_orders(exact(3, 63), exact(1, exponent), exact((3 << 62) + 1, 1));
        }
    }

    #[test]
    fn comparison_goes_by_value() {
        assert!(exact(3, 0).exceeds(exact(5, -1)));
        assert!(!exact(5, -1).exceeds(exact(3, 0)));
        assert!(!exact(3, 0).exceeds(exact(6, -1)));
        assert!(exact(1, -9000).exceeds(Magnitude::ZERO));
        assert!(!Magnitude::ZERO.exceeds(exact(1, -9000)));
        assert!(!Magnitude::ZERO.exceeds(Magnitude::ZERO));
    }
}
