//! Inside functions: one set stays outside of the other throughout the step, though all four points may become coplanar.
//!
//! The corners of a pair (differences of a point of one set and a point of the other) are those of a triangle for VF and of a
//! parallelogram for EE; the sets touch when it contains the origin. Take the corners e_k in cyclic order. Where the origin is in the
//! polygon, each turn e_k × e_(k+1) around it is a multiple, not negative, of the sum N of all turns, which is twice the polygon's area
//! vector:
//!
//! ```text
//!   q_k = (e_k × e_(k+1)) · N ≥ 0   for all k, whatever the polygon: without area all of them are zero
//! ```
//!
//! A turn and N are quadratic in time, so q_k is a quartic in Bernstein form. If all five control values of *one* q_k are certainly
//! negative the pair never touches. That needs no root and no coplanarity: where a vertex crosses the plane of a face far outside of it,
//! [`non_coplanarity`](super::certified::non_coplanarity) keeps the pair and this culls it.
//!
//! Source: Tang, Tong, Wang, Manocha (Fast and exact continuous collision detection with Bernstein sign classification, 2014), whose
//! inside function of an edge (a, b) is ((b − a) × (p − a)) · n; it is the same, since (b − a) × (p − a) = e_a × e_b. Theirs is
//! reduced modulo the cubic and asked at its roots; here it is asked about the whole step, as a culling test, before any root is
//! looked for.
//!
//! # Rounding
//! (Any direction: 2u an operation.) A monomial of a control value passes through 5 roundings in the turn (two differences, product,
//! difference, the sum in the middle), 7 in N (two additions more), 3 in the product of the two and 2 where such products are
//! added: 17, 34u to first order. With M the largest |e| along each axis, over all corners and both ends, and A = M × M with all signs
//! positive, a turn's component is at most A_k, N's at most 4·A_k; the control values, as computed once, four, six, four and once as
//! large as they are, are at most 4, 16, 24, 16 and 4 times A·A. Hence **T = 160u·A·A + η(1 + M)⁴** for the first, M there the
//! largest component, and 4, 6, 4 and 1 times that for the others: 40u for the 34u, which covers what is of second order and the rounding
//! of T.
//!
//! Underflow: λ the smallest normal number, a difference is off by 3λ, a component of a turn by (12M + 3)λ, in the middle by (24M + 7)λ,
//! of N by (48M + 15)λ and (96M + 31)λ. With the magnitudes above, the control value in the middle is off by at most
//! (3456M³ + 1032M² + 17)λ, six times less than 150λ(1 + M)⁴ each, and the others by no more: η ≥ 512λ.
//!
//! Only M < ½ [`Rounding::LARGEST_EDGE`] culls (2²⁹, `f64` 2²⁴⁹): 24·A·A is then below 2¹²⁵ (2¹⁰⁰⁵).

use crate::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;
use crate::verdict::Verdict;

/// Culls `pair` if one of its inside functions is certainly negative throughout the step.
///
/// Certified: never culls what touches. NaN, infinite and very large coordinates keep the pair.
///
/// ```
/// use selvedge_core::{filter::{certified, inside}, glam::DVec3, Motion, Verdict, PrimitivePair};
/// // A vertex that falls through the plane of a resting triangle, beside it.
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.8, 0.8, 1.0), DVec3::new(0.8, 0.8, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// assert_eq!(certified::non_coplanarity(&pair), Verdict::Kept);
/// assert_eq!(inside::never_inside(&pair), Verdict::Culled);
/// ```
#[inline(always)]
pub fn never_inside<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).are_outside_of_one_side::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// The decision of [`never_inside`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn are_outside_of_one_side<P: PairShape>(&self) -> L::Mask {
        let [a0, b0, c0, d0] = P::corners(self.start);
        let [a1, b1, c1, d1] = P::corners(self.end);
        let extent = a0.abs().larger(b0.abs()).larger(c0.abs().larger(d0.abs()));
        let extent = extent.larger(a1.abs().larger(b1.abs()).larger(c1.abs().larger(d1.abs())));
        let limit = Limit::of(extent);
        let (a, b, c, d) = ([a0, a1], [b0, b1], [c0, c1], [d0, d1]);
        let outside = match P::KIND {
            // The first corner stands twice.
            PairKind::VertexFace => {
                let (first, second, third) = (Turn::of(b, c), Turn::of(c, d), Turn::of(d, b));
                let all = first.plus(&second).plus(&third);
                first.is_negative(&all, &limit) | second.is_negative(&all, &limit) | third.is_negative(&all, &limit)
            }
            // 00, 01, 11, 10: the last two stand in the other order.
            PairKind::EdgeEdge => {
                let (first, second) = (Turn::of(a, b), Turn::of(b, d));
                let (third, fourth) = (Turn::of(d, c), Turn::of(c, a));
                let all = first.plus(&second).plus(&third.plus(&fourth));
                (first.is_negative(&all, &limit) | second.is_negative(&all, &limit))
                    | (third.is_negative(&all, &limit) | fourth.is_negative(&all, &limit))
            }
        };
        let largest = extent.largest();
        let half = largest.splat(L::Scalar::HALF) * largest.splat(L::Scalar::LARGEST_EDGE);
        outside & half.greater(largest) & self.is_finite()
    }
}

