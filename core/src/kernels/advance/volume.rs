//! Proofs by the signed volume that a pair is apart: where the four points are not coplanar, they do not touch.
//!
//! The volume is the determinant of the first three corners, K = e₀·(e₁ × e₂), a cubic in Bernstein form
//! ([`coplanarity`](crate::coplanarity)). The distance of the planes is |K|/|n| with n = (e₀ − e₁) × (e₀ − e₂), the normal of the
//! face or of the two edges' directions. So K > s·|n| keeps them farther apart than s. The lengths of its own control points,
//! raised to the third degree, bound |n|.
//!
//! # Rounding
//! ε is that of the [corners](super::corners), S₃ the permanent of the three rows M M M. A monomial of a control value passes
//! through at most 12 roundings: 3 differences, product, difference, sum of two vectors, product, two additions, one addition
//! more, and a third (rounded itself) in the middle ones. Blossoming to [t, 1] adds 9 (three times 1 − t, product, sum),
//! subtracting the bound 1, looking ahead 9: 31εS₃ ≤ 62uS₃ in any direction. **E = 64u·Ŝ₃ + η(1 + M)²**, M here the largest
//! component.
//!
//! Underflow: let λ be the smallest normal number. The losses in 9 components of differences, 3λ each, enter with two factors of
//! M twice: at most 54λM². Losses in 6 products of a cross product and 3 subtractions enter with one M, the rest with none. This
//! is at most 63λ(1 + M)² for a control value (for 3k₁ three times that and three more, divided by three). The 36 operations that
//! follow lose 36λ. η ≥ 2⁷λ covers it.
//!
//! If s > 0, the normal matters. Its components pass through at most 13 roundings (of a corner, a difference of two, 3 by
//! interpolation, twice; product, difference, sum), each of magnitude at most 8 M_j M_k. That is less than
//! 512u(M_x M_y + M_y M_z + M_z M_x) for the vector, even with the 9 roundings of looking ahead, since the length itself is at
//! most 8 times that sum. It passes through a handful more, which a factor 1 + 64u covers. A length whose squares underflow, less
//! than 2⁻⁶² (2⁻⁵¹⁰), is covered by adding that.

use super::corners::Corners;
use super::directions::beyond;
use crate::coplanarity::MovingTetrahedron;
use crate::lanes::{Lanes, Rounding, less_roundoffs, more_roundoffs, roundoffs};
use crate::separation_lanes::SeparationLanes;
use crate::vector::Vector;

/// The cubic, its error and the normal.
#[derive(Clone, Copy, Debug)]
pub struct SignedVolume<L> {
    /// The four control values; the middle ones are not tripled.
    pub values: [L; 4],
    /// The error bound E of a control value.
    pub error: L,
    normal: Normal<L>,
}

/// The two edges at the first corner, at the start and at the end, and the weight of their cross product. Zero if the separation
/// is.
#[derive(Clone, Copy, Debug)]
struct Normal<L> {
    first: [Vector<L>; 2],
    second: [Vector<L>; 2],
    length_error: L,
    separation: L,
    is_positive: bool,
}

/// One step of [clipping](SignedVolume::clipped).
#[derive(Clone, Copy, Debug)]
pub struct Clipped<L: Lanes> {
    /// The lanes in which the volume proves that the pair is apart to the end of the step.
    pub to_the_end: L::Mask,
    /// The time until which it proves that otherwise; no later than the given time if it proves nothing.
    pub until: L,
}

impl<L: Lanes> SignedVolume<L> {
    /// Computes the volume of the first three corners, for pairs that must stay farther apart than `separation`.
    #[inline(always)]
    #[must_use]
    pub fn beyond<const N: usize>(corners: &Corners<L, N>, separation: &SeparationLanes<L>) -> Self {
        let mut volume = Self::new(corners);
        if let &[p, b, c, ..] = corners.ends.as_slice()
            && separation.is_positive()
        {
            volume.normal = Normal::new(corners.extent, [p, b, c], separation.length());
        }
        volume
    }

