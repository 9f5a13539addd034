//! The paper's VF box test: the vertex's path, a segment, against the face's swept box, by separating axes.
//!
//! A segment and a box are disjoint exactly if one of six axes separates them. These are the box's three axes, and their cross
//! products with the segment's direction.
//!
//! **Box axes** compare coordinates, which is exact.
//!
//! **Cross axes.** Let the axis be eᵢ × d, and j, k the other two coordinates. The box's corners x lie strictly on one side of
//! the segment's line iff s(x) = (x_j − p_j)·d_k − (x_k − p_k)·d_j has one sign on all four corners of the box's projection. With
//! L = lower − p and U = upper − p, its least value is min(L_j·d_k, U_j·d_k) − max(L_k·d_j, U_k·d_j). Its largest value has min
//! and max exchanged. (The midpoint form of the textbooks cancels; this form has the small error of an orientation.)
//!
//! *Rounding* (any direction: 2u an operation). A product T of two rounded differences is computed as T̂ = T(1 + θ), so the error
//! is at most ((1 − 2u)⁻³ − 1)·|T̂| ≤ 6.1u·|T̂|. The least and the greatest of two products move by no more than the larger of
//! their errors, and the last subtraction is monotone. With Ŝ = Σ|T̂| over the four products, s > 0 follows from fl(s) > 6.1u·Ŝ +
//! underflow. The test requires fl(s) > fl(8u·Ŝ + (1 + M)·η), M the largest magnitude of a difference; the bound is at least 8u(1
//! − 2u)⁵·Ŝ.
//!
//! Where subnormal numbers are flushed, a difference is off by at most 3λ, a product by (6M + 1)·λ, and s by (12M + 3)·λ; η ≥
//! 512·λ. Only M < [`Rounding::LARGEST_EDGE`] culls, so nothing overflows.
//!
//! Inequalities are strict: touching pairs are kept, and d = 0 gives 0 > η, which is false.

use super::Aabb;
use crate::PairKind;
use crate::coplanarity::is_in_range;
use crate::lanes::{Lanes, Rounding};
use crate::motion::{Motion, PrimitivePair};
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;
use crate::verdict::Verdict;

/// Culls `pair` if the vertex's path misses the axis-aligned box that the face sweeps. Culls two edges if [their swept
/// boxes](super::swept_boxes) do not overlap. (The paper, stage 1; its *disengaging shaft* is the separating axis.)
///
/// The test is certified: it never culls a pair whose path and box share a point. NaN, infinities and overflow keep the pair.
#[inline]
pub fn primitive_boxes<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).have_disjoint_primitive_boxes::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// Makes the decision of [`primitive_boxes`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn have_disjoint_primitive_boxes<P: PairShape>(&self) -> L::Mask {
        match P::KIND {
            PairKind::VertexFace => vertex_misses_face(self),
            PairKind::EdgeEdge => self.have_disjoint_swept_boxes::<P>(),
        }
    }
}

#[inline(always)]
fn vertex_misses_face<L: Lanes>(points: &PairPoints<L>) -> L::Mask {
    let ([p, a0, b0, c0], [q, a1, b1, c1]) = (points.start, points.end);
    let lower = a0.smaller(b0).smaller(c0).smaller(a1.smaller(b1).smaller(c1));
    let upper = a0.larger(b0).larger(c0).larger(a1.larger(b1).larger(c1));
    // The smallest and largest values drop NaN, and the cross axis of two coordinates ignores the third.
    path_misses([p, q], [lower, upper]) & points.is_finite()
}

/// Returns whether the path of `vertex` certainly misses `target`. It is false if a coordinate of the path is NaN or infinite.
#[inline]
#[must_use]
pub fn misses<S: Scalar>(vertex: &Motion<S>, target: &Aabb<S>) -> bool {
    let path = vertex.ends().map(Vector::from);
    path_misses(path, [target.lower.into(), target.upper.into()]) & vertex.is_finite()
}

