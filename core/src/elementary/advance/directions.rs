//! Proofs that the pair is apart, by separating directions.
//!
//! If the products of a direction w with all corners are larger than s·|w| at some time, the hull of the corners is farther
//! than s from the origin then. Each product with a *constant* w is linear in time; with a w that moves linearly itself it is
//! quadratic. A direction's [`bar`](Direction::bar) is T + s·|w|, T being the
//! [error of a product](crate::elementary::corners): what a computed product must exceed to prove all this.

use crate::elementary::corners::{Corners, less_roundoffs, more_roundoffs, of_format};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// A direction, and what a computed product with it must exceed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction<S> {
    pub(super) w: Vector<S>,
    pub(super) bar: S,
}

/// Until when a direction certainly keeps the pair apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Apart<S> {
    /// It proves nothing.
    Unproven,
    /// From the time it was asked about until this one, which may be the same.
    Until(S),
    /// Until the end of the step.
    ToTheEnd,
}

impl<S: Scalar, const N: usize> Corners<S, N> {
    /// Whether all corners are beyond `separation` along one coordinate axis, on the same side, at both ends of the step: the
    /// [relative boxes](crate::boxes::relative) with a separation. A difference as computed is off by 2u of itself and 3λ, less
    /// than the 8u of the separation and η by which it is to exceed it.
    #[inline(always)]
    pub(super) fn are_beyond_along_an_axis(&self, separation: S) -> bool {
        let bar = separation * more_roundoffs(8) + S::UNDERFLOW;
        let along = |component: fn(&Vector<S>) -> S| {
            let components = || self.ends.iter().flatten().map(component);
            components().all(|x| x > bar) || components().all(|x| -x > bar)
        };
        along(|corner| corner.x) || along(|corner| corner.y) || along(|corner| corner.z)
    }

    /// The direction `w`, of any length, for pairs that are to stay farther than `separation` apart.
    #[inline(always)]
    pub(super) fn direction(&self, w: Vector<S>, separation: S) -> Direction<S> {
        let mut bar = self.product_error(w);
        if separation > S::ZERO {
            bar = bar + separation * (length_above(w) * more_roundoffs(32));
        }
        Direction { w, bar }
    }

    /// Until when `direction`, held constant, keeps the pair apart that has its corners at `positions` at `time`.
    ///
    /// With f(τ) = w·e(τ), f₀ and f₁ its values at the ends as computed and T the bar, it is
    /// q = (f₀ − T)/(f₀ − f₁), where the line through f₀ and f₁ comes down to T, the least over the corners. At any time that
    /// line is within 4εS of f, less than the errors in T allow for: so f(q) is positive (above s·|w|), and as f is at `time`
    /// too, it is in between. The quotient passes through 4 roundings, its product with 1 − 32u through one more.
    ///
    /// f₀ > f₁ is demanded: otherwise, where rounding has f₁ ≤ T and f₀ ≤ f₁, the quotient means nothing. Where flushing makes it
    /// 0/0, or rounding has f₀ < T, nothing is proven.
    #[inline(always)]
    pub(super) fn apart_along(&self, direction: &Direction<S>, positions: &[Vector<S>; N]) -> Apart<S> {
        let Direction { w, bar } = *direction;
        let beyond = S::small(2);
        let mut until = beyond;
        for ([start, end], position) in self.ends.iter().zip(positions) {
            if !(w.dot(*position) > bar) {
                return Apart::Unproven;
            }
            let at_end = w.dot(*end);
            if !(at_end > bar) {
                let at_start = w.dot(*start);
                if !(at_start > at_end) {
                    return Apart::Unproven;
                }
                let quotient = (at_start - bar) / (at_start - at_end) * less_roundoffs(32);
                if !(quotient >= S::ZERO) {
                    return Apart::Unproven;
                }
                until = quotient.smaller(until);
            }
        }
        if until < beyond {
            Apart::Until(until)
        } else {
            Apart::ToTheEnd
        }
    }
}

/// Whether a direction that turns from `before` to `after`, while the corners move from `from` to `to`, keeps the pair apart
/// throughout.
///
/// Both move linearly, so each product is quadratic, with the Bernstein coefficients w₀·e₀, ½(w₀·e₁ + w₁·e₀) and w₁·e₁; s·|w|
/// lies below the line between its values at the ends, whose middle coefficient is the mean. All three above the bar proves
/// it, where the bar of the middle one is the mean of the two: its error is at most 8ε times the mean of S₀ and S₁.
#[inline(always)]
pub(super) fn are_apart_turning<S: Scalar, const N: usize>(
    before: &Direction<S>,
    from: &[Vector<S>; N],
    after: &Direction<S>,
    to: &[Vector<S>; N],
) -> bool {
    let middle_bar = before.bar + after.bar;
    from.iter().zip(to).all(|(from, to)| {
        before.w.dot(*from) > before.bar && after.w.dot(*to) > after.bar && before.w.dot(*to) + after.w.dot(*from) > middle_bar
    })
}

/// The length of `w`, or more, but for 8 roundings: the sum of its components' magnitudes where their squares may underflow.
#[inline(always)]
fn length_above<S: Scalar>(w: Vector<S>) -> S {
    let squared = w.dot(w);
    // Flushed squares are less than a 2⁻²⁴th (2⁻⁵³th) of this.
    if squared > of_format(-100, -900) {
        squared.sqrt()
    } else {
        let magnitudes = w.abs();
        (magnitudes.x + magnitudes.y) + magnitudes.z
    }
}

#[cfg(test)]
mod tests {
    use super::length_above;
    use crate::vector::Vector;

    #[test]
    fn where_squares_underflow_the_length_is_at_most_the_sum_of_the_components() {
        let tiny = 2.0_f32.powi(-70);
        let vector = Vector {
            x: tiny,
            y: -2.0 * tiny,
            z: 4.0 * tiny,
        };
        assert_eq!(length_above(vector), 7.0 * tiny);
        let vector = Vector {
            x: 3.0_f32,
            y: -4.0,
            z: 12.0,
        };
        assert_eq!(length_above(vector), 13.0);
        // Squared and rounded this is the bound itself.
        let bound = 2.0_f32.powi(-50);
        let vector = Vector {
            x: 0.6 * bound,
            y: 0.8 * bound,
            z: 0.0,
        };
        assert_eq!(vector.dot(vector), bound * bound);
        assert!(length_above(vector) > 1.3 * bound);
    }
}
