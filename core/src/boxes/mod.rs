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

use crate::motion::PrimitivePair;
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if the swept boxes of its two sets do not overlap. Exact; boxes that touch overlap.
///
/// NaN and infinite coordinates keep the pair.
#[inline(always)]
pub fn swept_boxes<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    let [start, end] = coordinates(pair);
    let apart = |axis: usize| {
        let [first, second] = P::ranges(start[axis]);
        let [first_at_end, second_at_end] = P::ranges(end[axis]);
        let swept = |[low, high]: [S; 2], [low_at_end, high_at_end]: [S; 2]| {
            [low.smaller(low_at_end), high.larger(high_at_end)]
        };
        let ([low, high], [other_low, other_high]) =
            (swept(first, first_at_end), swept(second, second_at_end));
        (low > other_high) | (other_low > high)
    };
    // The ranges drop NaN, hence the last condition.
    Verdict::culled_if((apart(0) | apart(1) | apart(2)) & pair.is_finite())
}

/// For each end of the step and each axis, the coordinates of the pair's four points.
#[inline(always)]
fn coordinates<S: Scalar>(pair: &impl PrimitivePair<S>) -> [[[S; 4]; 3]; 2] {
    let [a, b, c, d] = pair.motions().map(|motion| motion.ends());
    [0, 1].map(|end| [0, 1, 2].map(|axis| [a[end][axis], b[end][axis], c[end][axis], d[end][axis]]))
}

/// The nine directions of an 18-DOP, as values of one point: x, y, z, x±y, x±z, y±z. The sums round to nearest.
#[inline(always)]
fn along_nine_directions<S: Scalar>([x, y, z]: [S; 3]) -> [S; 9] {
    [x, y, z, x + y, x - y, x + z, x - z, y + z, y - z]
}
