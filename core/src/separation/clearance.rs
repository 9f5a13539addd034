//! Clearance: pairs that keep a distance although their points stray, and need no attention while no point strays too far.
//!
//! The caller looks for points that come within a distance h of each other. Each may stray by b/2 along each axis from a straight
//! motion. A direction d that keeps two sets more than a distance apart, times its length, at the start and at the end, does so
//! in between. Two points stray towards each other along d by at most b·(|d₁| + |d₂| + |d₃|). So d must keep h·|d| + b·(|d₁| +
//! |d₂| + |d₃|). The test tries the axes, with h + b, and then the direction from the middle of one set to the middle of the
//! other. The latter settles most of the remaining pairs: triangles side by side.
//!
//! # Rounding
//! An operation in `f32` errs by ε = 2u = 2⁻²³ in any rounding direction. A coordinate of at most B is rounded by at most εB, and
//! the difference of two, at most 2B, by 2εB more: together 4εB along an axis. A product with d errs by √3·εB·|d| from the
//! coordinates and by 3ε·√3·B·|d| from its own operations, to first order. The difference of two products errs by twice that and
//! 2√3·εB·|d| more: together 18εB·|d|. |d|, the sum and the required distance err by less than 8ε of themselves.
//! [`Clearance::new`] adds 32ε of B and of the distance.
//! **Underflow.** Flushed operands and results, of λ each, make less than 40λ(1 + |d|) along d. 2⁻⁸⁰ is added to h. A direction
//! whose square is not above 10⁻¹⁸ proves nothing; otherwise |d| is above 2⁻³⁰, and 2⁻⁸⁰|d| ≥ 40λ(1 + |d|). **Overflow.** If B
//! exceeds 2³⁰, or a distance is NaN, nothing is proven, as if h were infinite.

use crate::kind::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::points::{PairPoints, PairShape};
use crate::vector::Vector;
use glam::Vec3A;

/// The distance that a pair must keep to need no attention, for positions rounded to `f32`; in the unit of the positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// h plus the rounding error, rounded up.
    along_axis: f32,
    along_direction: f32,
}

/// The part of the distance, and of the largest coordinate, that is added: 32ε.
#[inline(always)]
fn rounding() -> f64 {
    f64::small(64) * f64::from(f32::UNIT_ROUNDOFF)
}

/// The allowance for underflow.
const FLUSHED: f64 = 1.0 / (1_u128 << 80) as f64;
/// The squared length above which a direction is long enough.
const SHORTEST: f32 = 1e-18;

impl Clearance {
    /// A clearance that no pair keeps.
    pub const UNKNOWN: Self = Self {
        along_axis: f32::INFINITY,
        along_direction: f32::INFINITY,
    };

    /// Makes a clearance for points that must keep `distance`. No coordinate exceeds `largest` in magnitude
    /// ([`largest_coordinate`](super::largest_coordinate)). Along a direction that is not an axis, `margin` times the distance is
    /// required in addition, zero or more; no proof depends on it.
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

    /// Returns how far points may stray on straight paths from `start` to `end`, so that the pair certainly keeps its distance.
    /// The pair must keep it at both ends, in the same order, along an axis or along the direction between the sets' middles. The
    /// result is less than zero if points may not stray at all.
    /// [`largest_strays_from_rows`](crate::batch::largest_strays_from_rows) computes it for many pairs.
    ///
    /// The result is certified, in every floating-point environment, for positions that were rounded to the nearest `f32` in any
    /// rounding direction. The stray that is compared with the result may also be rounded to `f32`, and may be the rounded mean
    /// of two.
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

    /// Returns a gap between the boxes of two sets that certainly lets their points [stray](Self::largest_stray) by `beyond`,
    /// rounded to `f32`; infinite if no gap does. The gap is along an axis, at both ends of the step and in the same order. A
    /// hierarchy of boxes that skips such sets skips only pairs that would be skipped one by one; no proof depends on it. No
    /// coordinate exceeds `largest` in magnitude.
    ///
    /// The kept distance along an axis is off by at most 4εB ([module](self)), and its difference to the required one by ε of
    /// both. The last product is off by 2⁻¹⁷ and ε, and `beyond` by ε. The gap adds 16εB, and 2⁻¹⁶ of the two, which is more.
    #[inline]
    #[must_use]
    pub fn certain_gap(&self, beyond: f64, largest: f64) -> f64 {
        (f64::from(self.along_axis) + beyond) * (1.0 + 1.0 / 65_536.0)
            + largest * (f64::small(32) * f64::from(f32::UNIT_ROUNDOFF))
    }

    /// Returns the required distance along an axis, and along a direction times its length, before any point strays.
    #[inline(always)]
    pub(crate) const fn asked(&self) -> [f32; 2] {
        [self.along_axis, self.along_direction]
    }
}

/// Returns how far points may stray, given the [required distances](Clearance::asked) of each pair.
///
/// The division, its operands, and the stray that is compared with the result err by less than 8ε of the result: 2⁻¹⁷ is taken
/// off.
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

/// Returns the distances by which the first set of a pair is ahead of the second, and behind it, at both ends. It takes the
/// points' places on a line.
#[inline(always)]
fn kept<P: PairShape, L: Lanes>(start: [L; 4], end: [L; 4]) -> [L; 2] {
    let [[low, high], [other_low, other_high]] = P::ranges(start);
    let [[later_low, later_high], [later_other_low, later_other_high]] = P::ranges(end);
    [
        (low - other_high).smaller(later_low - later_other_high),
        (other_low - high).smaller(later_other_low - later_high),
    ]
}

/// Returns the distance, rounded down, at which boxes of positions rounded to `f32` prove that the positions are within
/// `distance`; −∞ if none does. No coordinate exceeds `largest` in magnitude.
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

/// Returns whether the boxes of a pair at rest come within `distance` of each other along each axis. It is false if all of a set
/// is NaN.
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

/// Returns the distances by which the first set of a pair is ahead of the second, and behind it, along each axis.
#[inline(always)]
fn gaps(kind: PairKind, [a, b, c, d]: [Vec3A; 4]) -> [Vec3A; 2] {
    let (low, high, other_low, other_high) = match kind {
        PairKind::VertexFace => (a, a, b.min(c).min(d), b.max(c).max(d)),
        PairKind::EdgeEdge => (a.min(b), a.max(b), c.min(d), c.max(d)),
    };
    [low - other_high, other_low - high]
}
