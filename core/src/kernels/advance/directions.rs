//! Proofs by separating directions that a pair is apart.
//!
//! If the products of a direction w with all corners exceed s·|w| at some time, the hull of the corners is farther than s from
//! the origin then. Each product with a *constant* w is linear in time; with a w that itself moves linearly, it is quadratic. A
//! direction's [`bar`](Direction::bar) is T + s·|w|, with T the [error of a product](super::corners): the value that a computed
//! product must exceed for these proofs.

use super::corners::Corners;
use crate::lanes::{Lanes, Rounding, less_roundoffs, more_roundoffs};
use crate::separation_lanes::SeparationLanes;
use crate::vector::Vector;

/// A direction, and the value that a computed product with it must exceed.
#[derive(Clone, Copy, Debug)]
pub struct Direction<L> {
    /// The direction, of any length.
    pub w: Vector<L>,
    /// The bar, T + s·|w|.
    pub bar: L,
}

/// The time until which a direction certainly keeps the pair apart.
#[derive(Clone, Copy, Debug)]
pub struct Proven<L: Lanes> {
    /// The lanes, among the requested ones, in which it keeps the pair apart at the given time.
    pub is_apart: L::Mask,
    /// The time until which those lanes stay apart, which may be the same or earlier; [`beyond`] the step if they do to its end.
    /// Other lanes have no meaning.
    pub until: L,
}

/// Returns a time after every step, which means "to the end of the step".
#[inline(always)]
#[must_use]
pub fn beyond<L: Lanes>(like: L) -> L {
    like.splat(L::Scalar::small(2))
}

/// Returns the value that a computed coordinate of a corner must exceed to prove that it exceeds `separation`. Such a difference
/// is off by 2u of itself and 3λ, less than the 8u of the separation and η that are added.
#[inline(always)]
pub(crate) fn axis_bar<L: Lanes>(separation: L) -> L {
    separation * more_roundoffs(separation, 8) + separation.splat(L::Scalar::UNDERFLOW)
}

impl<L: Lanes, const N: usize> Corners<L, N> {
    /// Returns whether all corners are beyond `separation` along one coordinate axis, on the same side, at both ends of the step.
    /// These are the [relative boxes](crate::boxes::relative) with a separation.
    #[inline(always)]
    #[must_use]
    pub fn are_beyond_along_an_axis(&self, separation: L) -> L::Mask {
        let bar = axis_bar(separation);
        let along = |component: fn(&Vector<L>) -> L| {
            let (mut above, mut below) = (everywhere(separation), everywhere(separation));
            for x in self.ends.iter().flatten().map(component) {
                above = above & x.greater(bar);
                below = below & (-x).greater(bar);
                if L::may_leave(above | below) {
                    break;
                }
            }
            above | below
        };
        along(|corner| corner.x) | along(|corner| corner.y) | along(|corner| corner.z)
    }

    /// Returns the direction `w`, of any length, for pairs that must not touch.
    #[inline(always)]
    #[must_use]
    pub fn direction(&self, w: Vector<L>) -> Direction<L> {
        let bar = self.product_error(w);
        Direction { w, bar }
    }

    /// Returns the direction `w`, of any length, for pairs that must stay farther apart than `separation`.
    #[inline(always)]
    #[must_use]
    pub fn direction_beyond(&self, w: Vector<L>, separation: &SeparationLanes<L>) -> Direction<L> {
        let Direction { w, mut bar } = self.direction(w);
        if separation.is_positive() {
            let separation = separation.length();
            bar = bar + separation * (length_above(w) * more_roundoffs(separation, 32));
        }
        Direction { w, bar }
    }

    /// Returns the time until which `direction`, held constant, keeps apart the pair with corners at `positions` at some time.
    /// Lanes that are not `among` the requested ones prove nothing.
    ///
    /// Let f(τ) = w·e(τ), f₀ and f₁ its computed values at the ends, and T the bar. The time is q = (f₀ − T)/(f₀ − f₁), where the
    /// line through f₀ and f₁ falls to T, the least over the corners. At any time that line is within 4εS of f, less than the
    /// errors in T allow for. So f(q) is positive (above s·|w|), and since f is positive at the time of `positions` too, it is so
    /// in between. The quotient passes through 4 roundings, its product with 1 − 32u through one more.
    ///
    /// f₀ > f₁ is required: otherwise, if rounding gives f₁ ≤ T and f₀ ≤ f₁, the quotient has no meaning. If flushing makes it
    /// 0/0, or rounding gives f₀ ≤ T, nothing is proven.
    #[inline(always)]
    #[must_use]
    pub fn apart_along(&self, direction: &Direction<L>, positions: &[Vector<L>; N], among: L::Mask) -> Proven<L> {
        let Direction { w, bar } = *direction;
        let zero = bar.splat(L::Scalar::ZERO);
        let mut is_apart = among;
        let mut until = beyond(bar);
        // There is no loop: with several lanes, the compiler would not unroll it.
        macro_rules! corner {
            ($index:literal) => {
                if let (Some(&[start, end]), Some(&position)) = (self.ends.get($index), positions.get($index)) {
                    is_apart = is_apart & w.dot(position).greater(bar);
                    if L::may_leave(is_apart) {
                        return Proven { is_apart, until };
                    }
                    let at_end = w.dot(end);
                    let stays = at_end.greater(bar);
                    if !L::may_leave(!stays) {
                        let at_start = w.dot(start);
                        let quotient = (at_start - bar) / (at_start - at_end) * less_roundoffs(bar, 32);
                        is_apart = is_apart & (stays | at_start.greater(at_end) & quotient.greater(zero));
                        until = L::select(stays, until, quotient.smaller(until));
                    }
                }
            };
        }
        corner!(0);
        corner!(1);
        corner!(2);
        corner!(3);
        Proven { is_apart, until }
    }
}

