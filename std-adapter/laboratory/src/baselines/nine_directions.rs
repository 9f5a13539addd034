//! Bounds along nine directions: x, y, z and the diagonals x±y, x±z, y±z.
//!
//! [`separated`] is our reading of the subspace filters of Tang, Li and Wang 2011. [`Dop18`] is the swept bounding volume of
//! Hutter and Fuhrmann 2007, who keep one for every vertex, edge and triangle. Neither culls a pair that touches, in any
//! floating-point environment. NaN and infinite coordinates keep the pair.
//!
//! # Why sums may round
//! Rounding is monotone in any direction: x ≤ y implies fl(x) ≤ fl(y). So fl(a) > fl(b) proves a > b. A coordinate along a
//! diagonal is a sum of two coordinates, rounded once, and needs no error bound.
//!
//! Flushed operands break that: with λ the smallest normal number, λ/2 + λ/2 becomes 0. Hence one value must exceed the other
//! plus g = η/u, far above λ. Let A = fl(a + b) > fl(Z + g) with Z = fl(c + d).
//! * |Z| ≤ g/16u: then A ≥ Z + g/2, and all roundings and flushed operands together are less than g/2.
//! * |Z| > g/16u: at most one operand of a sum of that size is flushed. The sums of the others are multiples of a step far above
//!   λ, or differ by a normal operand, which exceeds the flushed one.
//!
//! Coordinates need the gap as well. A compiler may add zero to them, to make one vector operation of comparisons of coordinates
//! and of sums, and that flushes one side only.

use selvedge_core::batch::PointsTest;
use selvedge_core::kernels::lanes::{Lanes, Rounding};
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::{PairPoints, PairShape};
use selvedge_core::{Motion, PrimitivePair, Scalar, Verdict};

/// Culls `pair` if one of nine directions keeps its two sets apart, in the same order, throughout the step.
///
/// One value must exceed the other by a gap, so pairs with coordinates near the smallest normal numbers are kept.
#[inline(always)]
pub fn separated<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => NineDirections.on::<P, S>(&pair.into())))
}

/// The test [`separated`] for batches: [`ByPoints`](selvedge_core::batch::ByPoints).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NineDirections;

impl PointsTest for NineDirections {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask {
        macro_rules! along {
            ($p:ident => $value:expr) => {{
                // This is a macro, since a closure is not always inlined into code for a wider instruction set.
                macro_rules! ranges {
                    ($points:expr) => {{
                        let [a, b, c, d] = $points;
                        P::ranges([
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
                        ])
                    }};
                }
                are_in_order::<L>(ranges!(points.start), ranges!(points.end))
            }};
        }
        let axes = along!(p => p.x) | along!(p => p.y) | along!(p => p.z);
        let diagonals = (along!(p => p.x + p.y) | along!(p => p.x - p.y))
            | (along!(p => p.x + p.z) | along!(p => p.x - p.z))
            | (along!(p => p.y + p.z) | along!(p => p.y - p.z));
        (axes | diagonals) & points.is_finite()
    }
}

/// Returns whether one set's values exceed the other's by the gap, at the start and at the end.
#[inline(always)]
fn are_in_order<L: Lanes>(start: [[L; 2]; 2], end: [[L; 2]; 2]) -> L::Mask {
    let [[low_0, high_0], [other_low_0, other_high_0]] = start;
    let [[low_1, high_1], [other_low_1, other_high_1]] = end;
    // Both are powers of two, so the quotient is exact.
    let gap = low_0.splat(L::Scalar::UNDERFLOW) / low_0.splat(L::Scalar::UNIT_ROUNDOFF);
    (low_0.greater(other_high_0 + gap) & low_1.greater(other_high_1 + gap))
        | (other_low_0.greater(high_0 + gap) & other_low_1.greater(high_1 + gap))
}

/// A swept 18-DOP: bounds along nine directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dop18<S> {
    lower: [S; 9],
    upper: [S; 9],
}

impl<S: Scalar> Dop18<S> {
    /// Returns the bounds of one moving point. They are unbounded if a coordinate is NaN or infinite.
    #[inline]
    pub fn swept(motion: &Motion<S>) -> Self {
        let [start, end]: [[S; 3]; 2] = [motion.start.into(), motion.end.into()];
        if !start.iter().chain(&end).all(|coordinate| coordinate.is_finite()) {
            return Self {
                lower: [-S::INFINITY; 9],
                upper: [S::INFINITY; 9],
            };
        }
        let (start, end) = (along_nine_directions(start), along_nine_directions(end));
        let mut dop = Self {
            lower: start,
            upper: start,
        };
        for direction in 0..9 {
            dop.lower[direction] = start[direction].smaller(end[direction]);
            dop.upper[direction] = start[direction].larger(end[direction]);
        }
        dop
    }

    /// Returns the bounds of both together.
    #[inline]
    pub fn merged(&self, other: &Self) -> Self {
        let mut merged = *self;
        for direction in 0..9 {
            merged.lower[direction] = other.lower[direction].smaller(merged.lower[direction]);
            merged.upper[direction] = other.upper[direction].larger(merged.upper[direction]);
        }
        merged
    }

    /// Returns false only if the two sets are certainly apart throughout the step.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        let gap = S::UNDERFLOW / S::UNIT_ROUNDOFF;
        let mut apart = false;
        for direction in 0..9 {
            apart |= self.lower[direction] > other.upper[direction] + gap;
            apart |= other.lower[direction] > self.upper[direction] + gap;
        }
        !apart
    }
}

/// Returns a point's values along the nine directions. Sums are rounded.
#[inline(always)]
fn along_nine_directions<S: Scalar>([x, y, z]: [S; 3]) -> [S; 9] {
    [x, y, z, x + y, x - y, x + z, x - z, y + z, y - z]
}