    /// Computes the volume of the first three corners, for pairs that must not touch.
    #[inline(always)]
    #[must_use]
    pub fn new<const N: usize>(corners: &Corners<L, N>) -> Self {
        let m = corners.extent;
        let &[p, b, c, ..] = corners.ends.as_slice() else {
            // There are at least three corners, and this value proves nothing.
            let (values, error) = ([m.x.splat(L::Scalar::ZERO); 4], m.x.splat(L::Scalar::INFINITY));
            let normal = Normal::zero(error);
            return Self { values, error, normal };
        };
        let [k0, k1, k2, k3] = MovingTetrahedron { b, c, p }.control_values().0;
        let third = third(k0);
        let permanent = m.dot(m.cross_permanent(m));
        let sixty_four = roundoffs(m.x, 64);
        let size = m.x.splat(L::Scalar::ONE) + m.largest();
        let error = sixty_four * permanent + m.x.splat(L::Scalar::UNDERFLOW) * (size * size);
        Self {
            values: [k0, k1 * third, k2 * third, k3],
            error,
            normal: Normal::zero(error),
        }
    }

    /// Returns whether the volume proves that the pair is apart at all times.
    #[inline(always)]
    #[must_use]
    pub fn proves_apart_throughout(&self) -> L::Mask {
        let zero = self.error.splat(L::Scalar::ZERO);
        let [m0, m1, m2, m3] = self.margins_from(zero);
        m0.greater(zero) & m1.greater(zero) & m2.greater(zero) & m3.greater(zero)
    }

    /// Returns whether its values at two times certainly have opposite signs. It requires a separation of zero.
    #[inline(always)]
    #[must_use]
    pub fn has_opposite_signs_at(&self, from: L, to: L) -> L::Mask {
        let (before, after, error) = (self.at(from), self.at(to), self.error);
        (before.greater(error) & (-after).greater(error)) | ((-before).greater(error) & after.greater(error))
    }

    /// Evaluates the cubic by de Casteljau's rule: 9 roundings after the 12 of a control value.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, time: L) -> L {
        let [k0, k1, k2, k3] = self.values;
        let part = Part::new(time);
        let (a0, a1, a2) = (part.of(k0, k1), part.of(k1, k2), part.of(k2, k3));
        part.of(part.of(a0, a1), part.of(a1, a2))
    }

    /// Returns the time until which the volume proves, from `time` on, that the pair is apart: one step.
    ///
    /// The part of the cubic from there to the end, less its bounds, lies above the lower hull of its control polygon. The hull's
    /// first zero is the next time. Its quotients pass through at most 8 roundings, which a factor 1 − 32u covers, and the last
    /// addition through two. The hull of the whole rest is coarse. If the part that is sixteen, or four, times as long has only
    /// positive control values, that part is taken instead.
    #[inline(always)]
    #[must_use]
    pub fn clipped(&self, time: L) -> Clipped<L> {
        let zero = time.splat(L::Scalar::ZERO);
        let margins @ [m0, m1, m2, m3] = self.margins_from(time);
        let is_apart = m0.greater(zero);
        let to_the_end = is_apart & m1.greater(zero) & m2.greater(zero) & m3.greater(zero);
        if L::may_leave(is_apart & !to_the_end) {
            return Clipped { to_the_end, until: time };
        }
        let part = looking_ahead(margins, first_zero_of_hull(margins));
        let rest = time.splat(L::Scalar::ONE) - time;
        let next = (time + part * rest * less_roundoffs(time, 32)) * less_roundoffs(time, 8);
        let until = L::select(is_apart & next.greater(time), next, time);
        Clipped { to_the_end, until }
    }

    /// Returns the control values on [`time`, 1], with the sign that makes the first positive, less the values that they must
    /// exceed. They prove something only where the first of these margins is positive.
    #[inline(always)]
    #[must_use]
    pub fn margins_from(&self, time: L) -> [L; 4] {
        let [k0, k1, k2, k3] = self.values;
        let part = Part::new(time);
        let (a0, a1, b2) = (part.of(k0, k1), part.of(k1, k2), part.of(k2, k3));
        let (c0, b1) = (part.of(a0, a1), part.of(a1, b2));
        let b0 = part.of(c0, b1);
        let is_negative = time.splat(L::Scalar::ZERO).greater(b0);
        let [e0, e1, e2, e3] = self.bars_from(time);
        [
            L::select(is_negative, -b0, b0) - e0,
            L::select(is_negative, -b1, b1) - e1,
            L::select(is_negative, -b2, b2) - e2,
            L::select(is_negative, -k3, k3) - e3,
        ]
    }

    /// Returns the values that the control values on [`time`, 1] must exceed.
    #[inline(always)]
    fn bars_from(&self, time: L) -> [L; 4] {
        let normal = &self.normal;
        if !normal.is_positive {
            return [self.error; 4];
        }
        let [m0, m1, m2] = normal.lengths_from(time);
        let (third, two) = (third(time), time.splat(L::Scalar::small(2)));
        [m0, (m0 + two * m1) * third, (two * m1 + m2) * third, m2]
            .map(|length| self.error + normal.separation * (length + normal.length_error))
    }
}

