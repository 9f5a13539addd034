//! The arithmetic of gaps along a direction: [`separation::gap`](crate::separation::gap) has the proofs of its constants.

use crate::kind::PairKind;
use crate::lanes::{Lanes, Rounding, roundoffs};
use crate::points::PairShape;
use crate::vector::Vector;

/// Returns the distance by which the first set is ahead of the second along a direction, rounded.
#[inline(always)]
#[must_use]
pub fn gap<L: Lanes>(kind: PairKind, points: [Vector<L>; 4], direction: Vector<L>) -> L {
    let [a, b, c, d] = points;
    // The calls are written out, since `map` with a closure is not always inlined.
    let values = [direction.dot(a), direction.dot(b), direction.dot(c), direction.dot(d)];
    let [[low, _], [_, high]] = of_kind!(kind, K => K::ranges(values));
    low - high
}

/// Returns a bound of the rounding error of a gap of points whose coordinates do not exceed `largest` in magnitude.
#[inline(always)]
#[must_use]
pub fn error<L: Lanes>(largest: L) -> L {
    roundoffs(largest, 64) * largest + largest.splat(L::Scalar::UNDERFLOW)
}

/// Returns the threshold that a gap must exceed to prove that two sets are more than `separation` apart. `slack` is 1 + 2⁻²⁰.
#[inline(always)]
#[must_use]
pub fn threshold<L: Lanes>(separation: L, error: L, slack: L) -> L {
    separation * (slack * slack) + error
}

/// Returns whether a direction is no longer than `slack` allows. It is false with NaN.
#[inline(always)]
#[must_use]
pub fn is_short<L: Lanes>(direction: Vector<L>, slack: L) -> L::Mask {
    slack.greater(direction.dot(direction))
}
