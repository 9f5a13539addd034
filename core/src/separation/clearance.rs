//! Pairs that keep a distance though their points stray: which of them need no attention while no point strays too far.
//!
//! Points are looked for that come within a distance h of each other, though each may stray by b/2 along each axis from a motion on
//! straight ways. A direction d that keeps two sets apart by more than some distance, times its length, at the start and at the end, does so
//! in between, whatever d is. Two points stray along d by b·(|d₁| + |d₂| + |d₃|) towards each other, so h·|d| + b·(|d₁| + |d₂| + |d₃|) must be
//! kept along d. The axes are tried, h + b; then the direction from the middle of one set to the middle of the other, which shows most
//! of what is left at once: triangles side by side.
//!
//! # Rounding
//! (`f32`; any direction: ε = 2u = 2⁻²³ an operation.) A coordinate of at most B is rounded by εB at most, and the difference of
//! two, at most 2B, by 2εB more: together 4εB along an axis. A product with d errs by √3·εB·|d| from the coordinates and by 3ε·√3·B·|d|
//! from its own operations, to first order; the difference of two of them by twice that and 2√3·εB·|d| more: together 18εB·|d|. |d|, the
//! sum and what is asked for err by less than 8ε of themselves. 32ε of B and of the distance are added ([`Clearance::new`]).
//!
//! **Underflow.** Flushed operands and results, of λ each, make less than 40λ(1 + |d|) along d. 2⁻⁸⁰ is added to h, and a direction whose
//! square is not above 10⁻¹⁸ proves nothing: |d| is then above 2⁻³⁰, and 2⁻⁸⁰|d| ≥ 40λ(1 + |d|).
//! **Overflow.** B must not exceed 2³⁰, or nothing is proven, as if h were infinite; nor if a distance is NaN.

use crate::kind::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::points::{PairPoints, PairShape};
use crate::vector::Vector;
use glam::Vec3A;

/// What a pair must keep to need no attention, of positions rounded to `f32`; in the unit of the positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// h with what rounding may take of it, rounded up; and the same along a direction that is no axis.
    along_axis: f32,
    along_direction: f32,
}

/// How much of the distance, and of the largest coordinate, is added: 32ε.
#[inline(always)]
fn rounding() -> f64 {
    f64::small(64) * f64::from(f32::UNIT_ROUNDOFF)
}

/// For what underflows.
const FLUSHED: f64 = 1.0 / (1_u128 << 80) as f64;
/// Squared length of a direction that is long enough.
const SHORTEST: f32 = 1e-18;

impl Clearance {
    /// Nothing keeps it.
    pub const UNKNOWN: Self = Self {
        along_axis: f32::INFINITY,
        along_direction: f32::INFINITY,
    };

    /// Of points that are to keep `distance`. No coordinate exceeds `largest` in
    /// magnitude ([`largest_coordinate`](super::largest_coordinate)). Along a direction that is no axis `margin` times the distance is
    /// asked for in addition, zero or more: it is no part of the proof.
    #[inline]
    #[must_use]
    pub fn new(distance: f64, largest: f64, margin: f32) -> Self {
        let is_in_range = largest <= f64::from(f32::LARGEST_EDGE) && distance >= 0.0 && margin >= 0.0;
        if !is_in_range {
            return Self::UNKNOWN;
        }
        let along_axis = narrowed(distance * (1.0 + rounding()) + largest * rounding() + FLUSHED);
        Self {
            along_axis,
            along_direction: along_axis * (1.0 + margin),
        }
    }

    /// How far points may stray, b of the [module](self), for a pair to keep its distance certainly on straight ways from `start` to `end`, along an
    /// axis or the direction between its middles: at both ends, and with the same order. Less than zero if they may not.
    /// [`largest_strays_from_rows`](crate::batch::largest_strays_from_rows) says it of many pairs.
    ///
    /// Certified, in every floating-point environment, for positions of which these are the nearest `f32` in any direction of rounding. What is
    /// compared with it may have been rounded to `f32` as well, and be the rounded mean of two.
    ///
    /// ```
    /// use selvedge_core::{PairKind, glam::Vec3A, separation::clearance::Clearance};
    /// let at = |height| [Vec3A::new(0.2, 0.2, height), Vec3A::ZERO, Vec3A::X, Vec3A::Y];
    /// let stray = |distance| Clearance::new(distance, 1.0, 0.0).largest_stray(PairKind::VertexFace, at(0.5), at(0.4));
    /// assert!(stray(0.3) < 0.1 && stray(0.3) > 0.0999);
    /// assert!(stray(0.41) < 0.0);
    /// ```
    #[inline]
    #[must_use]
    pub fn largest_stray(&self, kind: PairKind, start: [Vec3A; 4], end: [Vec3A; 4]) -> f32 {
        let [start, end] = [start, end].map(|points| points.map(|point| Vector::from(point.to_array())));
        let points = PairPoints { start, end };
        let asked = self.asked();
        of_kind!(kind, P => largest_stray::<P, f32>(&points, asked))
    }

