//! Times, known exactly, and the signs of polynomials at them.
//!
//! Times are counted by s = t/(1 − t), which takes (0, 1) to (0, ∞). A polynomial of degree n in t with Bernstein coefficients βᵢ is
//! (1 − t)ⁿ·Σ C(n, i)βᵢ·sⁱ, so its sign is that of a polynomial in s, whose coefficients need no division, and which of
//! its roots lie in the step is seen from their signs (Descartes). Start and end of the step are s = 0 and s = ∞. Polynomials are
//! slices of coefficients, the constant first; the last may be zero.
//!
//! # Head-room
//! Let coefficients of the corners be below 2ᵐ, as [`kernel`](crate::exact::kernel) has it: m = 64·N − 2 bits for coordinates of
//! N words. Then cross products are quadratics with coefficients below 2^(2m+2); the volume is a cubic with k₀, k₃ ≤ 6·2³ᵐ
//! and k₁, k₂ ≤ 18·2³ᵐ; its derivatives, and the quadratic that stands for it where the first is zero, stay below
//! 36·2³ᵐ < 2^(3m+6): all of them, with the sign apart, in `C` = 3·N words.
//!
//! [`Root::sign`] takes the remainder l of a polynomial divided by the quadratic q, and of q divided by l. What can come together:
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

use super::whole::Whole;
use core::cmp::Ordering;

/// A time at which signs can be told.
pub(super) trait Moment<const C: usize> {
    /// How the polynomial compares with zero then.
    fn sign(&self, polynomial: &[Whole<C>]) -> Ordering;
}

/// The start of the step.
pub(super) struct Start;

/// The end of the step.
pub(super) struct End;

impl<const C: usize> Moment<C> for Start {
    #[inline(always)]
    fn sign(&self, polynomial: &[Whole<C>]) -> Ordering {
        polynomial.first().map_or(Ordering::Equal, Whole::sign)
    }
}

impl<const C: usize> Moment<C> for End {
    #[inline(always)]
    fn sign(&self, polynomial: &[Whole<C>]) -> Ordering {
        polynomial.last().map_or(Ordering::Equal, Whole::sign)
    }
}

/// A polynomial's sign just after the start.
pub(super) fn sign_after_start<const C: usize>(polynomial: &[Whole<C>]) -> Ordering {
    first_of_signs(polynomial.iter())
}

/// A polynomial's sign just before the end.
pub(super) fn sign_before_end<const C: usize>(polynomial: &[Whole<C>]) -> Ordering {
    first_of_signs(polynomial.iter().rev())
}

/// Of those that are not zero.
#[inline(always)]
fn first_of_signs<'a, const C: usize>(
    mut coefficients: impl Iterator<Item = &'a Whole<C>>,
) -> Ordering {
    coefficients
        .find(|coefficient| !coefficient.is_zero())
        .map_or(Ordering::Equal, Whole::sign)
}

/// Which of a quadratic's roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Lower,
    Upper,
}

/// A positive root of a quadratic, or of a linear polynomial, with `R` words to work with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<const C: usize, const R: usize> {
    /// The last coefficient that is not zero is positive.
    quadratic: [Whole<C>; 3],
    side: Side,
}

