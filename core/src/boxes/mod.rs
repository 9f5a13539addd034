//! Box tests on primitive pairs, from the loosest to the strongest.
//!
//! | test | what it compares | rounding |
//! |---|---|---|
//! | [`Aabb`] | swept axis-aligned boxes | exact: comparisons only |
//! | [`segment`] | the vertex's path against the face's swept box (the paper's VF test) | certified bound |
//! | [`Dop18`] | swept boxes along 9 directions (Hutter, Fuhrmann 2007) | exact: rounding is monotone |
//! | [`relative`] | 3 or 9 directions, both ends of the step apart: the two sets in the same order | exact |
//!
//! # Why sums may round
//! Rounding is monotone: x ≤ y implies fl(x) ≤ fl(y). So fl(a) > fl(b) *proves* a > b, although fl(a) = fl(b) says
//! nothing. Tests along the diagonals ±x±y compare sums of two coordinates, each rounded once, and need no error
//! bound. A sum of three would be rounded twice, and the argument would not hold. (It needs subnormal numbers
//! to be kept: where a thread flushes its *inputs* to zero the diagonals are not certified.)
//!
//! Box tests see motion as linear: a coordinate, or a sum of coordinates, lies between its values at both ends.

mod aabb;
mod dop;
pub mod relative;
pub mod segment;

pub use aabb::Aabb;
pub use dop::Dop18;

use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if the swept boxes of its two sets do not overlap. Exact; boxes that touch overlap.
///
/// NaN and infinite coordinates keep the pair, and so do coordinates so large that their sum overflows.
#[inline(always)]
pub fn swept_boxes<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    Verdict::culled_if(have_disjoint_swept_boxes::<P::Shape, S>(&pair.points()))
}

/// The same decision on any number of lanes.
#[inline(always)]
#[must_use]
pub fn have_disjoint_swept_boxes<P: PairShape, L: Lanes>(points: &PairPoints<L>) -> L::Mask {
    let apart = |start: [L; 4], end: [L; 4]| {
        let ([first, second], [first_at_end, second_at_end]) = (P::ranges(start), P::ranges(end));
        let swept = |[low, high]: [L; 2], [low_at_end, high_at_end]: [L; 2]| {
            [low.smaller(low_at_end), high.larger(high_at_end)]
        };
        let [low, high] = swept(first, first_at_end);
        let [other_low, other_high] = swept(second, second_at_end);
        low.greater(other_high) | other_low.greater(high)
    };
    // The ranges drop NaN, hence the last condition.
    along_axes(points, apart) & points.is_finite()
}

/// Whether `apart`, given the four points' coordinates at the start and at the end, holds along one of the axes.
#[inline(always)]
fn along_axes<L: Lanes>(
    points: &PairPoints<L>,
    apart: impl Fn([L; 4], [L; 4]) -> L::Mask,
) -> L::Mask {
    let PairPoints { start, end } = points;
    apart(start.map(|p| p.x), end.map(|p| p.x))
        | apart(start.map(|p| p.y), end.map(|p| p.y))
        | apart(start.map(|p| p.z), end.map(|p| p.z))
}

/// The nine directions of an 18-DOP, as values of one point: x, y, z, x±y, x±z, y±z. The sums round to nearest.
#[inline(always)]
fn along_nine_directions<S: Scalar>([x, y, z]: [S; 3]) -> [S; 9] {
    [x, y, z, x + y, x - y, x + z, x - z, y + z, y - z]
}
