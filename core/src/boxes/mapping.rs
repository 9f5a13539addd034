//! From positions of any format to boxes in `f32`.
//!
//! # Without a separation
//! A coordinate x becomes fl₃₂(fl₆₄(x − o)), o the same for all of an axis. Both roundings are monotone, in any direction, so
//! images that are in strict order belong to coordinates that are: [nothing has to be rounded
//! outwards](super::moving#boxes-in-fewer-digits). `f32` positions stay as they are, with o = 0; so do
//! `f64` positions that are `f32` numbers, unless the mesh is far from the origin for its size. There o is its middle, so
//! that `f32` does not waste its digits on where the mesh is.
//!
//! # With a separation, or for a part of the step
//! Boxes are widened by half the separation s on each side, and a position within the step is rounded itself; then images
//! are no longer monotone, and bounds are moved outwards by more than all roundings together:
//!
//! ```text
//! widening = s/2 + 2⁻²²·(|x₀ − o| + |x₁ − o| + s/2) + 2⁻¹⁰⁰
//! ```
//!
//! In any direction of rounding, with v the magnitudes in brackets: the difference x − o is off by at most 2⁻⁵²v, a position
//! within the step by three operations more, each at most 2⁻⁵²v; sums in the widening and subtracting it by less than 2⁻⁴⁹v;
//! the last rounding, to `f32`, by at most 2⁻²³ of a number that is at most (1 + 2⁻²²)v. That is less than 2⁻²²v by
//! 2⁻²⁴v. Flushed numbers lose 2⁻¹²⁶ (`f32`) or 2⁻¹⁰²² each, less than 2⁻¹⁰⁰ altogether. So two images that are in strict
//! order belong to coordinates more than s apart. Overflow makes a bound infinite, or in directed rounding the largest number;
//! neither is beyond a bound that it should not be beyond, for both are at least as far out as any that is not widened.
//! What is NaN or infinite, or so large that a vertex's coordinates add up to that, has no bounds.
//!
//! # A smaller separation
//! Boxes that are made for a separation s can be asked for a smaller one, s′, without new ones: one of two is drawn in by δ = s − s′ on each
//! side ([`Inset`]). Were that exact, strict order would mean more than s/2 − δ + s/2 = s′. As computed, with B the largest magnitude of
//! its bounds, bounds are moved inwards by less:
//!
//! ```text
//! inset = δ − 8u·(B + δ)
//! ```
//!
//! (`f32`, u = 2⁻²⁴, any direction of rounding, 2u an operation; the product is exact.) δ was rounded to `f32`, the difference and the moved
//! bound, at most B + δ, are rounded: 6u(B + δ), and a little of second order, which is less than 8u(B + δ). A δ below 2⁻⁶⁰ draws
//! nothing in, so that flushed numbers are far less than what is left of that; nor does a sum of more
//! than [`Rounding::LARGEST_EDGE`].
//!
//! # Two mappings
//! Boxes of two mappings compare if both have one origin; of an empty extent it is zero. With half separations h and k, images in strict order
//! belong to coordinates more than h + k apart, as each bound is moved outwards by its own half. Without one (h = 0, the other with k > 0):
//! let b be the bound that was moved, an `f32` number, and image(x) < b. Were x ≥ b, image(x) ≥ image(b) = b, rounding being monotone: so x < b,
//! and the other coordinate is more than k beyond b. With origin zero x − o is exact, so that this holds of x itself.

use super::Aabb;
use super::moving::MovingBox;
use crate::lanes::{Lanes, Rounding};
use crate::scalar::Scalar;

/// How positions become boxes: the same for all vertices of a mesh, in one step.
///
/// ```
/// use selvedge_core::boxes::{Aabb, mapping::Mapping};
/// let extent = Aabb { lower: [0.0; 3], upper: [2.0; 3] };
/// let is_apart = |separation: f64| {
///     let mapping = Mapping::new(&extent, separation, 1.0, false);
///     mapping.vertex([0.0; 3], [1.0; 3]).is_apart_from(&mapping.vertex([0.5; 3], [2.0; 3]))
/// };
/// assert!(is_apart(0.0) && is_apart(0.499) && !is_apart(0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    origin: [f64; 3],
    /// Half of the separation.
    half: f64,
    /// Where in the step the boxes of the end are taken.
    until: f64,
    /// Both boxes the same, the swept one.
    is_swept: bool,
}

impl Mapping {
    /// For positions within `extent`, which only decides where the images are: any will do. Boxes that are apart prove that their sets keep
    /// more than `separation` apart until a time of the step, in (0, 1]: boxes of the end are taken there. `is_swept`: both boxes of
    /// a vertex are the one that it sweeps.
    #[must_use]
    pub fn new<S: Scalar>(extent: &Aabb<f64>, separation: S, until: S, is_swept: bool) -> Self {
        Self {
            origin: origin::<S>(extent),
            half: 0.5 * separation.raised_to_normal().to_f64(),
            until: until.to_f64(),
            is_swept,
        }
    }

