//! The paper's VF box test: the vertex's path, a segment, against the face's swept box, by separating axes.
//!
//! A segment and a box are disjoint exactly if one of six axes separates them: the box's three, and the three cross
//! products of a box axis with the segment's direction.
//!
//! **Box axes** compare coordinates: exact.
//!
//! **Cross axes.** Along the axis eᵢ × d, with j, k the other two coordinates, the box's corners x lie strictly on one side
//! of the segment's line iff s(x) = (x_j − p_j)·d_k − (x_k − p_k)·d_j has one sign on all four corners of the box's
//! projection. Its least value is min(L_j·d_k, U_j·d_k) − max(L_k·d_j, U_k·d_j), its largest has min and max exchanged,
//! L = lower − p, U = upper − p. (The midpoint form of the textbooks cancels; this one has orientation's small error.)
//!
//! *Rounding.* A product T of two rounded differences is computed as T̂ = T(1 + θ), |θ| ≤ (1 + u)³ − 1, so
//! |T − T̂| ≤ ((1 − u)⁻³ − 1)·|T̂| ≤ 3.1u·|T̂|, plus η₀ if it underflows (differences are exact then). The least of
//! two products and the greatest of two move by no more than the larger of theirs, and the last subtraction is rounded
//! once more, so s > 0 follows from fl(s) > (1 + u)(3.1u·Ŝ + 2η₀), Ŝ = Σ|T̂| over the four products. The test asks for
//! fl(s) > fl(4u·Ŝ + η): at least 4(1 − u)⁴u·Ŝ + 31η₀(1 − u), η ≥ 32·η₀, which is more.
//! Infinite or NaN products make the bound infinite or NaN, and the comparison false.
//!
//! Strict inequalities: what touches is kept, and d = 0 gives 0 > η, which is false.

use super::Aabb;
use crate::lanes::Rounding;
use crate::motion::{Motion, VertexFace};
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if the vertex's path misses the axis-aligned box that the face sweeps (the paper, stage 1; *disengaging
/// shaft* there is the separating axis).
///
/// Certified: never culls if the path and the box share a point. NaN, infinities and overflow keep the pair.
#[inline]
pub fn vertex_face<S: Scalar>(pair: &VertexFace<S>) -> Verdict {
    Verdict::culled_if(misses(&pair.vertex, &Aabb::swept(&pair.face)))
}

/// Whether the path of `vertex` certainly misses `target`. False if a coordinate of the path is NaN or infinite.
#[inline]
#[must_use]
pub fn misses<S: Scalar>(vertex: &Motion<S>, target: &Aabb<S>) -> bool {
    // The cross axis of two coordinates does not see the third.
    if !vertex.is_finite() {
        return false;
    }
    if !Aabb::swept(&[*vertex]).overlaps(target) {
        return true;
    }
    let [start, end] = vertex.ends();
    let relative = |axis: usize| {
        (
            target.lower[axis] - start[axis],
            target.upper[axis] - start[axis],
            end[axis] - start[axis],
        )
    };
    let [x, y, z] = [relative(0), relative(1), relative(2)];
    // No shortcut between the three: they are cheap, and a branch is not.
    separates(y, z) | separates(z, x) | separates(x, y)
}

/// One cross axis: (lower − p, upper − p, d) along its two coordinates.
#[inline(always)]
fn separates<S: Scalar>(
    (lower_j, upper_j, d_j): (S, S, S),
    (lower_k, upper_k, d_k): (S, S, S),
) -> bool {
    let (left_a, left_b) = (lower_j * d_k, upper_j * d_k);
    let (right_a, right_b) = (lower_k * d_j, upper_k * d_j);
    let least = left_a.smaller(left_b) - right_a.larger(right_b);
    let largest = left_a.larger(left_b) - right_a.smaller(right_b);
    let sizes = (left_a.abs() + left_b.abs()) + (right_a.abs() + right_b.abs());
    let bound = S::small(4) * S::UNIT_ROUNDOFF * sizes + <S as Rounding>::UNDERFLOW;
    least > bound || -largest > bound
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
        assert!(misses(
            &Motion::from(([0.0, 2.5, 0.0], [2.5, 0.0, 0.0])),
            &unit_box()
        ));
    }

    #[test]
    fn a_path_that_touches_an_edge_of_the_box_is_kept() {
        assert!(!misses(
            &Motion::from(([0.0, 2.0, 0.0], [2.0, 0.0, 0.0])),
            &unit_box()
        ));
    }

    #[test]
    fn a_resting_point_on_a_corner_is_kept() {
        assert!(!misses(&Motion::from(([1.0; 3], [1.0; 3])), &unit_box()));
    }

    #[test]
    fn a_path_that_is_not_finite_on_one_axis_is_kept() {
        for z in [f64::INFINITY, f64::NAN] {
            // Misses the box in x and y alone.
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
        assert!(!misses(
            &Motion::from(([-huge, huge, huge], [huge, -huge, huge])),
            &target
        ));
        assert!(!misses(
            &Motion::from(([huge, huge, 0.0], [huge, huge, 0.0])),
            &target
        ));
    }
}
