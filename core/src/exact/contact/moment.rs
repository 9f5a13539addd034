//! Times, known exactly, and the signs of polynomials at them.
//!
//! Times are counted by s = t/(1 − t), which takes (0, 1) to (0, ∞). A polynomial of degree n in t with Bernstein coefficients βᵢ is
//! (1 − t)ⁿ·Σ C(n, i)βᵢ·sⁱ, so its sign is that of a polynomial in s, whose coefficients need no division, and which of
//! its roots lie in the step is seen from their signs (Descartes). Start and end of the step are s = 0 and s = ∞. Polynomials are
//! slices of coefficients, the constant first; the last may be zero.
//!
//! # Head-room
//! Let coefficients of the corners be below 2ᵐ, as [`kernel`](crate::exact::kernel) has it: m = 64·N − 2 bits for coordinates of
//! N words. Then cross products are quadratics with coefficients below 2^(2m+2). A determinant of nine numbers of magnitude one at most
//! is 4 at most: being linear in each, it is largest where all are ±1. So the volume is a cubic with k₀, k₃ ≤ 4·2³ᵐ and, as sums of
//! three determinants, k₁, k₂ ≤ 12·2³ᵐ; its derivatives, and the quadratic that stands for it where the first is zero, stay below
//! 24·2³ᵐ < 2^(3m+5): all of them, with a sign, in `C` = 3·N words.
//!
//! A root's sign is that of one of the last numbers of [`terms`], the remainder l of a polynomial divided by the quadratic q, and of q
//! divided by l. What can come together:
//!
//! | polynomial | q | l below | last number below |
//! |---|---|---|---|
//! | the volume | a cross product | 2^(7m+11) | 2^(16m+26) |
//! | the volume's derivative | a cross product | 2^(5m+10) | 2^(12m+24) |
//! | a cross product | the volume's derivative | 2^(5m+10) | 2^(13m+28) |
//! | what stands for the volume | its derivative | 2^(6m+14) | 2^(15m+36) |
//! | a cross product | another | 2^(4m+6) | 2^(10m+16) |
//!
//! (In the first row l is a sum of three or four products of two coefficients of q and one of the cubic, in the others two of
//! two; the last number a sum of three, l² times a coefficient of q.) The largest has 16·(64·N − 2) + 26 < 1024·N bits, which is
//! `R` = 16·N words. Where q is linear less is needed.
//!
//! Before all these words are computed the same is tried with [`rounded`](super::rounded) numbers; most signs are certain from them.

use super::remainder::{terms, value_at_quotient};
use super::rounded::Scale;
use crate::exact::integer::Integer;
use core::cmp::Ordering;

/// A time at which signs can be told.
pub(super) trait Moment<const C: usize> {
    /// How the polynomial compares with zero then.
    fn sign(&self, polynomial: &[Integer<C>]) -> Ordering;
}

/// A polynomial's sign just after the start.
fn sign_after_start<const C: usize>(polynomial: &[Integer<C>]) -> Ordering {
    first_of_signs(polynomial.iter())
}

/// A polynomial's sign just before the end.
pub(super) fn sign_before_end<const C: usize>(polynomial: &[Integer<C>]) -> Ordering {
    first_of_signs(polynomial.iter().rev())
}

/// Of those that are not zero.
#[inline(always)]
fn first_of_signs<'a, const C: usize>(mut coefficients: impl Iterator<Item = &'a Integer<C>>) -> Ordering {
    coefficients
        .find(|coefficient| !coefficient.is_zero())
        .map_or(Ordering::Equal, Integer::sign)
}

/// Which of a quadratic's roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Lower,
    Upper,
}

impl Side {
    /// The sign of l₁·√D as it is added, given that of l₁.
    #[inline(always)]
    const fn of_root(self, l1: Ordering) -> Ordering {
        match self {
            Self::Lower => l1.reverse(),
            Self::Upper => l1,
        }
    }
}

/// A positive root of a quadratic, or of a linear polynomial, with `R` words to work with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<const C: usize, const R: usize> {
    /// The last coefficient that is not zero is positive.
    quadratic: [Integer<C>; 3],
    side: Side,
}

