//! Separating direction: for a fixed vector w the points of one set stay ahead of the other's along w.
//!
//! For points p of one set and x of the other, w·(p(t) − x(t)) is linear in t. If it is positive at both ends of the step for
//! every p and x, or negative for all, the sets are apart throughout. [Relative boxes](super::relative) are the case of w
//! along a coordinate axis. w may come from anywhere, rounded as it likes: the proof is in the signs, computed from the points.
//!
//! [`normal`] takes the pair's own normal in the middle of the step, n₀ + n₁ of
//! [`coplanarity`](crate::coplanarity): that of the face, or of the two edges. It culls what non-coplanarity culls while the
//! normal hardly turns, also where the points do become coplanar outside of the face.
//!
//! # Rounding
//! (Any direction: 2u an operation.) e = p − x is rounded once; w·e takes a product and two additions, the last of which
//! cannot change the sign that a comparison sees: 3 roundings, 6u·S to first order, S = Σ|w_k|·M_k, M_k the largest |e_k| over all
//! corners and both ends. The test asks for fl(w·e) > fl(8u·Ŝ + (1 + W)·η), W the largest |w_k|: at least 8u(1 − 2u)⁶·S. Where
//! subnormal numbers are flushed a difference is off by 3λ at most, and the dot product by 9W·λ + 5λ; η ≥ 512·λ.
//! Only M < [`Rounding::LARGEST_EDGE`] culls; W is then at most 8·M².

use super::are_beyond;
use crate::PairKind;
use crate::coplanarity::{MovingTetrahedron, is_in_range, zero_if_finite};
use crate::lanes::{Lanes, Rounding};
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;
use crate::verdict::Verdict;

/// Culls `pair` if its normal in the middle of the step is a direction that keeps its two sets apart throughout.
///
/// Certified: never culls what touches. NaN, infinities and overflow keep the pair.
///
/// ```
/// use selvedge_core::{boxes::{direction, relative}, glam::DVec3, Motion, Verdict, PrimitivePair};
/// // A vertex that slides past a slanted triangle: no axis separates them, the triangle's normal does.
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.4, 0.2, 0.5), DVec3::new(0.2, 0.4, 0.5)),
///     [DVec3::X, DVec3::Y, DVec3::Z].map(Motion::resting),
/// );
/// assert_eq!(relative::three_axes(&pair), Verdict::Kept);
/// assert_eq!(direction::normal(&pair), Verdict::Culled);
/// ```
#[inline(always)]
pub fn normal<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).are_apart_along_normal::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// The decision of [`normal`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn are_apart_along_normal<P: PairShape>(&self) -> L::Mask {
        let MovingTetrahedron { b, c, p } = self.tetrahedron::<P>();
        let ([b0, b1], [c0, c1], [p0, p1]) = (b, c, p);
        let normal = match P::KIND {
            PairKind::VertexFace => b0.cross(c0) + b1.cross(c1),
            PairKind::EdgeEdge => (c0 - b0).cross(p0) + (c1 - b1).cross(p1),
        };
        are_apart_along(P::corners(self.start), P::corners(self.end), normal)
    }
}

/// Whether all corners (differences of a point of one set and a point of the other), at both ends of the step, certainly
/// lie on one side of the plane through 0 with normal `along`.
#[inline(always)]
fn are_apart_along<L: Lanes>(start: [Vector<L>; 4], end: [Vector<L>; 4], along: Vector<L>) -> L::Mask {
    let ([a, b, c, d], [e, f, g, h]) = (start, end);
    let largest = a.abs().larger(b.abs()).larger(c.abs().larger(d.abs()));
    let largest = largest.larger(e.abs().larger(f.abs()).larger(g.abs().larger(h.abs())));
    let sizes = largest.dot(along.abs());
    let constant = |value| sizes.splat(value);
    let roundoff = constant(L::Scalar::small(8)) * constant(L::Scalar::UNIT_ROUNDOFF);
    let underflow = (along.abs().largest() + constant(L::Scalar::ONE)) * constant(L::Scalar::UNDERFLOW);

    let (a, b, c, d) = (a.dot(along), b.dot(along), c.dot(along), d.dot(along));
    let (e, f, g, h) = (e.dot(along), f.dot(along), g.dot(along), h.dot(along));
    let least = (a.smaller(b).smaller(c.smaller(d))).smaller(e.smaller(f).smaller(g.smaller(h)));
    let greatest = (a.larger(b).larger(c.larger(d))).larger(e.larger(f).larger(g.larger(h)));
    let zero = zero_if_finite([a, b, c, d]) + zero_if_finite([e, f, g, h]);
    let bound = roundoff * sizes + underflow + zero;
    are_beyond(least, greatest, bound) & is_in_range(largest.largest())
}

#[cfg(test)]
mod tests {
    use super::normal;
    use crate::{Motion, PrimitivePair, Verdict};
    use glam::DVec3;

    #[test]
    fn edges_that_pass_at_a_distance_are_culled_and_touching_ones_kept() {
        let pair = |height: f64| {
            PrimitivePair::edge_edge(
                [DVec3::NEG_X, DVec3::X].map(Motion::resting),
                [DVec3::NEG_Y, DVec3::Y].map(|end| Motion::new(end + height * DVec3::Z, end + 2.0 * height * DVec3::Z)),
            )
        };
        assert_eq!(normal(&pair(0.1)), Verdict::Culled);
        assert_eq!(normal(&pair(-0.1)), Verdict::Culled);
        assert_eq!(normal(&pair(0.0)), Verdict::Kept);
    }

    #[test]
    fn what_is_not_finite_or_overflows_is_kept() {
        for value in [f64::NAN, f64::INFINITY, f64::MAX] {
            let pair = PrimitivePair::vertex_face(
                Motion::new(DVec3::Z, DVec3::new(value, 0.0, 1.0)),
                [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
            );
            assert_eq!(normal(&pair), Verdict::Kept);
        }
    }
}
