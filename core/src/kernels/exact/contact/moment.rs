//! Exact times, and the signs of polynomials at them.
//!
//! A time t is represented by s = t/(1 − t), which takes (0, 1) to (0, ∞). A polynomial of degree n in t with Bernstein
//! coefficients βᵢ is (1 − t)ⁿ·Σ C(n, i)βᵢ·sⁱ. So its sign is that of a polynomial in s, whose coefficients need no division.
//! Their signs show which of its roots lie in the step (Descartes). Start and end of the step are s = 0 and s = ∞. Polynomials
//! are slices of coefficients, the constant first; the last may be zero.
//!
//! # Head-room
//! Let coefficients of the corners be below 2ᵐ, as in [`kernel`](crate::exact::kernel): m = 64·N − 2 bits for coordinates of N
//! words. Then cross products are quadratics with coefficients below 2^(2m+2). A determinant of nine numbers of magnitude at most
//! one is at most 4: being linear in each, it is largest where all are ±1. So the volume is a cubic with k₀, k₃ ≤ 4·2³ᵐ and, as
//! sums of three determinants, k₁, k₂ ≤ 12·2³ᵐ. Its derivatives, and the quadratic that replaces it where the first is zero, stay
//! below 24·2³ᵐ < 2^(3m+5): all of them, with a sign, fit in 3·N words.
//!
//! The sign at a root is that of one of the last numbers of [`terms`]: the remainder l of a polynomial divided by the quadratic
//! q, and of q divided by l. These combinations occur:
//!
//! | polynomial | q | l below | last number below |
//! |---|---|---|---|
//! | the volume | a cross product | 2^(7m+11) | 2^(16m+26) |
//! | the volume's derivative | a cross product | 2^(5m+10) | 2^(12m+24) |
//! | a cross product | the volume's derivative | 2^(5m+10) | 2^(13m+28) |
//! | the polynomial in place of the volume | its derivative | 2^(6m+14) | 2^(15m+36) |
//! | a cross product | another | 2^(4m+6) | 2^(10m+16) |
//!
//! (In the first row l is a sum of three or four products of two coefficients of q and one of the cubic. In the others it is a
//! sum of two products of two. The last number is a sum of three, l² times a coefficient of q.) The largest has 16·(64·N − 2) +
//! 26 < 1024·N bits, which is 16·N words. A linear q needs less.
//!
//! The space of [`terms`] is also largest in the first row. There are two numbers of 5·N words and two of 7·N for the remainder,
//! and a power of 4·N. At the end there are four of 9·N, A among them, one of 14·N and three of 16·N. This makes 126·N, and a few
//! words for carries.
//!
//! All this is first tried with [`rounded`](super::rounded) numbers, from which most signs are certain.

use super::Neighbours;
use super::remainder::{terms, value_at_quotient};
use super::rounded::{FixedPoint, Rounded, Scale};
use crate::exact::integer::{Space, Whole, Words};
use core::cmp::Ordering;

