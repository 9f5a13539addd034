//! Rotating bodies, and the arcs of their points.
//!
//! A point that is at p when the step begins is at time t at
//!
//! ```text
//! x(t) = c + t·τ + R(t·θ)(p − c)
//! ```
//!
//! c is the centre, τ the translation, and R(φ) the rotation by φ about the axis, all exactly as stored in the [`RigidMotion`].
//!
//! # How far from straight
//! Let r be the distance of p from the axis through c. Along any direction of length one, |x″| is at most θ²r, as the translation
//! is straight. A function with second derivative at most m is within m·h²/8 of the line between its values at two points at
//! distance h. So between two times with φ = θ·h between them, x is within **r·φ²/8** of the straight motion between its places
//! at both. It is also never farther than 2r: both are within r of the moving axis.
//!
//! # Rounding
//! An operation errs by ε = 2u in any rounding direction. Let H be the largest coordinate of q = p − c, C and T those of c and τ;
//! |q| ≤ √3·H.
//! * **Frame.** The axis of length one errs by 6ε in each component (quotient, 3 operations of a square under the root, root,
//!   quotient); q by εH. The part along the axis errs by 30εH along each coordinate: its product 17.4ε, times the axis 12.2ε. The
//!   part across errs by 32.5εH, the part sideways, axis × q, by 15.6εH.
//! * **Sine and cosine** err by κ = 512u + 4u|θ|. The angle t·θ errs by ε|θ|, its remainder after whole turns, of magnitude at
//!   most 3.2, by 17u. The nested series passes its term with the power 2k through 4k + 7 operations: 164ε of cosh(3.2), and 0.1u
//!   for the terms left out.
//! * **Place.** The three parts, 77.7εH; the sine and cosine, 3.5κH; products and sums, 14εH and u(4C + 6T + 3.5H). Times √3:
//!   less than u((3500 + 25|θ|)H + 16(C + T)). [`Arc`] allows u((4096 + 32|θ|)H + 16(C + T)) + η: flushed numbers are covered by
//!   η and by uH.
//! * **Velocity**: τ, and θ times a place's parts with sine and cosine exchanged. It errs by θ times the place's error, 3500uH
//!   without the centre and the translation, and by its operations: 4u(T + 3.5H|θ|) of product and sum along each axis, 7uT +
//!   25uH|θ| in all. [`Arc`] allows |θ| times what it allows a place, and 16uT + η.
//! * **Radius.** The part sideways, 15.6εH along each coordinate, 54u·H in all: 64u·H is added to its length.

use super::{Moment, Path, Piece, largest, length_above, u};
use crate::lanes::Rounding;
use crate::motion::Motion;
use glam::{DQuat, DVec3};

/// The largest angle of a step in radians, 2²⁰.
const MOST: f64 = 1_048_576.0;

/// The number 2π in two parts. The first has so few digits that its multiples are exact.
const TURN: [f64; 2] = [6.283_185_306_936_502_5, 2.430_840_202_602_477e-10];

/// The motion of a rigid body during the step. It rotates about an axis at a constant rate, while the axis translates at a
/// constant velocity.
///
/// ```
/// use selvedge_core::{glam::DVec3, paths::RigidMotion};
/// // Half a turn about the z axis, and up by one.
/// let motion = RigidMotion::new(DVec3::ZERO, DVec3::Z, core::f64::consts::PI, DVec3::Z).unwrap();
/// let arc = motion.path(DVec3::X);
/// assert!(arc.at(0.5).distance(DVec3::new(0.0, 1.0, 0.5)) < 1e-12);
/// assert!(arc.at(1.0).distance(DVec3::new(-1.0, 0.0, 1.0)) < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    centre: DVec3,
    axis: DVec3,
    angle: f64,
    translation: DVec3,
}

impl RigidMotion {
    /// Makes a motion that rotates by `angle` radians about an axis through `centre` along `axis`, and translates by
    /// `translation`, in the unit of the positions. The rotation is anticlockwise if the axis points at the viewer. `axis` may
    /// have any length.
    ///
    /// Returns `None` if a number is not finite, the axis has no length while the angle is not zero, or the angle exceeds 2²⁰.
    #[must_use]
    pub fn new(centre: DVec3, axis: DVec3, angle: f64, translation: DVec3) -> Option<Self> {
        let is_finite = centre.is_finite() && axis.is_finite() && translation.is_finite();
        let turns = angle != 0.0;
        let is_in_range = angle.abs() <= MOST && (!turns || largest(axis) > 0.0);
        (is_finite && is_in_range).then_some(Self {
            centre,
            axis,
            angle,
            translation,
        })
    }

