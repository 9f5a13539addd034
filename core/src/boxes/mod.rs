//! Box tests on primitive pairs, from the loosest to the strongest.
//!
//! | test | what it compares | rounding |
//! |---|---|---|
//! | [`Aabb`] | swept axis-aligned boxes | exact: comparisons only |
//! | [`segment`] | the vertex's path against the face's swept box (the paper's VF test) | certified bound |
//! | [`Dop18`] | swept boxes along 9 directions (Hutter, Fuhrmann 2007) | exact: rounding is monotone |
//! | [`relative`] | 3 or 9 directions, both ends of the step apart: the two sets in the same order | exact |
//! | [`moving`] | the boxes of any two sets at both ends of the step: relative boxes for a hierarchy | exact |
//! | [`block`] | the boxes of sixteen sets within a distance of another, at rest | none: for classes of pairs, not for proofs |
//! | [`mapping`] | how positions of any format become `f32` boxes, with a separation or without, and are asked for a smaller one | monotone; a proven bound with one |
//! | [`direction`] | the same along any direction, by default the pair's own normal | certified bound |
//!
//! # Why sums may round
//! Rounding is monotone, in any direction: x ≤ y implies fl(x) ≤ fl(y). So fl(a) > fl(b) *proves* a > b, although
//! fl(a) = fl(b) says nothing. Tests along the diagonals ±x±y compare sums of two coordinates, each rounded once, and need no
//! error bound. A sum of three would be rounded twice, and the argument would not hold.
//!
//! Flushing *results* below λ, the smallest normal number, to zero is monotone as well; flushing *operands* is so for a
//! comparison of coordinates, but not for a sum: λ/2 + λ/2 would become 0. Hence one sum must exceed the other plus
//! g = [`Rounding::SUM_GAP`](crate::lanes::Rounding::SUM_GAP), far above λ and absorbed by whatever is above g/u, which is
//! anything but dust. Why that suffices, with A = fl(a + b) > fl(Z + g), Z = fl(c + d), when operands are flushed:
//! * |Z| ≤ g/16u: then A ≥ Z + g/2, and roundings and flushed operands make up less than g/2.
//! * |Z| > g/16u: A and Z are floating-point numbers, A > Z. At most one operand of a sum of that size is flushed, and the
//!   sum of the others, as real numbers, is in the same strict order. They are multiples of a step far above λ, or differ
//!   by one normal operand: by λ at least, which is more than what was flushed.
//!
//! **Compilers** assume that nothing is flushed. Where comparisons of coordinates stand beside sums they may make one vector operation
//! of both and add zero to the coordinates, which changes nothing then; but in a thread that flushes results (without taking
//! operands for zero) it makes one side of a comparison zero and leaves the other. LLVM did so to the tests along nine directions,
//! which then culled pairs of subnormal coordinates that touch. So these ask coordinates for the gap as well. It is
//! absorbed in the same way: with A > fl(Z + g) and A or Z flushed, A ≥ g/2 is normal and Z is off by λ at most. Tests along
//! three axes have no sums that could be mixed with their comparisons.
//!
//! Box tests see motion as linear: a coordinate, or a sum of coordinates, lies between its values at both ends.

/// Whether a test of the four points' values at the start and at the end holds along one of the axes.
///
/// A macro, as are others in kernels: closures and `array::map` are functions of their own, which the compiler
/// will not always inline into code for a wider instruction set; then every operation becomes a call.
macro_rules! along_axes {
    ($points:expr, $test:expr) => {
        $test(values!($points.start, |p| p.x), values!($points.end, |p| p.x))
            | $test(values!($points.start, |p| p.y), values!($points.end, |p| p.y))
            | $test(values!($points.start, |p| p.z), values!($points.end, |p| p.z))
    };
}

/// One value for each of four points.
macro_rules! values {
    ($points:expr, |$p:ident| $value:expr) => {{
        let [a, b, c, d] = $points;
        [
            {
                let $p = a;
                $value
            },
            {
                let $p = b;
                $value
            },
            {
                let $p = c;
                $value
            },
            {
                let $p = d;
                $value
            },
        ]
    }};
}

mod aabb;
#[cfg(feature = "batch")]
pub mod block;
pub mod direction;
mod dop;
#[cfg(feature = "batch")]
pub mod mapping;
#[cfg(feature = "batch")]
pub mod moving;
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
pub fn swept_boxes<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).have_disjoint_swept_boxes::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// The decision of [`swept_boxes`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn have_disjoint_swept_boxes<P: PairShape>(&self) -> L::Mask {
        // The ranges drop NaN, hence the last condition.
        along_axes!(self, are_disjoint_intervals::<P, L>) & self.is_finite()
    }
}

/// Whether the intervals that the two sets' values sweep are disjoint.
#[inline(always)]
fn are_disjoint_intervals<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> L::Mask {
    let [[low_0, high_0], [other_low_0, other_high_0]] = P::ranges(start);
    let [[low_1, high_1], [other_low_1, other_high_1]] = P::ranges(end);
    low_0.smaller(low_1).greater(other_high_0.larger(other_high_1))
        | other_low_0.smaller(other_low_1).greater(high_0.larger(high_1))
}

/// Whether all values from `least` to `greatest` are above `bound`, or all below its negative. False with NaN in the bound.
#[inline(always)]
fn are_beyond<L: Lanes>(least: L, greatest: L, bound: L) -> L::Mask {
    least.greater(bound) | (-bound).greater(greatest)
}

/// The nine directions of an 18-DOP, as values of one point: x, y, z, x±y, x±z, y±z. The sums are rounded.
#[inline(always)]
fn along_nine_directions<S: Scalar>([x, y, z]: [S; 3]) -> [S; 9] {
    [x, y, z, x + y, x - y, x + z, x - z, y + z, y - z]
}