/// A time at which signs can be computed.
pub(super) trait ExactTime {
    /// Compares the polynomial with zero at this time.
    fn sign(&self, polynomial: &[Words<'_>], space: &mut Space<'_>) -> Ordering;

    /// Returns the sign of one component of the cross product of neighbours.
    fn turn(&self, neighbours: &Neighbours<'_>, space: &mut Space<'_>) -> Ordering {
        let mut space = space.scratch();
        let cross = neighbours.cross(&mut space);
        self.sign(&cross, &mut space)
    }
}

/// Returns a polynomial's sign just after the start.
fn sign_after_start(polynomial: &[Words<'_>]) -> Ordering {
    first_of_signs(polynomial.iter())
}

/// Returns a polynomial's sign just before the end.
pub(super) fn sign_before_end(polynomial: &[Words<'_>]) -> Ordering {
    first_of_signs(polynomial.iter().rev())
}

/// Returns the first sign that is not zero.
#[inline(always)]
fn first_of_signs<'a>(mut coefficients: impl Iterator<Item = &'a Words<'a>>) -> Ordering {
    coefficients
        .find(|coefficient| !coefficient.is_zero())
        .map_or(Ordering::Equal, |coefficient| Words::sign(*coefficient))
}

pub(super) enum End {
    Start,
    End,
}

impl End {
    /// Selects the polynomial's coefficient that is its value at this end.
    const fn value<T: Copy>(&self, [at_start, at_end]: [T; 2]) -> T {
        match self {
            Self::Start => at_start,
            Self::End => at_end,
        }
    }
}

impl ExactTime for End {
    fn sign(&self, polynomial: &[Words<'_>], _: &mut Space<'_>) -> Ordering {
        let value = match self {
            Self::Start => polynomial.first(),
            Self::End => polynomial.last(),
        };
        value.map_or(Ordering::Equal, |value| Words::sign(*value))
    }

    fn turn(&self, Neighbours([[a, b], [c, d]]): &Neighbours<'_>, space: &mut Space<'_>) -> Ordering {
        let mut space = space.scratch();
        let minor = space.minor(self.value(*a), self.value(*b), self.value(*c), self.value(*d));
        Words::sign(minor)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Lower,
    Upper,
}

impl Side {
    /// Returns the sign of l₁·√D as it is added, given that of l₁.
    #[inline(always)]
    const fn of_root(self, l1: Ordering) -> Ordering {
        match self {
            Self::Lower => l1.reverse(),
            Self::Upper => l1,
        }
    }
}

/// A positive root of a quadratic, or of a linear polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<'a> {
    /// The last coefficient that is not zero is positive.
    quadratic: [Words<'a>; 3],
    side: Side,
}

impl<'a> Root<'a> {
    /// Returns the positive roots of a polynomial of degree at most two, in ascending order, a double one twice. The zero
    /// polynomial has none.
    pub(super) fn positive(polynomial: &[Words<'a>], space: &mut Space<'a>) -> [Option<Self>; 2] {
        let mut quadratic = [Words::ZERO; 3];
        for (to, from) in quadratic.iter_mut().zip(polynomial) {
            *to = *from;
        }
        if sign_before_end(&quadratic).is_lt() {
            quadratic = quadratic.map(|coefficient| space.negated(coefficient));
        }
        let [a, b, c] = quadratic;
        let root = |side| Some(Self { quadratic, side });
        match (a.sign(), b.sign(), c.sign()) {
            // There is one change of sign, after which it stays positive.
            (Ordering::Less, ..) | (Ordering::Equal, Ordering::Less, _) => [None, root(Side::Upper)],
            (Ordering::Greater, Ordering::Less, Ordering::Greater) if !discriminant_sign(quadratic, space).is_lt() => {
                [root(Side::Lower), root(Side::Upper)]
            }
            _ => [None; 2],
        }
    }
}

fn discriminant_sign([a, b, c]: [Words<'_>; 3], space: &mut Space<'_>) -> Ordering {
    let mut space = space.scratch();
    let (squared, product) = (space.times(b, b), space.times(a, c));
    let doubled = space.doubled(product);
    let quadrupled = space.doubled(doubled);
    Words::sign(space.minus(squared, quadrupled))
}

impl ExactTime for Root<'_> {
    fn sign(&self, polynomial: &[Words<'_>], space: &mut Space<'_>) -> Ordering {
        // This is common if corners move in a plane along an axis. Rounded numbers cannot show that a number is zero.
        if polynomial.iter().all(|coefficient| coefficient.is_zero()) {
            return Ordering::Equal;
        }
        #[cfg(test)]
        super::tests::count_a_sign();
        if let Some(sign) = self.estimated_sign(polynomial) {
            return sign;
        }
        let mut space = space.scratch();
        if self.is_of_linear() {
            let [a, b, _] = self.quadratic;
            return Words::sign(value_at_quotient(&mut space, [a, b], polynomial));
        }
        let [l1, first, last] = terms(&mut space, self.quadratic, polynomial).map(Words::sign);
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

impl Root<'_> {
    fn is_of_linear(&self) -> bool {
        let [_, _, c] = self.quadratic;
        c.is_zero()
    }

    /// Returns the sign, if rounded numbers prove it.
    fn estimated_sign(&self, polynomial: &[Words<'_>]) -> Option<Ordering> {
        let of_quadratic = Scale::of(&self.quadratic);
        let of_polynomial = Scale::of(polynomial);
        let quadratic = self.quadratic.map(|x| of_quadratic.rounded(x));
        let mut rounded = [Rounded(0); 4];
        for (to, from) in rounded.iter_mut().zip(polynomial) {
            *to = of_polynomial.rounded(*from);
        }
        let polynomial = rounded.get(..polynomial.len()).unwrap_or_default();
        if self.is_of_linear() {
            let [a, b, _] = quadratic;
            return value_at_quotient(&mut FixedPoint, [a, b], polynomial).sign_if_beyond(32);
        }
        let [l1, first, last] = terms(&mut FixedPoint, quadratic, polynomial);
        let of_root = self.side.of_root(l1.sign_if_beyond(32)?);
        if first.sign_if_beyond(64) == Some(of_root) {
            return Some(of_root);
        }
        match last.sign_if_beyond(512)? {
            Ordering::Less => Some(of_root),
            _ => first.sign_if_beyond(64),
        }
    }

    /// Compares two roots.
    ///
    /// The sign of the other's quadratic here shows whether this root is between the other's two roots. If not, the sign of its
    /// derivative shows on which side of both it is.
    pub(super) fn compare(&self, other: &Root<'_>, space: &mut Space<'_>) -> Ordering {
        let [_, b, c] = other.quadratic;
        let place = self.sign(&other.quadratic, space);
        if c.is_zero() {
            return place;
        }
        if place.is_lt() {
            return match other.side {
                Side::Lower => Ordering::Greater,
                Side::Upper => Ordering::Less,
            };
        }
        let mut space = space.scratch();
        let doubled = space.doubled(c);
        let slope = self.sign(&[b, doubled], &mut space);
        match (place, other.side, slope) {
            (Ordering::Equal, Side::Lower, Ordering::Less | Ordering::Equal)
            | (Ordering::Equal, Side::Upper, Ordering::Greater | Ordering::Equal) => Ordering::Equal,
            _ => slope,
        }
    }
}

/// The only change of sign of a cubic in an interval.
pub(super) struct Crossing<'a> {
    pub(super) cubic: [Words<'a>; 4],
    /// The beginning of the open interval, or `None` for the start.
    pub(super) after: Option<Root<'a>>,
    /// The end of the interval, or `None` for the end.
    pub(super) before: Option<Root<'a>>,
    /// The cubic's sign at the beginning of the interval.
    pub(super) sign_before: Ordering,
}

impl<'a> Crossing<'a> {
    /// Makes the crossing of a cubic in the whole step.
    pub(super) fn between_ends(cubic: [Words<'a>; 4]) -> Self {
        Self {
            cubic,
            after: None,
            before: None,
            sign_before: sign_after_start(&cubic),
        }
    }

    fn compare(&self, root: &Root<'_>, space: &mut Space<'_>) -> Ordering {
        if self.after.is_some_and(|after| root.compare(&after, space).is_le()) {
            return Ordering::Greater;
        }
        if self.before.is_some_and(|before| root.compare(&before, space).is_ge()) {
            return Ordering::Less;
        }
        match root.sign(&self.cubic, space) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == self.sign_before => Ordering::Greater,
            _ => Ordering::Less,
        }
    }
}

impl ExactTime for Crossing<'_> {
    /// Returns the sign of a polynomial of degree at most two: its sign before the end, unless a root is in between.
    fn sign(&self, polynomial: &[Words<'_>], space: &mut Space<'_>) -> Ordering {
        let mut space = space.scratch();
        let mut sign = sign_before_end(polynomial);
        for root in Root::positive(polynomial, &mut space).iter().flatten() {
            match self.compare(root, &mut space) {
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
    use crate::exact::integer::{Integer, Space, Whole};
    use core::cmp::Ordering;

    #[test]
    fn roots_compare_as_the_numbers_that_they_are() {
        // The entries are a polynomial, from the constant term up, and its positive roots.
        let polynomials = [
            ([2, -3, 1], [Some(1), Some(2)]),
            ([10, -7, 1], [Some(2), Some(5)]),
            ([4, -4, 1], [Some(2), Some(2)]),
            ([-10, 3, 1], [None, Some(2)]),
            ([-2, 1, 0], [None, Some(2)]),
            ([-5, 1, 0], [None, Some(5)]),
        ];
        let coefficients = polynomials.map(|(polynomial, _)| polynomial.map(|x| Integer::<1>::shifted(x, 0)));
        let mut words = [0; 1000];
        let mut space = Space::new(&mut words);
        let mut polynomials = coefficients.iter().zip(polynomials.map(|(_, values)| values));
        let roots = [(); 6].map(|()| {
            let (polynomial, values) = polynomials.next().expect("six polynomials");
            let roots = Root::positive(&polynomial.each_ref().map(Whole::words), &mut space);
            assert_eq!(roots.each_ref().map(Option::is_some), values.map(|value| value.is_some()));
            [0, 1].map(|k| roots[k].zip(values[k]))
        });
        for (root, value) in roots.iter().flatten().flatten() {
            for (other, other_value) in roots.iter().flatten().flatten() {
                assert_eq!(
                    root.compare(other, &mut space),
                    value.cmp(other_value),
                    "{value}, {other_value}"
                );
            }
        }
    }

    #[test]
    fn rounded_numbers_tell_a_sign_that_is_clear() {
        let whole = |x: i64| Integer::<1>::shifted(x, 0);
        let quadratic = [2, -3, 1].map(whole);
        let mut words = [0; 100];
        // The polynomials are 5 + s and −5 + s at s = 1 and 2.
        for root in Root::positive(&quadratic.each_ref().map(Whole::words), &mut Space::new(&mut words))
            .iter()
            .flatten()
        {
            for (constant, sign) in [(5, Ordering::Greater), (-5, Ordering::Less)] {
                let linear = [constant, 1].map(whole);
                assert_eq!(root.estimated_sign(&linear.each_ref().map(Whole::words)), Some(sign));
            }
        }
    }
}
