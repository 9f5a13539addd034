//! Box tests on primitive pairs, from the loosest to the strongest, and boxes for hierarchies.
//!
//! | test | what it compares | rounding |
//! |---|---|---|
//! | [`Aabb`] | swept axis-aligned boxes | exact: comparisons only |
//! | [`segment`] | the vertex's path with the face's swept box (the paper's VF test) | certified bound |
//! | [`relative`] | the order of the two sets along an axis, at both ends of the step | exact |
//! | [`moving`] | the boxes of any two sets at both ends of the step: relative boxes for a hierarchy | exact |
//! | [`block`] | the boxes of sixteen resting sets with a box, within a distance | not certified: it sorts pairs into classes |
//! | [`mapping`] | how positions of any format become `f32` boxes, for any separation | monotone, or a certified bound |
//!
//! Motion is linear in all of them: a coordinate lies between its values at both ends of the step.

/// Evaluates a test of the four points' values at the start and at the end along each axis, and combines the results by or.
///
/// This is a macro, like others in kernels. Closures and `array::map` are separate functions, which the compiler does not always
/// inline into code for a wider instruction set.
macro_rules! along_axes {
    ($points:expr, $test:expr) => {
        $test(values!($points.start, |p| p.x), values!($points.end, |p| p.x))
            | $test(values!($points.start, |p| p.y), values!($points.end, |p| p.y))
            | $test(values!($points.start, |p| p.z), values!($points.end, |p| p.z))
    };
}

/// Computes one value for each of four points.
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
#[cfg(feature = "batch")]
pub mod mapping;
#[cfg(feature = "batch")]
pub mod moving;
pub mod relative;
pub mod segment;

pub use aabb::Aabb;

use crate::lanes::Lanes;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if the swept boxes of its two sets do not overlap. This is exact; touching boxes overlap.
///
/// NaN and infinite coordinates keep the pair. So do coordinates so large that their sum overflows.
#[inline(always)]
pub fn swept_boxes<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => PairPoints::from(pair).have_disjoint_swept_boxes::<P>()))
}

impl<L: Lanes> PairPoints<L> {
    /// Makes the decision of [`swept_boxes`] on any number of lanes.
    #[inline(always)]
    #[must_use]
    pub fn have_disjoint_swept_boxes<P: PairShape>(&self) -> L::Mask {
        // The ranges drop NaN, so the last condition is needed.
        along_axes!(self, are_disjoint_intervals::<P, L>) & self.is_finite()
    }
}

/// Returns whether the intervals that the two sets' values sweep are disjoint.
#[inline(always)]
fn are_disjoint_intervals<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> L::Mask {
    let [[low_0, high_0], [other_low_0, other_high_0]] = P::ranges(start);
    let [[low_1, high_1], [other_low_1, other_high_1]] = P::ranges(end);
    low_0.smaller(low_1).greater(other_high_0.larger(other_high_1))
        | other_low_0.smaller(other_low_1).greater(high_0.larger(high_1))
}
