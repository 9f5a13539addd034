//! The corners of a pair, and how exactly products with them can be computed.
//!
//! The corners are the differences of the pair's points, one set's minus the other's: p − a, p − b, p − c for a vertex and a
//! face, aᵢ − bⱼ for two edges (in the order 00, 01, 10, 11). Two points of the two sets differ by a point of the corners'
//! convex hull, a triangle or a parallelogram. So the distance of the sets is the origin's distance from that hull, they
//! touch when the hull contains the origin, and each corner moves linearly because the points do. Nothing below needs the
//! points themselves.
//!
//! # Rounding
//! ε is the largest relative error of one operation: u where it rounds to nearest, 2u in any other direction. Let M be the
//! [extent](Corners::extent), axis by axis the largest magnitude of a corner as computed, at both ends of the step, and
//! S = Σ|w_k|M_k for a direction w. Each monomial of fl(w · ê(t)), ê(t) = fl((1 − t)ê(0) + tê(1)), passes through at most 7
//! roundings: of the difference, 1 − t, the product with it, the sum, the product with w and the two last additions. Hence
//!
//! ```text
//!  |fl(w · ê(t)) − w · e(t)| ≤ 7εS + O(ε²) ≤ 14uS + O(u²),   and 8εS ≤ 16uS + O(u²) for a sum of two such products
//! ```
//!
//! with S then belonging to both. The threshold is **T = 20u·Ŝ + η**: the four u above 16 cover what is of second order and the
//! rounding of Ŝ and T themselves, some dozen roundings of numbers that are 20u times smaller.
//!
//! **Underflow.** λ is the smallest normal number. Where a thread flushes results to zero an operation loses at most λ, and
//! where it takes subnormal operands for zero each of them loses at most λ as well. A component of ê(t) then loses at most 6λ
//! (3 in the difference, one each in two products and a sum), and adds 6λ|w_k| to the error of the product; the product and
//! the additions lose 5λ more, T itself 8λ. The first is covered by a constant μ that is added to each M_k, 20u·μ ≥ 7λ; the
//! others by η = [`Rounding::UNDERFLOW`](crate::Rounding::UNDERFLOW) ≥ 2⁷λ. So a direction may have any length.
//!
//! **Overflow.** M ≤ [`largest_extent`] is demanded, 2²⁹ (`f32`) or 2²⁵⁰ (`f64`), checked by an ordered comparison: then nothing
//! that a certificate computes comes near the largest number, which directed rounding returns instead of infinity.

use crate::lanes::power_of_two_f64;
use crate::points::{EdgeAndEdge, PairPoints, PairShape, VertexAndFace};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The moving corners of one pair: three or four.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners<S, const N: usize> {
    /// Each corner at the start and at the end of the step.
    pub(super) ends: [[Vector<S>; 2]; N],
    /// M of the module's documentation, μ included.
    pub(super) extent: Vector<S>,
}

impl<S: Scalar> Corners<S, 3> {
    /// Of a vertex and a face: a triangle.
    #[inline(always)]
    pub(super) fn of_vertex_face(points: &PairPoints<S>) -> Self {
        let [_, a0, b0, c0] = VertexAndFace::corners(points.start);
        let [_, a1, b1, c1] = VertexAndFace::corners(points.end);
        Self::new([[a0, a1], [b0, b1], [c0, c1]])
    }
}

impl<S: Scalar> Corners<S, 4> {
    /// Of two edges: a parallelogram, the second and third corner opposite to each other.
    #[inline(always)]
    pub(super) fn of_edge_edge(points: &PairPoints<S>) -> Self {
        let [a0, b0, c0, d0] = EdgeAndEdge::corners(points.start);
        let [a1, b1, c1, d1] = EdgeAndEdge::corners(points.end);
        Self::new([[a0, a1], [b0, b1], [c0, c1], [d0, d1]])
    }
}

impl<S: Scalar, const N: usize> Corners<S, N> {
    #[inline(always)]
    fn new(ends: [[Vector<S>; 2]; N]) -> Self {
        let mut extent = Vector::new(S::ZERO, S::ZERO, S::ZERO);
        for [start, end] in ends {
            extent = start.abs().larger(end.abs()).larger(extent);
        }
        let vanishing = of_format::<S>(-100, -960);
        let extent = extent + Vector::new(vanishing, vanishing, vanishing);
        Self { ends, extent }
    }

    /// False for corners so large that products of three or four might overflow. NaN may go unnoticed.
    #[inline(always)]
    pub(super) fn are_in_range(&self) -> bool {
        self.extent.largest() <= largest_extent()
    }

    /// Takes an extent of zero, in proportion to which all errors are bounded: **nothing is certified any more.**
    #[inline(always)]
    pub(super) fn forget_errors(&mut self) {
        self.extent = Vector::new(S::ZERO, S::ZERO, S::ZERO);
    }

    /// Where the corners are at `time`, rounded.
    #[inline(always)]
    pub(super) fn at(&self, time: S) -> [Vector<S>; N] {
        let rest = S::ONE - time;
        // A loop, because `array::map` with a closure is not always inlined.
        let mut positions = [Vector::new(S::ZERO, S::ZERO, S::ZERO); N];
        for (position, [start, end]) in positions.iter_mut().zip(&self.ends) {
            *position = start.scaled(rest) + end.scaled(time);
        }
        positions
    }

    /// 20u·Σ|w_k|M_k + η: a product of `w` with a corner at any time, as computed, that is larger than this proves that the
    /// exact product is positive.
    #[inline(always)]
    pub(super) fn product_error(&self, w: Vector<S>) -> S {
        S::small(20) * S::UNIT_ROUNDOFF * w.abs().dot(self.extent) + S::UNDERFLOW
    }
}

/// 2²⁹ or 2²⁵⁰: products of four numbers of eight times this size do not overflow.
#[inline(always)]
pub(crate) fn largest_extent<S: Scalar>() -> S {
    of_format(29, 250)
}

/// Two to one power in `f32`, to another in `f64`.
#[inline(always)]
pub(crate) fn of_format<S: Scalar>(single: i64, double: i64) -> S {
    let is_single = S::UNIT_ROUNDOFF > S::from_f64(f64::EPSILON);
    S::from_f64(power_of_two_f64(if is_single { single } else { double }))
}

/// So many unit roundoffs below one: a factor that makes up for the rounding of a few operations.
#[inline(always)]
pub(crate) fn less_roundoffs<S: Scalar>(count: u8) -> S {
    S::ONE - S::small(count) * S::UNIT_ROUNDOFF
}

/// So many unit roundoffs above one.
#[inline(always)]
pub(crate) fn more_roundoffs<S: Scalar>(count: u8) -> S {
    S::ONE + S::small(count) * S::UNIT_ROUNDOFF
}