/// Returns whether one of the six axes separates the segment from the box. NaN may be dropped.
#[inline(always)]
fn path_misses<L: Lanes>([start, end]: [Vector<L>; 2], [lower, upper]: [Vector<L>; 2]) -> L::Mask {
    let by_axis = apart(start.x, end.x, lower.x, upper.x)
        | apart(start.y, end.y, lower.y, upper.y)
        | apart(start.z, end.z, lower.z, upper.z);
    let (lower, upper, along) = (lower - start, upper - start, end - start);
    // There is no early exit between the three: they cost less than a branch.
    by_axis
        | separates([lower.y, upper.y, along.y], [lower.z, upper.z, along.z])
        | separates([lower.z, upper.z, along.z], [lower.x, upper.x, along.x])
        | separates([lower.x, upper.x, along.x], [lower.y, upper.y, along.y])
}

/// Tests a box axis, given the path from `from` to `to` and the interval.
#[inline(always)]
fn apart<L: Lanes>(from: L, to: L, low: L, high: L) -> L::Mask {
    low.greater(from.larger(to)) | from.smaller(to).greater(high)
}

/// Tests one cross axis, given lower − p, upper − p and d along its two coordinates.
#[inline(always)]
fn separates<L: Lanes>([lower_j, upper_j, d_j]: [L; 3], [lower_k, upper_k, d_k]: [L; 3]) -> L::Mask {
    let (left_a, left_b) = (lower_j * d_k, upper_j * d_k);
    let (right_a, right_b) = (lower_k * d_j, upper_k * d_j);
    let least = left_a.smaller(left_b) - right_a.larger(right_b);
    let largest = left_a.larger(left_b) - right_a.smaller(right_b);
    let sizes = (left_a.abs() + left_b.abs()) + (right_a.abs() + right_b.abs());

    let reach = lower_j.abs().larger(upper_j.abs()).larger(d_j.abs());
    let reach = reach.larger(lower_k.abs().larger(upper_k.abs()).larger(d_k.abs()));
    let constant = |value| reach.splat(value);
    let roundoff = constant(L::Scalar::small(8)) * constant(L::Scalar::UNIT_ROUNDOFF);
    let underflow = (reach + constant(L::Scalar::ONE)) * constant(L::Scalar::UNDERFLOW);
    let bound = roundoff * sizes + underflow;
    (least.greater(bound) | (-bound).greater(largest)) & is_in_range(reach)
}

#[cfg(test)]
mod tests {
    use super::misses;
    use crate::{Motion, boxes::Aabb};

    fn unit_box() -> Aabb<f64> {
        Aabb {
            lower: [-1.0; 3],
            upper: [1.0; 3],
        }
    }

    #[test]
    fn a_path_past_an_edge_of_the_box_misses_it_although_the_swept_boxes_overlap() {
        assert!(misses(&Motion::from(([0.0, 2.5, 0.0], [2.5, 0.0, 0.0])), &unit_box()));
    }

    #[test]
    fn a_path_that_touches_an_edge_of_the_box_is_kept() {
        assert!(!misses(&Motion::from(([0.0, 2.0, 0.0], [2.0, 0.0, 0.0])), &unit_box()));
    }

    #[test]
    fn a_resting_point_on_a_corner_is_kept() {
        assert!(!misses(&Motion::from(([1.0; 3], [1.0; 3])), &unit_box()));
    }

    #[test]
    fn a_path_that_is_not_finite_on_one_axis_is_kept() {
        for z in [f64::INFINITY, f64::NAN] {
            // The path misses the box in x and y alone.
            let path = Motion::from(([0.0, 2.5, 0.0], [2.5, 0.0, z]));
            assert!(!misses(&path, &unit_box()));
        }
    }

    #[test]
    fn overflow_keeps() {
        let huge = f64::MAX;
        let target = Aabb {
            lower: [-huge; 3],
            upper: [huge; 3],
        };
        assert!(!misses(&Motion::from(([-huge, huge, huge], [huge, -huge, huge])), &target));
        assert!(!misses(&Motion::from(([huge, huge, 0.0], [huge, huge, 0.0])), &target));
    }
}