    /// A gap between the boxes of two sets along an axis, at both ends of the step and with the same order, from which on their points
    /// certainly are [found](Self::largest_stray) to stray by `beyond`, rounded to `f32`; infinite if there is none. A hierarchy of boxes that
    /// leaves out what has such a gap leaves out nothing but what would be left out one by one: no proof depends on it. No coordinate exceeds
    /// `largest` in magnitude.
    ///
    /// What is kept along an axis is off by at most 4εB ([module](self)), the difference to what is asked for by ε of both, the last product by
    /// 2⁻¹⁷ and ε, and `beyond` by ε: 16εB, and 2⁻¹⁶ of the two, are more.
    #[inline]
    #[must_use]
    pub fn certain_gap(&self, beyond: f64, largest: f64) -> f64 {
        (f64::from(self.along_axis) + beyond) * (1.0 + 1.0 / 65_536.0)
            + largest * (f64::small(32) * f64::from(f32::UNIT_ROUNDOFF))
    }

    /// What is asked for along an axis, and along a direction times its length, before anything strays.
    #[inline(always)]
    pub(crate) const fn asked(&self) -> [f32; 2] {
        [self.along_axis, self.along_direction]
    }
}

/// How far points may stray, given what is [asked](Clearance::asked) of each pair.
///
/// The division, and what led to it, and what is compared with it, err by less than 8ε of the result: 2⁻¹⁷ is taken off.
#[inline(always)]
pub(crate) fn largest_stray<P: PairShape, L: Lanes<Scalar = f32>>(points: &PairPoints<L>, asked: [L; 2]) -> L {
    let [along_axis, along_direction] = asked;
    let ([a, b, c, d], [e, f, g, h]) = (points.start, points.end);
    let [ahead, behind] = kept::<P, L>([a.x, b.x, c.x, d.x], [e.x, f.x, g.x, h.x]);
    let [ahead_y, behind_y] = kept::<P, L>([a.y, b.y, c.y, d.y], [e.y, f.y, g.y, h.y]);
    let [ahead_z, behind_z] = kept::<P, L>([a.z, b.z, c.z, d.z], [e.z, f.z, g.z, h.z]);
    let most = ahead
        .larger(behind)
        .larger(ahead_y.larger(behind_y))
        .larger(ahead_z.larger(behind_z));
    let by_axis = most - along_axis;

    let middle = P::between_middles([a + e, b + f, c + g, d + h]);
    let squared = middle.dot(middle);
    let at_start = [middle.dot(a), middle.dot(b), middle.dot(c), middle.dot(d)];
    let at_end = [middle.dot(e), middle.dot(f), middle.dot(g), middle.dot(h)];
    let [gap, _] = kept::<P, L>(at_start, at_end);
    let left = gap - along_direction * squared.sqrt();
    let sizes = middle.abs();
    let by_direction = left / ((sizes.x + sizes.y) + sizes.z);
    let is_long = squared.greater(gap.splat(SHORTEST));
    let by_direction = L::select(is_long, by_direction, gap.splat(f32::NEG_INFINITY));
    by_axis.larger(by_direction) * gap.splat(1.0 - 1.0 / 131_072.0)
}

/// By how much the first set of a pair is ahead of the second at both ends, and by how much it is behind, along a line on which the points
/// are there.
#[inline(always)]
fn kept<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> [L; 2] {
    let [[low, high], [other_low, other_high]] = P::ranges(start);
    let [[later_low, later_high], [later_other_low, later_other_high]] = P::ranges(end);
    [
        (low - other_high).smaller(later_low - later_other_high),
        (other_low - high).smaller(later_other_low - later_high),
    ]
}

/// How near boxes of positions, rounded to `f32`, must be for those of the positions themselves to be within `distance`, rounded down; less
/// than any if that cannot be told. No coordinate exceeds `largest` in magnitude.
#[inline]
#[must_use]
pub fn nearness(distance: f64, largest: f64) -> f32 {
    let is_in_range = largest <= f64::from(f32::LARGEST_EDGE);
    let rounded = distance * (1.0 - rounding()) - largest * rounding();
    if is_in_range && rounded > FLUSHED {
        narrowed(rounded)
    } else {
        f32::NEG_INFINITY
    }
}

/// Whether the boxes of a pair at rest come within `distance` of each other along each axis. False with NaN in all of a set.
#[inline(always)]
#[must_use]
pub fn are_boxes_within(kind: PairKind, points: [Vec3A; 4], distance: f32) -> bool {
    let [ahead, behind] = gaps(kind, points);
    ahead.max(behind).cmple(Vec3A::splat(distance)).all()
}

#[allow(clippy::cast_possible_truncation, reason = "what is rounded is covered by the bounds")]
#[inline(always)]
fn narrowed(length: f64) -> f32 {
    length as f32
}

/// By how much the first set of a pair is ahead of the second along each axis, and by how much it is behind.
#[inline(always)]
fn gaps(kind: PairKind, [a, b, c, d]: [Vec3A; 4]) -> [Vec3A; 2] {
    let (low, high, other_low, other_high) = match kind {
        PairKind::VertexFace => (a, a, b.min(c).min(d), b.max(c).max(d)),
        PairKind::EdgeEdge => (a.min(b), a.max(b), c.min(d), c.max(d)),
    };
    [low - other_high, other_low - high]
}
