//! Relative boxes: the two sets keep the same order along a coordinate axis throughout the step.
//!
//! The difference of a coordinate of two points, one of each set, is linear in time. If it is positive at both ends of the step
//! for every such pair of points, it is positive throughout, and the sets are apart. The test only compares coordinates, so it is
//! **exact** and needs no error bound. It culls every pair that swept boxes cull, and more, since it uses that the two sets move
//! together.

use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if one coordinate axis keeps its two sets apart, in the same order, throughout the step.
///
/// The test is exact. NaN and infinite coordinates keep the pair, and so do coordinates so large that their sum overflows.
///
/// ```
/// use selvedge_core::{boxes::{relative, swept_boxes}, glam::DVec3, Motion, Verdict, PrimitivePair};
/// // A vertex that follows a moving triangle at a distance: their swept boxes overlap, they never meet.
/// let travel = |point: DVec3| Motion::new(point, point + 10.0 * DVec3::Z);
/// let pair = PrimitivePair::vertex_face(
///     travel(DVec3::new(0.2, 0.2, 0.1)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(travel),
/// );
/// assert_eq!(swept_boxes(&pair), Verdict::Kept);
/// assert_eq!(relative::three_axes(&pair), Verdict::Culled);
/// ```
#[inline(always)]
pub fn three_axes<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).are_apart_along_three_axes::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// Makes the decision of [`three_axes`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn are_apart_along_three_axes<P: PairShape>(&self) -> L::Mask {
        // The ranges drop NaN, so the last condition is needed.
        along_axes!(self, keep_order::<P, L>) & self.is_finite()
    }
}

/// Returns whether one set's values are all above the other's, at the start and at the end.
#[inline(always)]
fn keep_order<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> L::Mask {
    let [[low_0, high_0], [other_low_0, other_high_0]] = P::ranges(start);
    let [[low_1, high_1], [other_low_1, other_high_1]] = P::ranges(end);
    (low_0.greater(other_high_0) & low_1.greater(other_high_1)) | (other_low_0.greater(high_0) & other_low_1.greater(high_1))
}
