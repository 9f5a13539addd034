//! Proof that the pair is apart, by its signed volume: where the four points are not coplanar they do not touch.
//!
//! The volume is the determinant of the first three corners, K = e₀·(e₁ × e₂), a cubic in Bernstein form
//! ([`coplanarity`](crate::coplanarity)). Its distance of the planes is |K|/|n| with n = (e₀ − e₁) × (e₀ − e₂), the normal of the
//! face or of the two edges' directions; so K > s·|n| keeps them farther apart than s. |n| is bounded by the lengths of its own
//! control points, raised to the third degree.
//!
//! # Rounding
//! ε as for the [corners](crate::elementary::corners), S₃ the permanent of the three rows M M M. A monomial of a control value passes
//! through at most 12 roundings: 3 differences, product, difference, sum of two vectors, product, two additions, one
//! addition more, and a third (rounded itself) in the middle ones. Blossoming to [t, 1] adds 9 (three times 1 − t,
//! product, sum), subtracting the bound 1, looking ahead 9: 31εS₃ ≤ 62uS₃ in any direction. **E = 64u·Ŝ₃ + η(1 + M)²**, M here the
//! largest component.
//!
//! Underflow: with λ the smallest normal number, what is lost in 9 components of differences, 3λ each, enters with two factors
//! of M twice: at most 54λM²; 6 products in a cross product and 3 subtractions enter with one M, the rest with none: at most
//! 63λ(1 + M)² for a control value, as for 3k₁ three times that and three more is divided by three; and 36λ for the 36
//! operations that follow. η ≥ 2⁷λ covers it.
//!
//! Normal, where s > 0: its components pass through at most 13 roundings (of a corner, a difference of two, 3 by interpolation,
//! twice; product, difference, sum), each of magnitude at most 8 M_j M_k: less than 512u(M_x M_y + M_y M_z + M_z M_x) for the
//! vector, and its length through a handful, which a factor 1 + 64u covers. A length of which the squares
//! underflow, with less than 2⁻⁶² (2⁻⁵¹⁰), is covered by adding that.

use super::directions::Apart;
use crate::coplanarity::MovingTetrahedron;
use crate::elementary::corners::{Corners, less_roundoffs, more_roundoffs, of_format};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// How often [`SignedVolume::apart_from`] clips, at most.
pub(super) const STEPS: u8 = 8;

/// The cubic, its error and the normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct SignedVolume<S> {
    values: [S; 4],
    error: S,
    /// Of separations that are not zero.
    normal: Option<Normal<S>>,
}

/// The two edges at the first corner, at the start and at the end, and how their cross product counts.
#[derive(Clone, Copy, Debug)]
struct Normal<S> {
    first: [Vector<S>; 2],
    second: [Vector<S>; 2],
    length_error: S,
    separation: S,
}

impl<S: Scalar> SignedVolume<S> {
    #[inline(always)]
    pub(super) fn new<const N: usize>(corners: &Corners<S, N>, separation: S) -> Self {
        let &[p, b, c, ..] = corners.ends.as_slice() else {
            // There are three at least. This proves nothing.
            let (values, error, normal) = ([S::ZERO; 4], S::INFINITY, None);
            return Self { values, error, normal };
        };
        let [k0, k1, k2, k3] = MovingTetrahedron { b, c, p }.control_values().0;
        let third = third();
        let m = corners.extent;
        let permanent = m.dot(m.cross_permanent(m));
        let sixty_four = S::small(64) * S::UNIT_ROUNDOFF;
        let size = S::ONE + m.largest();
        let error = sixty_four * permanent + S::UNDERFLOW * (size * size);
        let normal = (separation > S::ZERO).then(|| {
            let [[p0, p1], [b0, b1], [c0, c1]] = [p, b, c];
            let areas = (m.x * m.y + m.y * m.z) + m.z * m.x;
            Normal {
                first: [p0 - b0, p1 - b1],
                second: [p0 - c0, p1 - c1],
                length_error: S::small(8) * sixty_four * areas + of_format(-62, -510),
                separation: separation * more_roundoffs(64),
            }
        });
        Self {
            values: [k0, k1 * third, k2 * third, k3],
            error,
            normal,
        }
    }

    /// Whether the volume proves that the pair is apart at all times.
    #[inline(always)]
    pub(super) fn proves_apart_throughout(&self) -> bool {
        let margins = self.margins_from(S::ZERO);
        margins.is_some_and(|[_, b1, b2, b3]| b1 > S::ZERO && b2 > S::ZERO && b3 > S::ZERO)
    }

