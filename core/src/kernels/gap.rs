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

/// Returns whether a direction's gap exceeds `threshold` at the end and at the start of a step. The second gap is computed only
/// where the first one does.
#[inline(always)]
#[must_use]
pub fn keeps<L: Lanes>(at_end: L, at_start: impl FnOnce() -> L, threshold: L) -> L::Mask {
    let is_kept = at_end.greater(threshold);
    if L::may_leave(is_kept) {
        return is_kept;
    }
    is_kept & at_start().greater(threshold)
}

/// Returns whether a gap that is stored from the start exceeds `threshold`, and the gap at the end less its error does, and that
/// gap.
#[inline(always)]
#[must_use]
pub fn lasts<L: Lanes>(stored: L, less_error: impl FnOnce() -> L, threshold: L) -> (L::Mask, L) {
    let is_kept = stored.greater(threshold);
    if L::may_leave(is_kept) {
        return (is_kept, stored);
    }
    let at_end = less_error();
    (is_kept & at_end.greater(threshold), at_end)
}

/// Returns what to store of a gap less its error: zero in place of less than `least`, and at most `largest`.
#[inline(always)]
#[must_use]
pub fn stored<L: Lanes>(gap: L, slack: L, [least, largest]: [L; 2]) -> L {
    let gap = gap / slack;
    let zero = gap.splat(L::Scalar::ZERO);
    L::select(gap.greater(least), gap.smaller(largest), gap.smaller(zero))
}

/// Returns a lower bound of the distance from a gap, if the direction is short. It may be negative.
#[inline(always)]
#[must_use]
pub fn distance<L: Lanes>(gap: L, slack: L, error: L) -> L {
    gap / slack - error
}
