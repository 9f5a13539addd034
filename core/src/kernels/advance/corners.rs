//! The corners of a pair, and the error of products with them.
//!
//! The corners are the differences of the pair's points, one set's minus the other's. They are p − a, p − b, p − c for a vertex
//! and a face, aᵢ − bⱼ for two edges (in the order 00, 01, 10, 11). Two points of the two sets differ by a point of the corners'
//! convex hull, a triangle or a parallelogram. So the distance of the sets is the origin's distance from that hull, and they
//! touch when the hull contains the origin. Each corner moves linearly because the points do. Nothing below needs the points
//! themselves.
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
//! where S then belongs to both. The threshold is **T = 20u·Ŝ + η**. The four u above 16 cover the second order and the rounding
//! of Ŝ and T: some dozen roundings of numbers that are 20u times smaller.
//!
//! **Underflow.** λ is the smallest normal number. Where a thread flushes results to zero, an operation loses at most λ. Where it
//! treats subnormal operands as zero, each of them loses at most λ as well. A component of ê(t) then loses at most 6λ (3 in the
//! difference, one each in two products and a sum), and adds 6λ|w_k| to the error of the product. The product and the additions
//! lose 5λ more, T itself 8λ. μ = [`Rounding::EXTENT_UNDERFLOW`], added to each M_k, covers the first: 20u·μ ≥ 7λ. η =
//! [`Rounding::UNDERFLOW`] ≥ 2⁷λ covers the others. So a direction may have any length.
//!
//! **Overflow.** M must be at most [`LARGEST_EXTENT`](Rounding::LARGEST_EXTENT), 2²⁹ (`f32`) or 2²⁵⁰ (`f64`). Then no
//! intermediate result of a certificate comes near the largest number, which directed rounding returns instead of infinity.

use crate::lanes::{Lanes, Rounding, roundoffs};
use crate::points::{EdgeEdge, PairPoints, PairShape, VertexFace};
use crate::vector::Vector;

/// The moving corners of one pair, or of one in each lane: three or four.
#[derive(Clone, Copy, Debug)]
pub struct Corners<L, const N: usize> {
    /// Each corner at the start and at the end of the step.
    pub ends: [[Vector<L>; 2]; N],
    /// The largest magnitude M of a corner along each axis, at both ends of the step, plus μ.
    pub extent: Vector<L>,
}

impl<L: Lanes> Corners<L, 3> {
    /// Makes the corners of a vertex and a face: a triangle.
    #[inline(always)]
    #[must_use]
    pub fn of_vertex_face(points: &PairPoints<L>) -> Self {
        let [_, a0, b0, c0] = VertexFace::corners(points.start);
        let [_, a1, b1, c1] = VertexFace::corners(points.end);
        Self::new(a0.x, [[a0, a1], [b0, b1], [c0, c1]])
    }
}

impl<L: Lanes> Corners<L, 4> {
    /// Makes the corners of two edges: a parallelogram, its second and third corner opposite to each other.
    #[inline(always)]
    #[must_use]
    pub fn of_edge_edge(points: &PairPoints<L>) -> Self {
        let [a0, b0, c0, d0] = EdgeEdge::corners(points.start);
        let [a1, b1, c1, d1] = EdgeEdge::corners(points.end);
        Self::new(a0.x, [[a0, a1], [b0, b1], [c0, c1], [d0, d1]])
    }
}

impl<L: Lanes, const N: usize> Corners<L, N> {
    #[inline(always)]
    fn new(like: L, ends: [[Vector<L>; 2]; N]) -> Self {
        let mut extent = match ends.first() {
            Some([start, end]) => start.abs().larger(end.abs()),
            None => all(like.splat(L::Scalar::ZERO)),
        };
        for corner in 1..N {
            let [start, end] = ends[corner];
            extent = start.abs().larger(end.abs()).larger(extent);
        }
        let extent = extent + all(like.splat(L::Scalar::EXTENT_UNDERFLOW));
        Self { ends, extent }
    }

    /// Returns false for corners so large that products of three or four might overflow. NaN may go unnoticed.
    #[inline(always)]
    #[must_use]
    pub fn are_in_range(&self) -> L::Mask {
        let largest = self.extent.largest();
        !largest.greater(largest.splat(L::Scalar::LARGEST_EXTENT))
    }

    /// Returns the corners at `time`, rounded.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, time: L) -> [Vector<L>; N] {
        let rest = time.splat(L::Scalar::ONE) - time;
        // This is a loop, because `array::map` with a closure is not always inlined.
        let mut positions = [self.extent; N];
        for corner in 0..N {
            let [start, end] = self.ends[corner];
            positions[corner] = start.scaled(rest) + end.scaled(time);
        }
        positions
    }

    /// Returns 20u·Σ|w_k|M_k + η. A computed product of `w` with a corner at any time that exceeds this proves that the exact
    /// product is positive.
    #[inline(always)]
    #[must_use]
    pub fn product_error(&self, w: Vector<L>) -> L {
        roundoffs(w.x, 20) * w.abs().dot(self.extent) + w.x.splat(L::Scalar::UNDERFLOW)
    }
}

#[inline(always)]
fn all<L: Copy>(component: L) -> Vector<L> {
    Vector {
        x: component,
        y: component,
        z: component,
    }
}
