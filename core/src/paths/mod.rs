//! Points that move on arcs of rotating bodies, or on several straight pieces.
//!
//! All tests of this crate are for straight motion. A [`Path`] is reduced to it piece by piece. For any part of the step it
//! returns a straight [motion](Piece::motion), and a bound of the point's distance from it, **rounding included**. Sets that are
//! farther apart than the bounds of both sides on straight paths cannot meet on their paths. Where that does not decide, the part
//! is halved, and for half an arc the bound is a quarter. [`time_of_impact`] does that for one pair, and [`geometry`] returns how
//! the pair then meets.
//!
//! | path | what it is |
//! |---|---|
//! | [`Motion<f64>`] | straight, at constant velocity |
//! | [`Arc`], of a [`RigidMotion`] | with a body that turns at a constant rate about a translating axis |
//! | [`Polyline`] | straight pieces, from knot to knot |
//!
//! All computation is in `f64`. A caller's own path is certified if its bound is.

#[cfg(feature = "batch")]
mod geometry;
mod impact;
mod polyline;
mod rigid;

#[cfg(feature = "batch")]
pub use geometry::geometry;
pub use impact::{separation_of_pieces, time_of_impact};
pub use polyline::Polyline;
pub use rigid::{Arc, RigidMotion};

use crate::lanes::Rounding;
use crate::motion::Motion;
use glam::DVec3;

/// A straight approximation of a path in a part of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The motion from the point's position at the beginning of the part to that at its end, at constant velocity, both rounded.
    pub motion: Motion<f64>,
    /// An upper bound of the point's distance from the motion, at any time of the part. It is not finite if nothing is known.
    pub deviation: f64,
}

/// A point on its path at some time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// The position.
    pub position: DVec3,
    /// An upper bound of the true position's distance from it. It is not finite if nothing is known.
    pub position_error: f64,
    /// The velocity, in lengths per step.
    pub velocity: DVec3,
    /// A bound of the true velocity's distance from it.
    pub velocity_error: f64,
}

/// The path of a point during the step.
pub trait Path {
    /// Returns the part between two times, 0 ≤ `from` < `to` ≤ 1. The result for other times is unspecified.
    fn piece(&self, from: f64, to: f64) -> Piece;

    /// Returns the point at a time in [0, 1]. Where its velocity jumps, it is the one before. The result for other times is
    /// unspecified.
    fn moment(&self, time: f64) -> Moment;
}

impl Path for Motion<f64> {
    fn piece(&self, from: f64, to: f64) -> Piece {
        let motion = Self::new(self.at(from), self.at(to));
        let is_whole = from == 0.0 && to == 1.0;
        Piece {
            motion,
            deviation: if is_whole { 0.0 } else { rounding(self) },
        }
    }

    fn moment(&self, time: f64) -> Moment {
        Moment {
            position: self.at(time),
            position_error: rounding(self),
            velocity: self.end - self.start,
            // Along each axis the error is within 2u of twice the larger coordinate: less than 7u of it in all.
            velocity_error: rounding(self),
        }
    }
}

/// Returns a bound of the rounding error of a position on a straight path: along each axis 8u of the larger coordinate, 13.9u of
/// it in all.
fn rounding(motion: &Motion<f64>) -> f64 {
    16.0 * u() * largest(motion.start).max(largest(motion.end)) + <f64 as Rounding>::UNDERFLOW
}

/// Returns half the distance from 1 to the next number.
const fn u() -> f64 {
    <f64 as Rounding>::UNIT_ROUNDOFF
}

/// Returns the largest magnitude of a coordinate; NaN if one is NaN.
fn largest(point: DVec3) -> f64 {
    let [x, y, z] = point.abs().to_array();
    // A maximum may drop NaN.
    x.max(y).max(z) + 0.0 * (x + y + z)
}

/// Returns the length of a vector, rounded up: see [`separation::geometry`](crate::separation::geometry), 11 half roundings.
fn length_above(vector: DVec3) -> f64 {
    let size = largest(vector);
    if size > 0.0 {
        size * (vector / size).length() * (1.0 + 16.0 * u()) + <f64 as Rounding>::UNDERFLOW
    } else {
        size
    }
}
