//! A course: the straight way on which a point was expected when pairs were looked for, and how far it may stray from it.
//!
//! Pairs that [keep a clearance](super::clearance) of h on the courses of their points, though each strays by b/2 along each axis, need
//! not be looked at while none does. If less than h will do, m, they may stray by half of (h − m)/√3 more: along a direction d of length one
//! by (h − m)/2·(|d₁| + |d₂| + |d₃|)/√3 ≤ (h − m)/2 each. [`room`] is a hundredth less than that.
//!
//! A point that begins at `origin` is expected at `origin + drift·t` a time t later, and at the end of the course, `origin + drift·span`,
//! which the clearance was computed from. Between times at which it is within its room it moves on a straight way, as its course
//! does: so it is within its room there too.
//!
//! # Rounding
//! (Any direction: ε = 2u an operation.) Let B be the largest coordinate of all origins and ends. `drift·span` is no larger than
//! 2B(1 + 3ε). The end of the course is off by ε of the product and ε of the sum, a course that was [joined later](joined) by as much again
//! at its origin, and by ε of `span − t`; the expected position by 2 operations as well: all together less than 20εB = 40uB. The
//! difference from where the point is loses ε of itself. [`is_certain`] demands that 64u·B, and η for what is flushed, be no more
//! than 1/128 of the room, of which the hundredth is more: 0.01/0.99.

use crate::elementary::corners::more_roundoffs;
use crate::scalar::{Position, Scalar};
use crate::vector::Vector;

/// How far points may stray along each axis, for pairs that keep a distance to the [clearance](super::clearance) of `stray`, to keep
/// all of it but `spare`. In the unit of the positions; negative if nothing of it may be used.
#[inline]
#[must_use]
pub fn room<S: Scalar>(stray: S, spare: S) -> S {
    // Less than nothing to spare must not become more by rounding: a difference may cancel.
    let spare = if spare < S::ZERO { spare * more_roundoffs(16) } else { spare };
    S::from_f64(0.99) * (S::HALF * (stray + spare / S::from_f64(3.0).sqrt()))
}

/// Whether rounding leaves a [room](room()) certain, where `largest` is that of all coordinates at the courses' origins and ends
/// ([`largest_coordinate`](super::largest_coordinate)). False with NaN, and where nothing may stray.
#[inline]
#[must_use]
pub fn is_certain<S: Scalar>(room: S, largest: S) -> bool {
    let rounding = S::small(64) * S::UNIT_ROUNDOFF * largest + S::UNDERFLOW;
    largest <= S::LARGEST_EDGE && S::small(128) * rounding <= room
}

/// Where a point is expected, `time` after the origin of its course; rounded.
#[inline(always)]
#[must_use]
pub fn expected<P: Position>(origin: P, drift: P, time: P::Scalar) -> P {
    let Vector { x, y, z } = Vector::from(origin.into()) + Vector::from(drift.into()).scaled(time);
    P::from([x, y, z])
}

/// The origin of a course on which a point that is at `position`, `elapsed` after it, is from there on; rounded.
#[inline(always)]
#[must_use]
pub fn joined<P: Position>(position: P, drift: P, elapsed: P::Scalar) -> P {
    let Vector { x, y, z } = Vector::from(position.into()) - Vector::from(drift.into()).scaled(elapsed);
    P::from([x, y, z])
}

/// Whether a point is within its room of where it is expected, along each axis. Certified where that [is certain](is_certain). False
/// with NaN.
#[inline(always)]
#[must_use]
pub fn has_room<P: Position>(position: P, expected: P, room: P::Scalar) -> bool {
    let Vector { x, y, z } = (Vector::from(position.into()) - Vector::from(expected.into())).abs();
    // Ordered comparisons: a largest component would drop NaN.
    x <= room && y <= room && z <= room
}

/// The time `h` after `elapsed`, if a course that lasts for `span` goes on until then. Steps that add up to the span may do so but for
/// rounding: their last one ends with it.
#[inline]
#[must_use]
pub fn time_after<S: Scalar>(elapsed: S, h: S, span: S) -> Option<S> {
    let time = elapsed + h;
    (time <= span * S::from_f64(1.0 + 1e-9)).then(|| time.smaller(span))
}