/// Returns whether a direction that turns from `before` to `after`, while the corners move from `from` to `to`, keeps the pair
/// apart throughout.
///
/// Both move linearly, so each product is quadratic, with the Bernstein coefficients w₀·e₀, ½(w₀·e₁ + w₁·e₀) and w₁·e₁. The bound
/// s·|w| lies below the line between its values at the ends, whose middle coefficient is the mean. All three coefficients above
/// the bar prove it, where the bar of the middle one is the mean of the two. Its error is at most 8ε times the mean of S₀ and S₁.
#[inline(always)]
#[must_use]
pub fn are_apart_turning<L: Lanes, const N: usize>(
    before: &Direction<L>,
    from: &[Vector<L>; N],
    after: &Direction<L>,
    to: &[Vector<L>; N],
) -> L::Mask {
    let middle_bar = before.bar + after.bar;
    let mut are_apart = everywhere(middle_bar);
    for (from, to) in from.iter().zip(to) {
        are_apart = are_apart & before.w.dot(*from).greater(before.bar);
        are_apart = are_apart & after.w.dot(*to).greater(after.bar);
        are_apart = are_apart & (before.w.dot(*to) + after.w.dot(*from)).greater(middle_bar);
        if L::may_leave(are_apart) {
            break;
        }
    }
    are_apart
}

/// Returns whether a direction that moves on a quadratic curve keeps the pair apart throughout, as [`are_apart_turning`] does for
/// a straight line. Its control points are the first of `curve`, half of the second, and the third.
///
/// Each product is cubic, with the Bernstein coefficients w₀·e₀, ⅓(w₀·e₁ + m·e₀), ⅓(m·e₁ + w₁·e₀) and w₁·e₁, m the second of
/// `curve`. s·|w| lies below the quadratic curve with the control values s·|w₀|, ½s·|m| and s·|w₁|. Its cubic coefficients in the
/// middle are a third of s·|w₀| + s·|m| and of s·|m| + s·|w₁|. So the sums of two products must exceed the sums of two bars.
#[inline(always)]
#[must_use]
pub fn are_apart_curving<L: Lanes, const N: usize>(
    curve: &[Direction<L>; 3],
    from: &[Vector<L>; N],
    to: &[Vector<L>; N],
) -> L::Mask {
    let [before, middle, after] = curve;
    let (first_bar, second_bar) = (before.bar + middle.bar, middle.bar + after.bar);
    let mut are_apart = everywhere(first_bar);
    for (from, to) in from.iter().zip(to) {
        are_apart = are_apart & before.w.dot(*from).greater(before.bar);
        are_apart = are_apart & after.w.dot(*to).greater(after.bar);
        are_apart = are_apart & (before.w.dot(*to) + middle.w.dot(*from)).greater(first_bar);
        are_apart = are_apart & (middle.w.dot(*to) + after.w.dot(*from)).greater(second_bar);
        if L::may_leave(are_apart) {
            break;
        }
    }
    are_apart
}

/// Returns the length of `w`, or more, up to 8 roundings. If the squares of its components may underflow, it is the sum of their
/// magnitudes and μ, which exceeds what flushing takes from the sum.
#[inline(always)]
fn length_above<L: Lanes>(w: Vector<L>) -> L {
    let squared = w.dot(w);
    let magnitudes = w.abs();
    // Flushed squares are less than a 2⁻²⁴th (2⁻⁵³th) of this.
    let is_safe = squared.greater(squared.splat(L::Scalar::SAFE_SQUARE));
    let vanishing = squared.splat(L::Scalar::EXTENT_UNDERFLOW);
    let sum = (magnitudes.x + magnitudes.y) + (magnitudes.z + vanishing);
    L::select(is_safe, squared.sqrt(), sum)
}

/// Returns a mask that is true in each lane.
#[inline(always)]
fn everywhere<L: Lanes>(like: L) -> L::Mask {
    like.splat(L::Scalar::ONE).greater(like.splat(L::Scalar::ZERO))
}

#[cfg(test)]
mod tests {
    use super::length_above;
    use crate::vector::Vector;

    /// A thread that flushes results makes zero of a sum of subnormal numbers, and keeps a product with the direction.
    #[test]
    fn a_length_that_flushing_would_make_zero_is_not_zero() {
        let subnormal = f32::MIN_POSITIVE / 2.0;
        let vector = Vector::new(subnormal, 0.0, 0.0);
        assert!(length_above(vector) > 1000.0 * f32::MIN_POSITIVE);
    }

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
