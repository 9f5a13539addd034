//! Points that do not move on straight lines: on arcs with a body that turns, or on several straight pieces.
//!
//! All tests of this crate are of straight motion. A [`Path`] is brought to it piece by piece: of any part of the step it gives a straight
//! [motion](Piece::motion), and a bound of how far the point is from that at any time of the part, **rounding included**. What is farther
//! apart than the bounds of both sides on straight ways cannot meet on its paths; where that is not enough to tell, the part is cut, and
//! of an arc's half the bound is a quarter. [`time_of_impact`] does that for one pair, and [`geometry`] says how the pair meets then.
//!
//! | path | what it is |
//! |---|---|
//! | [`Motion<f64>`] | straight, at constant velocity |
//! | [`Arc`], of a [`RigidMotion`] | with a body that turns at a constant rate about an axis that moves on |
//! | [`Polyline`] | straight pieces, from knot to knot |
//!
//! All is computed in `f64`. A caller's own path is as good as its bound.

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

/// What a path is in a part of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// From where the point is at the beginning of the part to where it is at its end, at constant velocity, both rounded.
    pub motion: Motion<f64>,
    /// The point is certainly no farther than this from the motion, at any time of the part. Not finite if nothing is known.
    pub deviation: f64,
}

/// A point on its path at some time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Where it is.
    pub position: DVec3,
    /// The point is certainly no farther than this from there. Not finite if nothing is known.
    pub position_error: f64,
    /// How fast it moves, in lengths a step.
    pub velocity: DVec3,
    /// Its velocity is certainly no farther than this from that.
    pub velocity_error: f64,
}

/// A point's way during the step.
pub trait Path {
    /// The part between two times, 0 ≤ `from` < `to` ≤ 1. Of other times nothing is promised.
    fn piece(&self, from: f64, to: f64) -> Piece;

    /// The point at a time in [0, 1]; where its velocity changes at once, with the one before. Of other times nothing is promised.
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
            // Along each axis within 2u of twice the larger coordinate: less than 7u of it in all.
            velocity_error: rounding(self),
        }
    }
}

/// How far a point on a straight way may be from where it is computed to be: along each axis within 8u of the larger coordinate, 13.9u of it
/// in all.
fn rounding(motion: &Motion<f64>) -> f64 {
    16.0 * u() * largest(motion.start).max(largest(motion.end)) + <f64 as Rounding>::UNDERFLOW
}

/// Half the distance from 1 to the next number.
const fn u() -> f64 {
    <f64 as Rounding>::UNIT_ROUNDOFF
}

/// The largest magnitude of a coordinate; NaN if one is.
fn largest(point: DVec3) -> f64 {
    let [x, y, z] = point.abs().to_array();
    // A maximum may drop NaN.
    x.max(y).max(z) + 0.0 * (x + y + z)
}

/// Of a vector, or a little more: see [`separation::geometry`](crate::separation::geometry), 11 half roundings.
fn length_above(vector: DVec3) -> f64 {
    let size = largest(vector);
    if size > 0.0 {
        size * (vector / size).length() * (1.0 + 16.0 * u()) + <f64 as Rounding>::UNDERFLOW
    } else {
        size
    }
}