impl<const C: usize, const R: usize> Root<C, R> {
    /// The positive roots of a polynomial of degree two at most, in ascending order, a double one twice. None for zero.
    pub(super) fn positive(polynomial: &[Integer<C>]) -> [Option<Self>; 2] {
        let mut quadratic = [Integer::ZERO; 3];
        for (to, from) in quadratic.iter_mut().zip(polynomial) {
            *to = *from;
        }
        if sign_before_end(&quadratic).is_lt() {
            quadratic = quadratic.map(|coefficient| coefficient.negated());
        }
        let [a, b, c] = &quadratic;
        let lower = Self {
            quadratic,
            side: Side::Lower,
        };
        let upper = Self {
            quadratic,
            side: Side::Upper,
        };
        match (a.sign(), b.sign(), c.sign()) {
            // One change of sign, after which it stays positive.
            (Ordering::Less, ..) | (Ordering::Equal, Ordering::Less, _) => [None, Some(upper)],
            (Ordering::Greater, Ordering::Less, Ordering::Greater) => {
                let squared: Integer<R> = b.times(b);
                let product: Integer<R> = a.times(c);
                let discriminant: Integer<R> = squared.minus(&product.doubled().doubled());
                if discriminant.sign().is_lt() {
                    [None; 2]
                } else {
                    [Some(lower), Some(upper)]
                }
            }
            _ => [None; 2],
        }
    }
}

impl<const C: usize, const R: usize> Moment<C> for Root<C, R> {
    fn sign(&self, polynomial: &[Integer<C>]) -> Ordering {
        // Common where corners move in a plane along an axis; and no rounded number tells that another is zero.
        if polynomial.iter().all(Integer::is_zero) {
            return Ordering::Equal;
        }
        #[cfg(test)]
        super::tests::count_a_sign();
        if let Some(sign) = self.estimated_sign(polynomial) {
            return sign;
        }
        let quadratic = self.quadratic.each_ref().map(Integer::widened::<R>);
        let polynomial = polynomial.iter().rev().map(Integer::widened::<R>);
        if self.is_of_linear() {
            let [a, b, _] = quadratic;
            return value_at_quotient([a, b], polynomial).sign();
        }
        let [l1, first, last] = terms(quadratic, polynomial).map(|term| term.sign());
        let of_root = self.side.of_root(l1);
        if of_root.is_eq() || of_root == first {
            return first;
        }
        match last {
            Ordering::Less => of_root,
            Ordering::Equal => Ordering::Equal,
            Ordering::Greater => first,
        }
    }
}

impl<const C: usize, const R: usize> Root<C, R> {
    /// Whether it is the root of a linear polynomial.
    fn is_of_linear(&self) -> bool {
        let [_, _, c] = &self.quadratic;
        c.is_zero()
    }

    /// The sign, if rounded numbers tell.
    fn estimated_sign(&self, polynomial: &[Integer<C>]) -> Option<Ordering> {
        let of_quadratic = Scale::of(&self.quadratic);
        let of_polynomial = Scale::of(polynomial);
        let quadratic = self.quadratic.each_ref().map(|x| of_quadratic.rounded(x));
        let polynomial = polynomial.iter().rev().map(|x| of_polynomial.rounded(x));
        if self.is_of_linear() {
            let [a, b, _] = quadratic;
            return value_at_quotient([a, b], polynomial).sign_if_beyond(32);
        }
        let [l1, first, last] = terms(quadratic, polynomial);
        let of_root = self.side.of_root(l1.sign_if_beyond(32)?);
        if first.sign_if_beyond(64) == Some(of_root) {
            return Some(of_root);
        }
        match last.sign_if_beyond(512)? {
            Ordering::Less => Some(of_root),
            _ => first.sign_if_beyond(64),
        }
    }
}

