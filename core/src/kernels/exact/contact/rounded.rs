//! Fixed-point numbers for a first attempt at signs: 64-bit whole numbers, which no floating-point environment changes.
//!
//! A polynomial's coefficients are divided by a power of two that none of them exceeds, and rounded down to [`FRACTION`] = 56
//! bits after the point. Every product is rounded down as well. Each rounding changes a number by less than δ = 2⁻⁵⁶. The results
//! of [`terms`](super::remainder), for at most a cubic and a quadratic, then have these bounds (an error in a product xy is
//! |x|e_y + |y|e_x + δ, and something of second order):
//!
//! | number | magnitude ≤ | error, in δ |
//! |---|---|---|
//! | a coefficient | 1 | 1 |
//! | c² | 1 | 3 |
//! | l₀, l₁ after a first step: differences of two products | 2 | 6, 6 |
//! | l₀ = k·c² − a·l₁ | 3 | 5 + 9 = 14 |
//! | l₁ = c·l₀ − b·l₁ | 4 | 9 + 9 = 18 |
//! | c·l₀, b·l₁ | 3, 4 | 18, 23 |
//! | their difference | 7 | 41 |
//! | A, with c·l₀ once more | 10 | 59 |
//! | l₀ times the difference | 21 | 123 + 98 + 1 = 222 |
//! | l₁² · a | 16 | 145 + 16 + 1 = 162 |
//! | their sum | 37 | 384 |
//!
//! 32, 64 and 512 in place of 18, 59 and 384 also cover the second order, less than 2⁻⁴⁰ of it. A polynomial of lower degree has
//! less. No number exceeds 64·2⁵⁶ = 2⁶².
//!
//! At the root −a/b of a linear polynomial, [`value_at_quotient`](super::remainder) of a cubic:
//!
//! | number | magnitude ≤ | error, in δ |
//! |---|---|---|
//! | b², b³ | 1, 1 | 3, 5 |
//! | v after a first step: k·b − v·a | 2 | 3 + 3 = 6 |
//! | k·b² − v·a | 3 | 5 + 9 = 14 |
//! | k·b³ − v·a | 4 | 7 + 18 = 25 |
//!
//! Here 32 in place of 25 suffices.

use super::remainder::Ring;
use crate::exact::integer::Words;
use core::cmp::Ordering;

/// The number of bits after the point.
const FRACTION: u32 = 56;

/// A number times 2⁵⁶, rounded down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rounded(pub(super) i64);

/// The power of two by which a polynomial is divided: no coefficient exceeds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale(u32);

impl Scale {
    #[inline(always)]
    pub(super) fn of(polynomial: &[Words<'_>]) -> Self {
        Self(polynomial.iter().map(|coefficient| coefficient.bits()).max().unwrap_or(0))
    }

    #[inline(always)]
    pub(super) fn rounded(self, coefficient: Words<'_>) -> Rounded {
        let word = match self.0.checked_sub(FRACTION) {
            Some(dropped) => coefficient.word_above(dropped),
            None => coefficient.word_above(0) << (FRACTION - self.0),
        };
        // The number is in [−2⁵⁶, 2⁵⁶) by the choice of the scale.
        Rounded(word.cast_signed())
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct FixedPoint;

impl Ring for FixedPoint {
    type Number = Rounded;
    const ZERO: Rounded = Rounded(0);

    #[inline(always)]
    fn plus(&mut self, a: Rounded, b: Rounded) -> Rounded {
        Rounded(a.0.wrapping_add(b.0))
    }

    #[inline(always)]
    fn minus(&mut self, a: Rounded, b: Rounded) -> Rounded {
        Rounded(a.0.wrapping_sub(b.0))
    }

    #[inline(always)]
    fn times(&mut self, a: Rounded, b: Rounded) -> Rounded {
        Rounded(((i128::from(a.0) * i128::from(b.0)) >> FRACTION) as i64)
    }
}

impl Rounded {
    /// Returns the exact number's sign, if this number is off by less than `error` δ and farther than that from zero.
    #[inline(always)]
    pub(super) const fn sign_if_beyond(self, error: i64) -> Option<Ordering> {
        if self.0 > error {
            Some(Ordering::Greater)
        } else if self.0 < -error {
            Some(Ordering::Less)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Rounded;
    use core::cmp::Ordering;

    #[test]
    fn a_sign_is_told_beyond_the_error_and_not_at_it() {
        for (number, sign) in [
            (33, Some(Ordering::Greater)),
            (32, None),
            (0, None),
            (-32, None),
            (-33, Some(Ordering::Less)),
        ] {
            assert_eq!(Rounded(number).sign_if_beyond(32), sign, "{number}");
        }
    }
}