    /// Makes a motion from one pose to another, each given by a rotation and the position of the body's origin. The body rotates
    /// the short way about an axis through its origin, which moves straight.
    ///
    /// The motion is exactly that of the rounded numbers computed from the poses, so it ends a few roundings from the second
    /// pose. Returns `None` if a number is not finite, or a quaternion is zero.
    ///
    /// ```
    /// use selvedge_core::{glam::{DQuat, DVec3}, paths::RigidMotion};
    /// let quarter = DQuat::from_rotation_z(core::f64::consts::FRAC_PI_2);
    /// let motion = RigidMotion::between((DQuat::IDENTITY, DVec3::X), (quarter, DVec3::Y)).unwrap();
    /// assert!(motion.path(DVec3::new(2.0, 0.0, 0.0)).at(1.0).distance(DVec3::new(0.0, 2.0, 0.0)) < 1e-12);
    /// ```
    #[must_use]
    pub fn between((from, origin): (DQuat, DVec3), (to, target): (DQuat, DVec3)) -> Option<Self> {
        let size = |quaternion: DQuat| quaternion.length_squared();
        let is_rotation = |quaternion: DQuat| size(quaternion).is_finite() && size(quaternion) > 0.0;
        if !(is_rotation(from) && is_rotation(to)) {
            return None;
        }
        let turn = to.normalize() * from.normalize().conjugate();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        let axis = turn.xyz();
        let angle = 2.0 * libm::atan2(axis.length(), turn.w);
        Self::new(origin, axis, angle, target - origin)
    }

    /// Returns the path of the body's point that is at `start` when the step begins.
    #[must_use]
    pub fn path(&self, start: DVec3) -> Arc {
        let &Self {
            centre,
            axis,
            angle,
            translation,
        } = self;
        let from_centre = start - centre;
        let axis = if angle == 0.0 { DVec3::ZERO } else { of_length_one(axis) };
        let along = axis * axis.dot(from_centre);
        let sideways = axis.cross(from_centre);
        let size = largest(from_centre);
        Arc {
            start,
            centre,
            translation,
            along,
            across: from_centre - along,
            sideways,
            angle,
            radius: length_above(sideways) + 64.0 * u() * size,
            rounding: u() * ((4096.0 + 32.0 * angle.abs()) * size + 16.0 * (largest(centre) + largest(translation)))
                + <f64 as Rounding>::UNDERFLOW,
        }
    }
}

/// The path of a point of a rotating body: an arc, or a helix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    start: DVec3,
    centre: DVec3,
    translation: DVec3,
    /// The parts of the offset from the centre: along the axis, across it, and the latter after a quarter turn.
    along: DVec3,
    across: DVec3,
    sideways: DVec3,
    angle: f64,
    /// The distance from the axis, rounded up.
    radius: f64,
    /// A bound of the rounding error of a position.
    rounding: f64,
}

impl Arc {
    /// Returns the position at a time in [0, 1], within its [error](Moment::position_error).
    #[must_use]
    pub fn at(&self, time: f64) -> DVec3 {
        if time == 0.0 {
            return self.start;
        }
        let [sine, cosine] = sine_and_cosine(time * self.angle);
        let turned = self.along + (self.across * cosine + self.sideways * sine);
        (self.centre + self.translation * time) + turned
    }
}

impl Path for Arc {
    fn piece(&self, from: f64, to: f64) -> Piece {
        let angle = self.angle * (to - from);
        // The comparison is false with NaN, so the bound is NaN too.
        let bent = if angle * angle > 16.0 { 2.0 } else { angle * angle * 0.125 };
        Piece {
            motion: Motion::new(self.at(from), self.at(to)),
            // There are eight roundings.
            deviation: (self.radius * bent + self.rounding) * (1.0 + 32.0 * u()),
        }
    }

    fn moment(&self, time: f64) -> Moment {
        let [sine, cosine] = sine_and_cosine(time * self.angle);
        let turning = self.sideways * cosine - self.across * sine;
        let of_translation = 16.0 * u() * largest(self.translation) + <f64 as Rounding>::UNDERFLOW;
        Moment {
            position: self.at(time),
            position_error: self.rounding,
            velocity: self.translation + turning * self.angle,
            velocity_error: (self.angle.abs() * self.rounding + of_translation) * (1.0 + 16.0 * u()),
        }
    }
}

fn of_length_one(axis: DVec3) -> DVec3 {
    let axis = axis / largest(axis);
    axis / axis.length()
}

/// Returns the sine and cosine of an angle of at most 2²⁰.
fn sine_and_cosine(angle: f64) -> [f64; 2] {
    let [turn, rest] = TURN;
    let turns = libm::floor(angle * (1.0 / turn) + 0.5);
    let angle = (angle - turns * turn) - turns * rest;
    let square = angle * angle;
    let (mut sine, mut cosine) = (1.0, 1.0);
    for k in (1..=14).rev() {
        let twice = f64::from(2 * k);
        sine = 1.0 - square / (twice * (twice + 1.0)) * sine;
        cosine = 1.0 - square / ((twice - 1.0) * twice) * cosine;
    }
    [angle * sine, cosine]
}