    /// The box of one vertex that moves from `start` to `end`. Merge those of a set's vertices.
    #[inline]
    #[must_use]
    pub fn vertex<S: Scalar>(&self, start: [S; 3], end: [S; 3]) -> MovingBox<f32> {
        let mut moving = MovingBox::empty();
        let mut sum = 0.0;
        for axis in 0..3 {
            let from = start[axis].to_f64() - self.origin[axis];
            let to = end[axis].to_f64() - self.origin[axis];
            sum += from.abs() + to.abs();
            let ([a, b], [c, d]) = if self.half == 0.0 && self.until == 1.0 {
                ([from; 2], [to; 2])
            } else {
                let sizes = from.abs() + to.abs() + self.half;
                let widening = self.half + (WIDENING * sizes + FLUSHED);
                let until = (1.0 - self.until) * from + self.until * to;
                ([from - widening, from + widening], [until - widening, until + widening])
            };
            moving.start.lower[axis] = image(a);
            moving.start.upper[axis] = image(b);
            moving.end.lower[axis] = image(c);
            moving.end.upper[axis] = image(d);
        }
        // Of what is NaN or infinite so is the sum.
        if !sum.is_finite() {
            return MovingBox {
                start: Aabb::everything(),
                end: Aabb::everything(),
            };
        }
        if self.is_swept {
            let swept = moving.swept();
            moving = MovingBox {
                start: swept,
                end: swept,
            };
        }
        moving
    }
}

/// By how much boxes of one [mapping](Mapping) are drawn in to be asked for a smaller separation than they were made for.
///
/// ```
/// use selvedge_core::boxes::{Aabb, mapping::{Inset, Mapping}};
/// let extent = Aabb { lower: [0.0; 3], upper: [2.0; 3] };
/// let mapping = Mapping::new(&extent, 0.5, 1.0, false);
/// let [own, other] = [0.0, 0.4].map(|x| mapping.vertex([x, 0.0, 0.0], [x + 1.0, 0.0, 0.0]));
/// let is_apart = |smaller: f64| own.drawn_in(Inset::new(0.5, smaller).for_bounds(&own)).is_apart_from(&other);
/// assert!(!own.is_apart_from(&other));
/// assert!(is_apart(0.0) && is_apart(0.399) && !is_apart(0.4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inset {
    /// δ; less than any number if there is none.
    by: f32,
}

impl Inset {
    /// For boxes that were made for `separation`: a pair of which one is [drawn in](MovingBox::drawn_in) and apart from the other keeps more
    /// than `smaller`.
    #[inline]
    #[must_use]
    pub fn new(separation: f64, smaller: f64) -> Self {
        let by = separation - smaller;
        let by = if by >= SHORTEST { image(by) } else { f32::NEG_INFINITY };
        Self { by }
    }

    /// By how much boxes within `bounds` are to be drawn in: less than any number, so that they are apart from nothing, if there is nothing
    /// to draw in or it cannot be told.
    #[inline]
    #[must_use]
    pub fn for_bounds(self, bounds: &MovingBox<f32>) -> f32 {
        let corners = [bounds.start.lower, bounds.start.upper, bounds.end.lower, bounds.end.upper];
        let largest = corners.iter().flatten().fold(0.0, |largest: f32, x| largest.larger(x.abs()));
        let sum = largest + self.by;
        if (0.0..=f32::LARGEST_EDGE).contains(&sum) {
            self.by - f32::small(8) * f32::UNIT_ROUNDOFF * sum
        } else {
            f32::NEG_INFINITY
        }
    }
}

/// 2⁻⁶⁰.
const SHORTEST: f64 = 1.0 / (1_u64 << 60) as f64;
/// 2⁻²².
const WIDENING: f64 = 1.0 / 4_194_304.0;
/// 2⁻¹⁰⁰.
const FLUSHED: f64 = f64::from_bits((1023 - 100) << 52);

/// A coordinate in `f32`. It never exchanges two of them: images in strict order belong to coordinates that are, in every floating-point
/// environment.
#[inline]
#[must_use]
pub fn image(coordinate: f64) -> f32 {
    f32::from_f64(coordinate)
}

/// The middle of an axis where it is more than four times the mesh's size away from zero; else zero.
fn origin<S: Scalar>(extent: &Aabb<f64>) -> [f64; 3] {
    let is_single = S::UNIT_ROUNDOFF.to_f64() > f64::EPSILON;
    let ([a, b, c], [d, e, f]) = (extent.lower, extent.upper);
    [(a, d), (b, e), (c, f)].map(|(lower, upper)| {
        let (lower, upper) = (0.5 * lower, 0.5 * upper);
        let middle = lower + upper;
        let is_far = middle.is_finite() && middle.abs() > 8.0 * (upper - lower);
        if is_far && !is_single { middle } else { 0.0 }
    })
}
