//! Relative boxes: the two sets keep the same order along a fixed direction throughout the step.
//!
//! For a fixed direction w, w·(p(t) − x(t)) is linear in t for each pair of points p, x of the two sets. If all of them
//! are positive at both ends of the step they are positive throughout, and the sets are apart. Along a coordinate axis
//! that takes comparisons only, along a diagonal one rounded sum a point
//! ([which is exact enough](super#why-sums-may-round)): **exact**, no error bound. It culls whatever swept
//! axis-aligned boxes cull and more, because it knows that the two move together, which swept boxes forget. The same test
//! is the reading that we give to the subspace filters of Tang, Li and Wang 2010 and 2011 (*reconstructed*).

use super::coordinates;
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
#[inline(always)]
pub fn three_axes<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    let [start, end] = coordinates(pair);
    // The ranges drop NaN, hence the last condition.
    Verdict::culled_if(apart_along_axes::<S, P>(&start, &end) & pair.is_finite())
}

/// [`three_axes`], and the six diagonals x±y, x±z, y±z as well.
#[inline(always)]
pub fn nine_directions<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    let [start, end] = coordinates(pair);
    let apart =
        apart_along_axes::<S, P>(&start, &end) || apart_along_diagonals::<S, P>(&start, &end);
    Verdict::culled_if(apart & pair.is_finite())
}

#[inline(always)]
fn apart_along_axes<S: Scalar, P: PrimitivePair<S>>(
    start: &[[S; 4]; 3],
    end: &[[S; 4]; 3],
) -> bool {
    let apart = |axis: usize| keeps_order::<S, P>(start[axis], end[axis]);
    apart(0) | apart(1) | apart(2)
}

#[inline(always)]
fn apart_along_diagonals<S: Scalar, P: PrimitivePair<S>>(
    start: &[[S; 4]; 3],
    end: &[[S; 4]; 3],
) -> bool {
    let sum = |[a, b, c, d]: [S; 4], [e, f, g, h]: [S; 4]| [a + e, b + f, c + g, d + h];
    let difference = |[a, b, c, d]: [S; 4], [e, f, g, h]: [S; 4]| [a - e, b - f, c - g, d - h];
    let apart = |i: usize, j: usize| {
        keeps_order::<S, P>(sum(start[i], start[j]), sum(end[i], end[j]))
            | keeps_order::<S, P>(difference(start[i], start[j]), difference(end[i], end[j]))
    };
    apart(0, 1) | apart(0, 2) | apart(1, 2)
}

/// Whether one set's values are all above the other's at the start, and at the end too.
#[inline(always)]
fn keeps_order<S: Scalar, P: PrimitivePair<S>>(start: [S; 4], end: [S; 4]) -> bool {
    let [[low_0, high_0], [other_low_0, other_high_0]] = P::ranges(start);
    let [[low_1, high_1], [other_low_1, other_high_1]] = P::ranges(end);
    ((low_0 > other_high_0) & (low_1 > other_high_1))
        | ((other_low_0 > high_0) & (other_low_1 > high_1))
}
