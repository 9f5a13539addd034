//! Relative boxes: the two sets keep the same order along a fixed direction throughout the step.
//!
//! For a fixed direction w, w·(p(t) − x(t)) is linear in t for each pair of points p, x of the two sets. If all of them
//! are positive at both ends of the step they are positive throughout, and the sets are apart. Along a coordinate axis
//! that takes comparisons only, along a diagonal one rounded sum a point
//! ([which is exact enough](super#why-sums-may-round)): **exact**, no error bound. It culls whatever swept
//! axis-aligned boxes cull and more, because it knows that the two move together, which swept boxes forget. The same test
//! is the reading that we give to the subspace filters of Tang, Li and Wang 2010 and 2011 (*reconstructed*).

use super::{along_nine_directions, larger, smaller};
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if one coordinate axis keeps its two sets apart, in the same order, throughout the step.
///
/// Exact. NaN and infinite coordinates keep the pair.
///
/// ```
/// use selvedge_core::{boxes::{relative, swept_boxes}, glam::DVec3, Motion, Verdict, VertexFace};
/// // A vertex that follows a moving triangle at a distance: their swept boxes overlap, they never meet.
/// let travel = |point: DVec3| Motion::new(point, point + 10.0 * DVec3::Z);
/// let pair = VertexFace {
///     vertex: travel(DVec3::new(0.2, 0.2, 0.1)),
///     face: [DVec3::ZERO, DVec3::X, DVec3::Y].map(travel),
/// };
/// assert_eq!(swept_boxes(&pair), Verdict::Kept);
/// assert_eq!(relative::three_axes(&pair), Verdict::Culled);
/// ```
#[inline]
pub fn three_axes<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    keeps_order::<S, P, 3>(pair, |position| position)
}

/// [`three_axes`], and the six diagonals x±y, x±z, y±z as well.
#[inline]
pub fn nine_directions<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    keeps_order::<S, P, 9>(pair, along_nine_directions)
}

#[inline(always)]
fn keeps_order<S: Scalar, P: PrimitivePair<S>, const N: usize>(
    pair: &P,
    project: impl Fn([S; 3]) -> [S; N],
) -> Verdict {
    let motions = pair.motions().map(|motion| motion.ends().map(&project));
    let (first, second) = motions.split_at(P::FIRST);
    let mut apart = false;
    for direction in 0..N {
        let bounds = |set: &[[[S; N]; 2]], end: usize| {
            let mut range = [S::INFINITY, -S::INFINITY];
            for point in set {
                range[0] = smaller(point[end][direction], range[0]);
                range[1] = larger(point[end][direction], range[1]);
            }
            range
        };
        let [[low_0, high_0], [low_1, high_1]] = [bounds(first, 0), bounds(first, 1)];
        let [[other_low_0, other_high_0], [other_low_1, other_high_1]] =
            [bounds(second, 0), bounds(second, 1)];
        apart |= (low_0 > other_high_0) & (low_1 > other_high_1);
        apart |= (other_low_0 > high_0) & (other_low_1 > high_1);
    }
    // The bounds above drop NaN.
    Verdict::culled_if(apart && pair.is_finite())
}