/// −T, −4T and −6T of the module's documentation.
struct Limit<L> {
    once: L,
    four: L,
    six: L,
}

impl<L: Lanes> Limit<L> {
    #[inline(always)]
    fn of(extent: Vector<L>) -> Self {
        let constant = |count| extent.x.splat(L::Scalar::small(count));
        let areas = extent.cross_permanent(extent);
        let size = constant(1) + extent.largest();
        let squared = size * size;
        let once = constant(160) * extent.x.splat(L::Scalar::UNIT_ROUNDOFF) * areas.dot(areas)
            + extent.x.splat(L::Scalar::UNDERFLOW) * (squared * squared);
        Self {
            once: -once,
            four: -(constant(4) * once),
            six: -(constant(6) * once),
        }
    }
}

/// The cross product of two moving corners: its control values, twice as large in the middle.
struct Turn<L> {
    start: Vector<L>,
    middle: Vector<L>,
    end: Vector<L>,
}

impl<L: Lanes> Turn<L> {
    #[inline(always)]
    fn of([from_0, from_1]: [Vector<L>; 2], [to_0, to_1]: [Vector<L>; 2]) -> Self {
        Self {
            start: from_0.cross(to_0),
            middle: from_0.cross(to_1) + from_1.cross(to_0),
            end: from_1.cross(to_1),
        }
    }

    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        Self {
            start: self.start + other.start,
            middle: self.middle + other.middle,
            end: self.end + other.end,
        }
    }

    /// Whether the product with `all` is certainly negative throughout.
    #[inline(always)]
    fn is_negative(&self, all: &Self, limit: &Limit<L>) -> L::Mask {
        let first = self.start.dot(all.start);
        let second = self.start.dot(all.middle) + self.middle.dot(all.start);
        let third = (self.start.dot(all.end) + self.end.dot(all.start)) + self.middle.dot(all.middle);
        let fourth = self.middle.dot(all.end) + self.end.dot(all.middle);
        let fifth = self.end.dot(all.end);
        (limit.once.greater(first) & limit.four.greater(second) & limit.six.greater(third))
            & (limit.four.greater(fourth) & limit.once.greater(fifth))
    }
}

#[cfg(test)]
mod tests {
    use super::never_inside;
    use crate::{Motion, PrimitivePair, Verdict};
    use glam::DVec3;

    /// Through the plane z = 0 at (x, y), where the triangle is x, y ≥ 0, x + y ≤ 1.
    fn fall(x: f64, y: f64) -> PrimitivePair<f64> {
        PrimitivePair::vertex_face(
            Motion::new(DVec3::new(x, y, 1.0), DVec3::new(x, y, -1.0)),
            [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
        )
    }

    #[test]
    fn a_vertex_that_falls_beside_the_face_is_culled_and_one_that_hits_it_is_kept() {
        for (x, y) in [(-0.1, 0.5), (0.5, -0.1), (0.6, 0.6), (-3.0, -4.0)] {
            assert_eq!(never_inside(&fall(x, y)), Verdict::Culled, "{x}, {y}");
        }
        for (x, y) in [(0.2, 0.2), (0.0, 0.5), (0.5, 0.5), (1.0, 0.0)] {
            assert_eq!(never_inside(&fall(x, y)), Verdict::Kept, "{x}, {y}");
        }
    }

    #[test]
    fn edges_that_cross_beyond_their_ends_are_culled_and_touching_ones_kept() {
        let pair = |x: f64| {
            PrimitivePair::edge_edge(
                [DVec3::NEG_X, DVec3::X].map(Motion::resting),
                [DVec3::NEG_Y, DVec3::Y].map(|end| {
                    let end = end + x * DVec3::X;
                    Motion::new(end + DVec3::Z, end - DVec3::Z)
                }),
            )
        };
        for x in [1.5, -1.5] {
            assert_eq!(never_inside(&pair(x)), Verdict::Culled);
        }
        for x in [0.0, 1.0, -1.0] {
            assert_eq!(never_inside(&pair(x)), Verdict::Kept);
        }
    }

    #[test]
    fn what_is_not_finite_too_large_or_without_area_is_kept() {
        for value in [f64::NAN, f64::INFINITY, f64::MAX, 1e80] {
            assert_eq!(never_inside(&fall(value, 0.1)), Verdict::Kept, "{value}");
        }
        let mut flat = fall(3.0, 3.0);
        let [a, b, c] = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X].map(Motion::resting);
        flat.motions = [flat.motions[0], a, b, c];
        assert_eq!(never_inside(&flat), Verdict::Kept);
    }

    #[test]
    fn beyond_half_of_the_largest_edge_everything_is_kept() {
        // The corners' largest coordinate is twice the size.
        let sized = |size: f64| {
            let mut pair = fall(-1.0, -1.0);
            for motion in &mut pair.motions {
                *motion = Motion::new(motion.start * size, motion.end * size);
            }
            pair
        };
        let half = 2.0_f64.powi(249);
        assert_eq!(never_inside(&sized(0.49 * half)), Verdict::Culled);
        assert_eq!(never_inside(&sized(0.51 * half)), Verdict::Kept);
    }
}