    /// Whether its values at two times certainly have opposite signs. (Needs a separation of zero.)
    #[inline(always)]
    pub(super) fn has_opposite_signs_at(&self, from: S, to: S) -> bool {
        let (before, after, error) = (self.at(from), self.at(to), self.error);
        (before > error && -after > error) || (-before > error && after > error)
    }

    /// De Casteljau's rule: 9 roundings after the 12 of a control value.
    #[inline(always)]
    fn at(&self, time: S) -> S {
        let [k0, k1, k2, k3] = self.values;
        let rest = S::ONE - time;
        let mix = |a: S, b: S| rest * a + time * b;
        let (a0, a1, a2) = (mix(k0, k1), mix(k1, k2), mix(k2, k3));
        mix(mix(a0, a1), mix(a1, a2))
    }

    /// Until when the volume proves, from `time` on, that the pair is apart.
    ///
    /// The part of the cubic from there to the end, less its bounds, lies above the lower hull of its control polygon, whose
    /// first zero is the next `time`; its quotients pass through at most 8 roundings, for which a factor 1 − 32u makes up, the last
    /// addition for two. The hull of all that is left is coarse: where the part that is sixteen, or four, times as
    /// long has only positive control values, that is taken instead.
    #[inline(always)]
    pub(super) fn apart_from(&self, time: S, steps: &mut u32) -> Apart<S> {
        let mut time = time;
        let mut proven = Apart::Unproven;
        for _ in 0..STEPS {
            *steps += 1;
            let Some(margins) = self.margins_from(time) else {
                return proven;
            };
            let Some(first_zero) = first_zero_of_hull(margins) else {
                return Apart::ToTheEnd;
            };
            let part = looking_ahead(margins, first_zero);
            let next = (time + part * (S::ONE - time) * less_roundoffs(32)) * less_roundoffs(8);
            if !(next > time) {
                return proven;
            }
            let step = next - time;
            time = next;
            proven = Apart::Until(time);
            // Steps as short as rounding errors lead nowhere.
            if !(step > S::small(16) * S::UNIT_ROUNDOFF) {
                return proven;
            }
        }
        proven
    }

    /// The control values on [`time`, 1], in whichever sign makes the first positive, less what they must exceed; `None` unless
    /// the first exceeds it.
    #[inline(always)]
    fn margins_from(&self, time: S) -> Option<[S; 4]> {
        let [k0, k1, k2, k3] = self.values;
        let rest = S::ONE - time;
        let mix = |a: S, b: S| rest * a + time * b;
        let (a0, a1, b2) = (mix(k0, k1), mix(k1, k2), mix(k2, k3));
        let (c0, b1) = (mix(a0, a1), mix(a1, b2));
        let b0 = mix(c0, b1);
        let [b0, b1, b2, b3] = if b0 < S::ZERO {
            [-b0, -b1, -b2, -k3]
        } else {
            [b0, b1, b2, k3]
        };
        let [e0, e1, e2, e3] = self.bars_from(time);
        (b0 > e0).then(|| [b0 - e0, b1 - e1, b2 - e2, b3 - e3])
    }

    /// What the control values on [`time`, 1] must exceed.
    #[inline(always)]
    fn bars_from(&self, time: S) -> [S; 4] {
        let Some(normal) = &self.normal else {
            return [self.error; 4];
        };
        let [m0, m1, m2] = normal.lengths_from(time);
        let (third, two) = (third(), S::small(2));
        [m0, (m0 + two * m1) * third, (two * m1 + m2) * third, m2]
            .map(|length| self.error + normal.separation * (length + normal.length_error))
    }
}

impl<S: Scalar> Normal<S> {
    /// The lengths of the quadratic normal's control points on [`time`, 1], rounded.
    #[inline(always)]
    fn lengths_from(&self, time: S) -> [S; 3] {
        let ([b0, b1], [c0, c1]) = (self.first, self.second);
        let rest = S::ONE - time;
        let b = b0.scaled(rest) + b1.scaled(time);
        let c = c0.scaled(rest) + c1.scaled(time);
        let middle = (b.cross(c1) + b1.cross(c)).scaled(S::from_f64(0.5));
        let length = |normal: Vector<S>| normal.dot(normal).sqrt();
        [length(b.cross(c)), length(middle), length(b1.cross(c1))]
    }
}

