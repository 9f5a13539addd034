//! The certified non-coplanarity filter: a culled pair is never coplanar in [0, 1], rounding included.
//!
//! The four control values of the signed volume must each exceed the bound that
//! [`coplanarity`](crate::coplanarity) derives for its rounding, all with the same sign. The converse does not
//! hold: a kept pair may never be coplanar either.

use crate::coplanarity::MovingTetrahedron;
use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if its four points are certainly not coplanar at any time in [0, 1].
///
/// Certified under rounding to nearest. NaN, infinities and overflow keep the pair; so do zero-length edges and
/// zero-area triangles, whose volume is zero.
///
/// ```
/// use selvedge_core::{filter::certified::non_coplanarity, glam::Vec3, EdgeEdge, Motion, Verdict};
/// let crossing = EdgeEdge {
///     first: [Vec3::NEG_X, Vec3::X].map(Motion::resting),
///     second: [Vec3::NEG_Y, Vec3::Y].map(|end| Motion::new(end + Vec3::Z, end - Vec3::Z)),
/// };
/// assert_eq!(non_coplanarity(&crossing), Verdict::Kept);
/// ```
#[inline(always)]
pub fn non_coplanarity<S: Scalar>(pair: &impl PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(is_never_coplanar(&pair.tetrahedron()))
}

/// The same decision on a tetrahedron of any number of lanes: true proves that the lane's points are never
/// coplanar in [0, 1].
#[inline(always)]
#[must_use]
pub fn is_never_coplanar<L: Lanes>(tetrahedron: &MovingTetrahedron<L>) -> L::Mask {
    tetrahedron
        .control_values()
        .one_sign_beyond(tetrahedron.error_bounds())
}
