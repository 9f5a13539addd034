//! The certified non-coplanarity filter: a culled pair is never coplanar in [0, 1], rounding included.
//!
//! All four control values of the signed volume must exceed a bound of their rounding error, with the same sign.
//! [`coplanarity`](crate::coplanarity) derives two such bounds. With a separation s > 0 they must exceed the bound plus s times
//! the normal's length. A kept pair may never be coplanar either.
//!
//! The bound by the permanent is the sharper one, and costs as much as the control values themselves. It is computed only where
//! all values have one sign but do not clear the cheap bound by magnitudes, which is rare.

use crate::coplanarity::{ControlValues, Decision, MovingTetrahedron, error_bound_by_magnitudes, is_in_range, zero_if_finite};
use crate::lanes::{Lanes, Rounding};
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::separation_lanes::SeparationLanes;
use crate::verdict::Verdict;

/// Culls `pair` if its four points are certainly not coplanar at any time in [0, 1].
///
/// The filter is certified in every floating-point environment ([`Rounding`]). NaN, infinities and overflow keep the pair.
/// Zero-length edges and zero-area triangles keep it as well, since their volume is zero.
///
/// ```
/// use selvedge_core::{filter::certified::non_coplanarity, glam::Vec3, PrimitivePair, Motion, Verdict};
/// let crossing = PrimitivePair::edge_edge(
///     [Vec3::NEG_X, Vec3::X].map(Motion::resting),
///     [Vec3::NEG_Y, Vec3::Y].map(|end| Motion::new(end + Vec3::Z, end - Vec3::Z)),
/// );
/// assert_eq!(non_coplanarity(&crossing), Verdict::Kept);
/// ```
#[inline(always)]
pub fn non_coplanarity<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).tetrahedron::<P>().is_never_coplanar()))
}

impl<L: Lanes> MovingTetrahedron<L> {
    /// Makes the decision on any number of lanes. True proves that the lane's points are never coplanar in [0, 1].
    #[inline(always)]
    #[must_use]
    pub fn is_never_coplanar(&self) -> L::Mask {
        decide_beyond(self, SeparationLanes::zero(self.b[0].x)).culled
    }

    /// Makes the decision with a separation s on any number of lanes. `culled` is a proof for all times in [0, 1]. The vertex is
    /// never within s of the face's plane, or the line of one edge within s of the other's.
    ///
    /// If the separation is zero, the kind of the pair does not matter.
    #[inline(always)]
    #[must_use]
    pub fn decide<P: PairShape>(&self, separation: SeparationLanes<L>) -> Decision<L::Mask> {
        let clearance = separation.times(
            #[inline(always)]
            || self.largest_normal(P::KIND),
        );
        decide_beyond(self, clearance)
    }
}

/// Decides whether all control values exceed their error bounds and the clearance, with one sign.
#[inline(always)]
fn decide_beyond<L: Lanes>(tetrahedron: &MovingTetrahedron<L>, clearance: SeparationLanes<L>) -> Decision<L::Mask> {
    let values: ControlValues<L> = tetrahedron.control_values();
    let largest = tetrahedron.largest_by_axis();
    let in_range = is_in_range(largest.largest());

    // The largest bound serves all four, so that the least and the greatest value decide.
    let [k0, k1, k2, k3] = values.0;
    let inner = error_bound_by_magnitudes(largest) * largest.x.splat(L::Scalar::small(4));
    let inner = inner + zero_if_finite(values.0);
    let [_, bound, ..] = with_clearance([inner; 4], clearance);
    let least = k0.smaller(k1).smaller(k2.smaller(k3));
    let greatest = k0.larger(k1).larger(k2.larger(k3));
    // This is the smallest magnitude if all values have one sign, otherwise it is not positive. The other is positive only with
    // both signs.
    let of_one_sign = least.larger(-greatest);
    let of_both_signs = greatest.smaller(-least);
    let decided = of_one_sign.greater(bound) & in_range;

    // Cloth and floors are often flat along an axis throughout the step. A difference that is computed as zero is exactly zero.
    let zero = largest.x.splat(L::Scalar::ZERO);
    let least_extent = largest.x.smaller(largest.y).smaller(largest.z);
    let is_flat = in_range ^ (in_range & least_extent.greater(zero));
    let settled = (of_both_signs.greater(inner) & in_range) | is_flat;

    let of_one_sign = of_one_sign.greater(zero) & in_range;
    let culled = if L::any(of_one_sign ^ decided) {
        let bounds = with_clearance(tetrahedron.error_bounds(), clearance);
        decided | (values.one_sign_beyond(bounds) & in_range)
    } else {
        decided
    };
    Decision { culled, settled }
}

/// Adds the clearance to the bounds. The middle control values are tripled, so theirs is as well.
#[inline(always)]
fn with_clearance<L: Lanes>([e0, e1, e2, e3]: [L; 4], clearance: SeparationLanes<L>) -> [L; 4] {
    if !clearance.is_positive() {
        return [e0, e1, e2, e3];
    }
    let outer = clearance.length();
    let inner = outer * outer.splat(L::Scalar::small(3));
    [e0 + outer, e1 + inner, e2 + inner, e3 + outer]
}