impl<L: Lanes> Normal<L> {
    /// Computes the normal of three corners, of a pair with extent `m`.
    #[inline(always)]
    fn new(m: Vector<L>, [[p0, p1], [b0, b1], [c0, c1]]: [[Vector<L>; 2]; 3], separation: L) -> Self {
        let areas = (m.x * m.y + m.y * m.z) + m.z * m.x;
        let (eight, vanishing) = (m.x.splat(L::Scalar::small(8)), m.x.splat(L::Scalar::LENGTH_UNDERFLOW));
        Self {
            first: [p0 - b0, p1 - b1],
            second: [p0 - c0, p1 - c1],
            length_error: eight * roundoffs(m.x, 64) * areas + vanishing,
            separation: separation * more_roundoffs(separation, 64),
            is_positive: true,
        }
    }

    #[inline(always)]
    fn zero(like: L) -> Self {
        let zero = like.splat(L::Scalar::ZERO);
        let vector = Vector::new(zero, zero, zero);
        Self {
            first: [vector; 2],
            second: [vector; 2],
            length_error: zero,
            separation: zero,
            is_positive: false,
        }
    }

    /// Returns the lengths of the quadratic normal's control points on [`time`, 1], rounded.
    #[inline(always)]
    fn lengths_from(&self, time: L) -> [L; 3] {
        let ([b0, b1], [c0, c1]) = (self.first, self.second);
        let rest = time.splat(L::Scalar::ONE) - time;
        let b = b0.scaled(rest) + b1.scaled(time);
        let c = c0.scaled(rest) + c1.scaled(time);
        let middle = (b.cross(c1) + b1.cross(c)).scaled(time.splat(L::Scalar::HALF));
        let length = |normal: Vector<L>| normal.dot(normal).sqrt();
        [length(b.cross(c)), length(middle), length(b1.cross(c1))]
    }
}

/// A part of an interval, and the rest.
#[derive(Clone, Copy)]
struct Part<L> {
    rest: L,
    part: L,
}

impl<L: Lanes> Part<L> {
    #[inline(always)]
    fn new(part: L) -> Self {
        let rest = part.splat(L::Scalar::ONE) - part;
        Self { rest, part }
    }

    #[inline(always)]
    fn of(self, a: L, b: L) -> L {
        self.rest * a + self.part * b
    }
}

#[inline(always)]
fn third<L: Lanes>(like: L) -> L {
    like.splat(L::Scalar::ONE) / like.splat(L::Scalar::small(3))
}

/// Returns where the lower hull of the control polygon over [0, 1] first reaches zero, for a positive first value; [`beyond`] if
/// it does not.
///
/// The hull's lower side crosses zero on a line. It leads from one of the positive points before the first other point to a point
/// that is not positive. Every such line crosses no earlier. (Lines from the first point alone are not enough.)
#[inline(always)]
fn first_zero_of_hull<L: Lanes>([b0, b1, b2, b3]: [L; 4]) -> L {
    let (zero, one) = (b0.splat(L::Scalar::ZERO), b0.splat(L::Scalar::ONE));
    let (two, three) = (b0.splat(L::Scalar::small(2)), b0.splat(L::Scalar::small(3)));
    let third = third(b0);
    let (p1, p2, p3) = (b1.greater(zero), b2.greater(zero), b3.greater(zero));
    let mut first = beyond(b0);
    // This is a macro, because a closure is not always inlined.
    macro_rules! line {
        ($where:expr, $zero:expr) => {{
            let crosses = $where;
            if !L::may_leave(crosses) {
                first = L::select(crosses, first.smaller($zero), first);
            }
        }};
    }
    line!(!p1, b0 / (three * (b0 - b1)));
    line!(!p2, b0 * two / (three * (b0 - b2)));
    line!(!p3, b0 * three / (three * (b0 - b3)));
    line!(p1 & !p2, (one + b1 / (b1 - b2)) * third);
    line!(p1 & !p3, (one + two * (b1 / (b1 - b3))) * third);
    line!(p1 & p2 & !p3, (two + b2 / (b2 - b3)) * third);
    first
}