impl<const C: usize, const R: usize> Root<C, R> {
    /// The positive roots of a polynomial of degree two at most, in ascending order, a double one twice. None for zero.
    pub(super) fn positive(polynomial: &[Whole<C>]) -> [Option<Self>; 2] {
        let mut quadratic = [Whole::ZERO; 3];
        for (to, from) in quadratic.iter_mut().zip(polynomial) {
            *to = *from;
        }
        if sign_before_end(&quadratic).is_lt() {
            quadratic = quadratic.map(Whole::negated);
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
                let squared: Whole<R> = b.times(b);
                let product: Whole<R> = a.times(c);
                let discriminant: Whole<R> = squared.minus(&product.times_small::<R>(4));
                if discriminant.sign().is_lt() {
                    [None; 2]
                } else {
                    [Some(lower), Some(upper)]
                }
            }
            _ => [None; 2],
        }
    }

    /// The sign of v₀, where −a/b is the root and v₀·b⁻ⁿ the value there (Horner's rule).
    fn sign_at_quotient(a: &Whole<C>, b: &Whole<C>, polynomial: &[Whole<C>]) -> Ordering {
        let mut value = Whole::<R>::ZERO;
        let mut power: Option<Whole<R>> = None;
        for coefficient in polynomial.iter().rev() {
            let raised: Whole<R> = match &power {
                None => coefficient.widened(),
                Some(power) => coefficient.times(power),
            };
            let product: Whole<R> = value.times(a);
            value = raised.minus(&product);
            power = Some(match &power {
                None => b.widened(),
                Some(power) => power.times(b),
            });
        }
        value.sign()
    }

    /// l₀ + l₁·s, a positive multiple of the polynomial at both roots of a + b·s + c·s².
    ///
    /// Horner's rule: (l₀ + l₁·s)·s, times c and with c·s² = −a − b·s, is −a·l₁ + (c·l₀ − b·l₁)·s.
    fn remainder(&self, polynomial: &[Whole<C>]) -> [Whole<R>; 2] {
        let [a, b, c] = &self.quadratic;
        let mut coefficients = polynomial.iter().rev();
        let mut next = || coefficients.next().map(Whole::widened::<R>);
        let mut l1 = next().unwrap_or(Whole::ZERO);
        let Some(mut l0) = next() else {
            return [l1, Whole::ZERO];
        };
        let mut power: Whole<R> = c.widened();
        while let Some(coefficient) = next() {
            let (raised, product): (Whole<R>, Whole<R>) = (coefficient.times(&power), l1.times(a));
            let (from_l0, from_l1): (Whole<R>, Whole<R>) = (l0.times(c), l1.times(b));
            (l0, l1) = (raised.minus(&product), from_l0.minus(&from_l1));
            power = power.times(c);
        }
        [l0, l1]
    }
}

impl<const C: usize, const R: usize> Moment<C> for Root<C, R> {
    /// With σ = (−b ± √D)/2c, D = b² − 4ac and l the remainder, 2c·l(σ) is A ± l₁√D, A = 2c·l₀ − b·l₁. Where its terms have
    /// opposite signs, A² − l₁²D = 4c·(c·l₀² − b·l₀l₁ + a·l₁²) says which is larger. (The number in brackets is the resultant of
    /// polynomial and q, times a power of c.)
    fn sign(&self, polynomial: &[Whole<C>]) -> Ordering {
        #[cfg(test)]
        super::tests::count_a_sign();
        let [a, b, c] = &self.quadratic;
        if c.is_zero() {
            return Self::sign_at_quotient(a, b, polynomial);
        }
        let [l0, l1] = self.remainder(polynomial);
        let of_root_term = match self.side {
            Side::Lower => l1.sign().reverse(),
            Side::Upper => l1.sign(),
        };
        let (from_l0, from_l1): (Whole<R>, Whole<R>) = (l0.times(c), l1.times(b));
        let half: Whole<R> = from_l0.minus(&from_l1);
        let of_first_term = half.plus::<R, R>(&from_l0).sign();
        if of_root_term.is_eq() || of_root_term == of_first_term {
            return of_first_term;
        }
        let (first, second): (Whole<R>, Whole<R>) = (l0.times(&half), l1.times(&l1));
        let last: Whole<R> = second.times(a);
        match first.plus::<R, R>(&last).sign() {
            Ordering::Less => of_root_term,
            Ordering::Equal => Ordering::Equal,
            Ordering::Greater => of_first_term,
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
        let slope = self.sign(&[*b, c.times_small(2)]);
        match (place, other.side, slope) {
            (Ordering::Equal, Side::Lower, Ordering::Less | Ordering::Equal)
            | (Ordering::Equal, Side::Upper, Ordering::Greater | Ordering::Equal) => {
                Ordering::Equal
            }
            _ => slope,
        }
    }
}

/// Where a cubic changes sign: the only place in an interval.
pub(super) struct Crossing<'a, const C: usize, const R: usize> {
    pub(super) cubic: &'a [Whole<C>; 4],
    /// The interval: open, from there, or from the start,
    pub(super) after: Option<&'a Root<C, R>>,
    /// to there, or to the end.
    pub(super) before: Option<&'a Root<C, R>>,
    /// The cubic's sign at its beginning.
    pub(super) sign_before: Ordering,
}

impl<const C: usize, const R: usize> Crossing<'_, C, R> {
    fn compare(&self, root: &Root<C, R>) -> Ordering {
        if self.after.is_some_and(|after| root.compare(after).is_le()) {
            return Ordering::Greater;
        }
        if self
            .before
            .is_some_and(|before| root.compare(before).is_ge())
        {
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
    fn sign(&self, polynomial: &[Whole<C>]) -> Ordering {
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
