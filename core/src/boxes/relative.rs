//! Relative boxes: the two sets keep the same order along a fixed direction throughout the step.
//!
//! For a fixed direction w, w·(p(t) − x(t)) is linear in t for each pair of points p, x of the two sets. If all of them
//! are positive at both ends of the step they are positive throughout, and the sets are apart. Along a coordinate axis
//! that takes comparisons only, along a diagonal one rounded sum a point
//! ([which is exact enough](super#why-sums-may-round)): **exact**, no error bound. It culls whatever swept
//! axis-aligned boxes cull and more, because it knows that the two move together, which swept boxes forget. The same test
//! is the reading that we give to the subspace filters of Tang, Li and Wang 2010 and 2011 (*reconstructed*).

use crate::lanes::{Lanes, Rounding};
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if one coordinate axis keeps its two sets apart, in the same order, throughout the step.
///
/// Exact. NaN and infinite coordinates keep the pair, and so do coordinates so large that their sum overflows.
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

/// [`three_axes`], and the six diagonals x±y, x±z, y±z as well.
///
/// Along every one of the nine, axes included, one value must exceed the other by [`Rounding::SUM_GAP`] (see "compilers" in the
/// documentation of [`boxes`](super)); anything but dust absorbs it. So of pairs whose coordinates are as small as that it keeps
/// some that [`three_axes`] culls.
#[inline(always)]
pub fn nine_directions<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).are_apart_along_nine_directions::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// The decision of [`three_axes`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn are_apart_along_three_axes<P: PairShape>(&self) -> L::Mask {
        // The ranges drop NaN, hence the last condition.
        along_axes!(self, keep_order::<P, L>) & self.is_finite()
    }

    /// The decision of [`nine_directions`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn are_apart_along_nine_directions<P: PairShape>(&self) -> L::Mask {
        macro_rules! along {
            ($p:ident => $value:expr) => {
                keep_order_of_sums::<P, L>(values!(self.start, |$p| $value), values!(self.end, |$p| $value))
            };
        }
        // Coordinates with the gap, as if they were sums: see "compilers" in the documentation of `boxes`.
        let axes = along!(p => p.x) | along!(p => p.y) | along!(p => p.z);
        let diagonals = (along!(p => p.x + p.y) | along!(p => p.x - p.y))
            | (along!(p => p.x + p.z) | along!(p => p.x - p.z))
            | (along!(p => p.y + p.z) | along!(p => p.y - p.z));
        (axes | diagonals) & self.is_finite()
    }
}

/// Whether one set's values are all above the other's at the start, and at the end too.
#[inline(always)]
fn keep_order<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> L::Mask {
    let [[low_0, high_0], [other_low_0, other_high_0]] = P::ranges(start);
    let [[low_1, high_1], [other_low_1, other_high_1]] = P::ranges(end);
    (low_0.greater(other_high_0) & low_1.greater(other_high_1)) | (other_low_0.greater(high_0) & other_low_1.greater(high_1))
}

/// The same for sums of two coordinates, one set's above the other's by [`Rounding::SUM_GAP`].
#[inline(always)]
fn keep_order_of_sums<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> L::Mask {
    let [[low_0, high_0], [other_low_0, other_high_0]] = P::ranges(start);
    let [[low_1, high_1], [other_low_1, other_high_1]] = P::ranges(end);
    let gap = low_0.splat(L::Scalar::SUM_GAP);
    (low_0.greater(other_high_0 + gap) & low_1.greater(other_high_1 + gap))
        | (other_low_0.greater(high_0 + gap) & other_low_1.greater(high_1 + gap))
}