/// Returns `first_zero`, or sixteen or four times as much if the part of the cubic before that has only positive control values.
#[inline(always)]
fn looking_ahead<L: Lanes>(values: [L; 4], first_zero: L) -> L {
    let sixteen = first_zero.splat(L::Scalar::small(16)) * first_zero;
    let holds = is_positive_before(values, sixteen);
    if L::may_leave(!holds) {
        return sixteen;
    }
    let four = first_zero.splat(L::Scalar::small(4)) * first_zero;
    let four = L::select(is_positive_before(values, four), four, first_zero);
    L::select(holds, sixteen, four)
}

/// Returns whether the part of the cubic before `time` has only positive control values; `time` must lie inside the step.
#[inline(always)]
fn is_positive_before<L: Lanes>([b0, b1, b2, b3]: [L; 4], time: L) -> L::Mask {
    let zero = time.splat(L::Scalar::ZERO);
    let part = Part::new(time);
    let is_inside = part.rest.greater(zero);
    if L::may_leave(is_inside) {
        return is_inside;
    }
    let (a0, a1, a2) = (part.of(b0, b1), part.of(b1, b2), part.of(b2, b3));
    let (c0, c1) = (part.of(a0, a1), part.of(a1, a2));
    is_inside & a0.greater(zero) & c0.greater(zero) & part.of(c0, c1).greater(zero)
}

/// A value on the bound is not beyond it.
#[cfg(test)]
mod tests {
    use super::{Normal, SignedVolume, first_zero_of_hull, looking_ahead};

    fn volume(values: [f64; 4], error: f64) -> SignedVolume<f64> {
        SignedVolume {
            values,
            error,
            normal: Normal::zero(error),
        }
    }

    #[test]
    fn a_control_value_at_the_bound_proves_nothing() {
        assert!(volume([2.0; 4], 1.0).proves_apart_throughout());
        for place in 0..4 {
            let mut values = [2.0; 4];
            values[place] = 1.0;
            assert!(!volume(values, 1.0).proves_apart_throughout(), "{place}");
        }
    }

    #[test]
    fn a_value_at_the_bound_has_no_sign() {
        let falls = |from: f64, to: f64| volume([from, 0.0, 0.0, to], 1.0);
        for (from, to, are_opposite) in [(2.0, -2.0, true), (1.0, -2.0, false), (2.0, -1.0, false)] {
            assert_eq!(falls(from, to).has_opposite_signs_at(0.0, 1.0), are_opposite);
            assert_eq!(falls(-from, -to).has_opposite_signs_at(0.0, 1.0), are_opposite);
        }
    }

    #[test]
    fn a_hull_that_comes_down_to_zero_has_a_first_zero_there() {
        assert_eq!(first_zero_of_hull([1.0; 4]), 2.0);
        let near = |values: [f64; 4], expected: f64| {
            let found = first_zero_of_hull(values);
            assert!((found - expected).abs() < 1e-15, "{found:?}");
        };
        near([1.0, 0.0, 1.0, 1.0], 1.0 / 3.0);
        near([1.0, 1.0, 0.0, 1.0], 2.0 / 3.0);
        near([1.0, 1.0, 1.0, 0.0], 1.0);
    }

    /// The first zero of the hull is so small that it underflows.
    #[test]
    fn where_time_stands_still_nothing_is_proven() {
        let found = volume([5e-324, -1.0, -1.0, -1.0], 0.0).clipped(0.0);
        assert!(!found.to_the_end && found.until == 0.0, "{found:?}");
    }

    #[test]
    fn a_part_with_a_control_value_of_zero_is_not_taken() {
        // The whole step cannot be left out.
        assert_eq!(looking_ahead([1.0; 4], 1.0 / 16.0), 0.25);
        // The control values of the first half are 1, 0, ½, …; 1, ½, 0, …; 1, ½, ½, 0.
        for values in [[1.0, -1.0, 3.0, 3.0], [1.0, 0.0, -1.0, 9.0], [1.0, 0.0, 1.0, -4.0]] {
            assert_eq!(looking_ahead(values, 1.0 / 32.0), 0.125, "{values:?}");
        }
        assert_eq!(looking_ahead([1.0, 0.0, 1.0, -3.0], 1.0 / 32.0), 0.5);
    }
}
