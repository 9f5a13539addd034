//! Maps positions of any format to boxes in `f32`.
//!
//! # Without a separation
//! A coordinate x becomes fl₃₂(fl₆₄(x − o)), with one origin o for each axis. Both roundings are monotone in any direction. So
//! images in strict order belong to coordinates in strict order, and [nothing has to be rounded
//! outwards](super::moving#boxes-in-fewer-digits). `f32` positions are unchanged, with o = 0. So are `f64` positions that are
//! `f32` numbers, unless the mesh is far from the origin for its size. Then o is its middle, so that `f32` does not spend its
//! digits on the mesh's position.
//!
//! # With a separation, or for a part of the step
//! Boxes are widened by half the separation s on each side, and a position within the step is itself rounded. Then images are not
//! monotone, and bounds move outwards by more than all roundings together:
//!
//! ```text
//! widening = s/2 + 2⁻²²·(|x₀ − o| + |x₁ − o| + s/2) + 2⁻¹⁰⁰
//! ```
//!
//! Let v be the sum of the magnitudes in brackets. In any rounding direction, the difference x − o is off by at most 2⁻⁵²v, and a
//! position within the step by three more operations of at most 2⁻⁵²v each. The sums in the widening and its subtraction are off
//! by less than 2⁻⁴⁹v. The last rounding, to `f32`, is off by at most 2⁻²³ of a number that is at most (1 + 2⁻²²)v. The total is
//! less than 2⁻²²v by 2⁻²⁴v. Flushed numbers lose 2⁻¹²⁶ (`f32`) or 2⁻¹⁰²² each, less than 2⁻¹⁰⁰ in all. So two images in strict
//! order belong to coordinates more than s apart.
//!
//! Overflow makes a bound infinite, or the largest number in directed rounding. Either is at least as far out as any bound that
//! is not widened, so it never exceeds a bound wrongly. Vertices whose coordinates are NaN or infinite, or add up to that, have
//! no bounds.
//!
//! # A smaller separation
//! Boxes made for a separation s also serve a smaller one, s′: one of two boxes is drawn in by δ = s − s′ on each side
//! ([`Inset`]). In exact arithmetic, strict order then means more than s/2 − δ + s/2 = s′. With B the largest magnitude of its
//! bounds, computed bounds move inwards by less:
//!
//! ```text
//! inset = δ − 8u·(B + δ)
//! ```
//!
//! These numbers are `f32`: u = 2⁻²⁴, and an operation errs by 2u in any rounding direction; the product is exact. δ is rounded
//! to `f32`, and so are the difference and the moved bound, at most B + δ: 6u(B + δ) and a little of second order, less than
//! 8u(B + δ). A δ below 2⁻⁶⁰ draws nothing in, so flushed numbers are far less than the rest of it. Nor does a sum above
//! [`Rounding::LARGEST_EDGE`].
//!
//! # Two mappings
//! Boxes of two mappings compare if both have one origin; for an empty extent it is zero. With half separations h and k, images
//! in strict order belong to coordinates more than h + k apart, since each bound moves outwards by its own half. Now let h = 0
//! and k > 0, let b be the bound that moved, an `f32` number, and image(x) < b. If x ≥ b, then image(x) ≥ image(b) = b, rounding
//! being monotone. So x < b, and the other coordinate is more than k beyond b. With origin zero, x − o is exact, so that this
//! holds of x itself.

use super::Aabb;
use super::moving::MovingBox;
use crate::lanes::{Lanes, Rounding};
use crate::scalar::Scalar;

/// The map from positions to boxes: one for all vertices of a mesh, in one step.
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
    half: f64,
    /// The time of the step at which the end's boxes are taken.
    until: f64,
    /// True if both boxes are the swept one.
    is_swept: bool,
}

impl Mapping {
    /// Makes a mapping for positions within `extent`. Boxes that are apart prove that their sets keep more than `separation`
    /// apart until the time `until` in (0, 1], where the end's boxes are taken.
    ///
    /// Any `extent` is correct: it only decides where the images are. With `is_swept`, both boxes of a vertex are its swept box.
    #[must_use]
    pub fn new<S: Scalar>(extent: &Aabb<f64>, separation: S, until: S, is_swept: bool) -> Self {
        Self {
            origin: origin::<S>(extent),
            half: 0.5 * separation.raised_to_normal().to_f64(),
            until: until.to_f64(),
            is_swept,
        }
    }

    /// Returns the box of one vertex that moves from `start` to `end`. Merge the boxes of a set's vertices.
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
        // The sum is not finite if a coordinate is not.
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

/// The amount by which boxes of one [mapping](Mapping) are drawn in, to serve a smaller separation than they were made for.
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
    /// δ, or −∞ if nothing can be drawn in.
    by: f32,
}

impl Inset {
    /// Makes an inset for boxes made for `separation`. If one box of a pair is [drawn in](MovingBox::drawn_in) and apart from the
    /// other, the pair keeps more than `smaller`.
    #[inline]
    #[must_use]
    pub fn new(separation: f64, smaller: f64) -> Self {
        let by = separation - smaller;
        let by = if by >= SHORTEST { image(by) } else { f32::NEG_INFINITY };
        Self { by }
    }

    /// Returns the amount by which boxes within `bounds` are drawn in. It is −∞, so that they are apart from nothing, if nothing
    /// can be drawn in.
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

const SHORTEST: f64 = 1.0 / (1_u64 << 60) as f64;
/// The relative widening of bounds, 2⁻²².
const WIDENING: f64 = 1.0 / 4_194_304.0;
/// The loss of flushed numbers, 2⁻¹⁰⁰.
const FLUSHED: f64 = f64::from_bits((1023 - 100) << 52);

/// Rounds a coordinate to `f32`. It is monotone: images in strict order belong to coordinates in strict order, in every
/// floating-point environment.
#[inline]
#[must_use]
pub fn image(coordinate: f64) -> f32 {
    f32::from_f64(coordinate)
}

/// Returns the middle along each axis if it is more than four times the mesh's size away from zero; otherwise zero.
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
