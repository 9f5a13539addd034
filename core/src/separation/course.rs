//! A course: the straight path on which a point is expected, and how far it may stray from it.
//!
//! Pairs may [keep a clearance](super::clearance) of h on the courses of their points, although each point strays by b/2 along
//! each axis. Such pairs need no attention while no point strays further. If a smaller distance m is enough, points may stray by
//! half of (h − m)/√3 more: along a direction d of length one, by (h − m)/2·(|d₁| + |d₂| + |d₃|)/√3 ≤ (h − m)/2 each. [`room`] is
//! a hundredth less than that.
//!
//! A point that begins at `origin` is expected at `origin + drift·t` after a time t. At the end of the course this is `origin +
//! drift·span`, from which the clearance was computed. Between times at which it is within its room, it moves on a straight path,
//! as its course does. So it is within its room in between as well.
//!
//! # Rounding
//! An operation errs by ε = 2u in any rounding direction. Let B be the largest coordinate of all origins and ends. `drift·span`
//! is at most 2B(1 + 3ε). The end of the course is off by ε of the product and ε of the sum. A course that was [joined
//! later](joined) is off by as much again at its origin, and by ε of `span − t`; the expected position adds 2 operations. All
//! together is less than 20εB = 40uB. The difference from the point's position loses ε of itself. [`is_certain`] demands that
//! 64u·B, and η for flushed numbers, be at most 1/128 of the room. The hundredth is more: 0.01/0.99.
use crate::lanes::more_roundoffs;
use crate::scalar::{Position, Scalar};
use crate::vector::Vector;

/// Returns how far points may stray along each axis, for pairs with the [clearance](super::clearance) of `stray` to keep all of
/// it except `spare`. It is in the unit of the positions, and negative if they may not stray.
#[inline]
#[must_use]
pub fn room<S: Scalar>(stray: S, spare: S) -> S {
    // A negative spare must not grow by rounding: a difference may cancel.
    let spare = if spare < S::ZERO {
        spare * more_roundoffs(spare, 16)
    } else {
        spare
    };
    S::from_f64(0.99) * (S::HALF * (stray + spare / S::from_f64(3.0).sqrt()))
}

/// Returns whether a [room](room()) is certain despite rounding. `largest` is the
/// [`largest_coordinate`](super::largest_coordinate) of all origins and ends of courses. It is false with NaN, and if points may
/// not stray.
#[inline]
#[must_use]
pub fn is_certain<S: Scalar>(room: S, largest: S) -> bool {
    let rounding = S::small(64) * S::UNIT_ROUNDOFF * largest + S::UNDERFLOW;
    largest <= S::LARGEST_EDGE && S::small(128) * rounding <= room
}

/// Returns the position where a point is expected, `time` after the origin of its course; rounded.
#[inline(always)]
#[must_use]
pub fn expected<P: Position>(origin: P, drift: P, time: P::Scalar) -> P {
    let Vector { x, y, z } = Vector::from(origin.into()) + Vector::from(drift.into()).scaled(time);
    P::from([x, y, z])
}

/// Returns the origin of the course of a point that is at `position`, `elapsed` after the origin; rounded.
#[inline(always)]
#[must_use]
pub fn joined<P: Position>(position: P, drift: P, elapsed: P::Scalar) -> P {
    let Vector { x, y, z } = Vector::from(position.into()) - Vector::from(drift.into()).scaled(elapsed);
    P::from([x, y, z])
}

/// Returns whether a point is within its room of its expected position, along each axis. It is certified if the room [is
/// certain](is_certain), and false with NaN.
#[inline(always)]
#[must_use]
pub fn has_room<P: Position>(position: P, expected: P, room: P::Scalar) -> bool {
    let Vector { x, y, z } = (Vector::from(position.into()) - Vector::from(expected.into())).abs();
    // The comparisons are ordered, since a largest component would drop NaN.
    x <= room && y <= room && z <= room
}

/// Returns the time `h` after `elapsed`, if a course of length `span` lasts until then. Steps that add up to the span up to
/// rounding end with it.
#[inline]
#[must_use]
pub fn time_after<S: Scalar>(elapsed: S, h: S, span: S) -> Option<S> {
    let time = elapsed + h;
    (time <= span * S::from_f64(1.0 + 1e-9)).then(|| time.smaller(span))
}