impl<const C: usize, const R: usize> Root<C, R> {
    /// Compares two roots.
    ///
    /// The sign of the other's quadratic here tells whether this one is between the other's two roots; if not, the sign of its
    /// derivative tells on which side of both.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        let [_, b, c] = &other.quadratic;
        let place = self.sign(&other.quadratic);
        if c.is_zero() {
            return place;
        }
        if place.is_lt() {
            return match other.side {
                Side::Lower => Ordering::Greater,
                Side::Upper => Ordering::Less,
            };
        }
        let slope = self.sign(&[*b, c.doubled()]);
        match (place, other.side, slope) {
            (Ordering::Equal, Side::Lower, Ordering::Less | Ordering::Equal)
            | (Ordering::Equal, Side::Upper, Ordering::Greater | Ordering::Equal) => Ordering::Equal,
            _ => slope,
        }
    }
}

/// Where a cubic changes sign: the only place in an interval.
pub(super) struct Crossing<'a, const C: usize, const R: usize> {
    pub(super) cubic: &'a [Integer<C>; 4],
    /// The interval: open, from there, or from the start,
    pub(super) after: Option<&'a Root<C, R>>,
    /// to there, or to the end.
    pub(super) before: Option<&'a Root<C, R>>,
    /// The cubic's sign at its beginning.
    pub(super) sign_before: Ordering,
}

impl<'a, const C: usize, const R: usize> Crossing<'a, C, R> {
    /// In all of the step.
    pub(super) fn between_ends(cubic: &'a [Integer<C>; 4]) -> Self {
        Self {
            cubic,
            after: None,
            before: None,
            sign_before: sign_after_start(cubic),
        }
    }

    fn compare(&self, root: &Root<C, R>) -> Ordering {
        if self.after.is_some_and(|after| root.compare(after).is_le()) {
            return Ordering::Greater;
        }
        if self.before.is_some_and(|before| root.compare(before).is_ge()) {
            return Ordering::Less;
        }
        match root.sign(self.cubic) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == self.sign_before => Ordering::Greater,
            _ => Ordering::Less,
        }
    }
}

impl<const C: usize, const R: usize> Moment<C> for Crossing<'_, C, R> {
    /// Of a polynomial of degree two at most: that before the end, unless a root is in between.
    fn sign(&self, polynomial: &[Integer<C>]) -> Ordering {
        let mut sign = sign_before_end(polynomial);
        for root in Root::positive(polynomial).iter().flatten() {
            match self.compare(root) {
                Ordering::Less => sign = sign.reverse(),
                Ordering::Equal => return Ordering::Equal,
                Ordering::Greater => {}
            }
        }
        sign
    }
}

#[cfg(test)]
mod tests {
    use super::Root;
    use crate::exact::integer::Integer;
    use core::cmp::Ordering;

    #[test]
    fn roots_compare_as_the_numbers_that_they_are() {
        // Each polynomial, from the constant term up, with its positive roots.
        let polynomials = [
            ([2, -3, 1], [Some(1), Some(2)]),
            ([10, -7, 1], [Some(2), Some(5)]),
            ([4, -4, 1], [Some(2), Some(2)]),
            ([-10, 3, 1], [None, Some(2)]),
            ([-2, 1, 0], [None, Some(2)]),
            ([-5, 1, 0], [None, Some(5)]),
        ];
        let whole = |x: i64| Integer::<2>::shifted(x, 0);
        let roots = polynomials.map(|(polynomial, values)| {
            let roots = Root::<2, 16>::positive(&polynomial.map(whole));
            assert_eq!(roots.each_ref().map(Option::is_some), values.map(|value| value.is_some()));
            [0, 1].map(|k| roots[k].zip(values[k]))
        });
        for (root, value) in roots.iter().flatten().flatten() {
            for (other, other_value) in roots.iter().flatten().flatten() {
                assert_eq!(root.compare(other), value.cmp(other_value), "{value}, {other_value}");
            }
        }
    }

    #[test]
    fn rounded_numbers_tell_a_sign_that_is_clear() {
        let whole = |x: i64| Integer::<2>::shifted(x, 0);
        // 5 + s and −5 + s at s = 1 and 2.
        for root in Root::<2, 16>::positive(&[2, -3, 1].map(whole)).iter().flatten() {
            for (constant, sign) in [(5, Ordering::Greater), (-5, Ordering::Less)] {
                assert_eq!(root.estimated_sign(&[constant, 1].map(whole)), Some(sign));
            }
        }
    }
}