#[inline(always)]
fn third<S: Scalar>() -> S {
    S::from_f64(1.0 / 3.0)
}

/// Where the lower hull of the control polygon over [0, 1] comes down to zero first, for a positive first value; `None` if
/// nowhere.
///
/// The hull's lower side crosses zero on a line from one of the positive points before the first that is not to one that is not
/// positive; each such line crosses no earlier. (Lines from the first point alone would not do.)
#[inline(always)]
fn first_zero_of_hull<S: Scalar>([b0, b1, b2, b3]: [S; 4]) -> Option<S> {
    let zero = S::ZERO;
    let (third, two, three) = (third::<S>(), S::small(2), S::small(3));
    let from_0 = |b: S, thirds: S| b0 * thirds / (three * (b0 - b));
    let from_1 = |b: S, thirds: S| (S::ONE + thirds * (b1 / (b1 - b))) * third;
    let from_2 = |b: S| (two + b2 / (b2 - b)) * third;
    if !(b1 > zero) {
        let mut first = from_0(b1, S::ONE);
        if !(b2 > zero) {
            first = first.smaller(from_0(b2, two));
        }
        if !(b3 > zero) {
            first = first.smaller(from_0(b3, three));
        }
        Some(first)
    } else if !(b2 > zero) {
        let mut first = from_0(b2, two).smaller(from_1(b2, S::ONE));
        if !(b3 > zero) {
            first = first.smaller(from_0(b3, three)).smaller(from_1(b3, two));
        }
        Some(first)
    } else if !(b3 > zero) {
        let first = from_0(b3, three).smaller(from_1(b3, two));
        Some(first.smaller(from_2(b3)))
    } else {
        None
    }
}

/// `first_zero`, or sixteen or four times as much where the part of the cubic before that has positive control values only.
#[inline(always)]
fn looking_ahead<S: Scalar>([b0, b1, b2, b3]: [S; 4], first_zero: S) -> S {
    let zero = S::ZERO;
    for times in [16, 4] {
        let part = S::small(times) * first_zero;
        let rest = S::ONE - part;
        if rest > zero {
            let mix = |a: S, b: S| rest * a + part * b;
            let (a0, a1, a2) = (mix(b0, b1), mix(b1, b2), mix(b2, b3));
            let (c0, c1) = (mix(a0, a1), mix(a1, a2));
            if a0 > zero && c0 > zero && mix(c0, c1) > zero {
                return part;
            }
        }
    }
    first_zero
}

/// What lies on the bound is not beyond it.
#[cfg(test)]
mod tests {
    use super::{SignedVolume, first_zero_of_hull, looking_ahead};
    use crate::elementary::advance::directions::Apart;

    fn volume(values: [f64; 4], error: f64) -> SignedVolume<f64> {
        SignedVolume {
            values,
            error,
            normal: None,
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
        assert_eq!(first_zero_of_hull([1.0; 4]), None);
        let near = |values: [f64; 4], expected: f64| {
            let found = first_zero_of_hull(values);
            assert!(found.is_some_and(|found| (found - expected).abs() < 1e-15), "{found:?}");
        };
        near([1.0, 0.0, 1.0, 1.0], 1.0 / 3.0);
        near([1.0, 1.0, 0.0, 1.0], 2.0 / 3.0);
        near([1.0, 1.0, 1.0, 0.0], 1.0);
    }

    /// The first zero of the hull, so small that it is no number any more.
    #[test]
    fn where_time_stands_still_nothing_is_proven() {
        let found = volume([5e-324, -1.0, -1.0, -1.0], 0.0).apart_from(0.0, &mut 0);
        assert_eq!(found, Apart::Unproven);
    }

    #[test]
    fn a_part_with_a_control_value_of_zero_is_not_taken() {
        // The whole is no part that can be left.
        assert_eq!(looking_ahead([1.0; 4], 1.0 / 16.0), 0.25);
        // Control values of the first half: 1, 0, ½, …; 1, ½, 0, …; 1, ½, ½, 0.
        for values in [[1.0, -1.0, 3.0, 3.0], [1.0, 0.0, -1.0, 9.0], [1.0, 0.0, 1.0, -4.0]] {
            assert_eq!(looking_ahead(values, 1.0 / 32.0), 0.125, "{values:?}");
        }
        assert_eq!(looking_ahead([1.0, 0.0, 1.0, -3.0], 1.0 / 32.0), 0.5);
    }
}
