//! Sources of a wind field: fans and vortices, whose velocities add up.
//!
//! **A fan** is a round jet. It is straight, and its half-width grows with the distance s as R + 0.094·s (Hussein, Capp and
//! George 1994, J. Fluid Mech. 258:31). The momentum through each section is the same, ∝ U²R², so that the velocity in the middle
//! falls as R/(R + 0.094·s). Across the jet it is 2^(−r²/half-width²). The air behind the fan is still, and so is the air that
//! the jet entrains.
//!
//! **A vortex** turns about its axis with the velocity 2·v·(r/R)/(1 + (r/R)²). Its largest value is v, at the core's radius R
//! (Kaufmann 1962).
//!
//! Both are quoted from works that use them. The slope of 0.094 is on page 44 of the first; other measurements give 0.086 to
//! 0.096. The profile of the second is quoted as ∝ r/(R² + r²), which is the one above.

use crate::Identify;
use crate::input::{Field, LARGEST_COORDINATE, LENGTH, RATIO, SPEED, SceneError, Table, ValueError};
use libm::exp2;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

const AT: Field = Field::vector("at", LENGTH, LARGEST_COORDINATE);
const VELOCITY: Field = Field::vector("velocity", SPEED, 1e3);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-3, LARGEST_COORDINATE);
const AXIS: Field = Field::vector("axis", RATIO, LARGEST_COORDINATE);
const TURNING: Field = Field::new("speed", SPEED, -1e3, 1e3);

/// Moving air. Its velocity, in m/s, depends on a place in metres and a time in seconds.
///
/// The velocity must depend on the arguments alone, since failed steps are repeated and triangles call it in any order.
pub trait Air: Debug + Identify + Send + Sync {
    /// Returns the velocity in m/s. A velocity that is not finite counts as zero.
    fn velocity(&self, at: DVec3, time: f64) -> DVec3;

    /// Checks the numbers.
    ///
    /// # Errors
    /// Returns an error if a number is invalid. The message says which values are valid.
    fn check(&self) -> Result<(), ValueError> {
        Ok(())
    }
}

/// A source of moving air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AirSource {
    /// A round jet.
    Fan(Fan),
    /// A vortex.
    Vortex(Vortex),
}

/// A round jet of air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fan {
    /// Its origin, in metres.
    pub at: DVec3,
    /// The velocity in the middle at the origin, in m/s, in the direction of the jet.
    pub velocity: DVec3,
    /// The radius at which the velocity is half of that in the middle, in metres.
    pub radius: f64,
}

/// Air that turns about an axis, counter-clockwise as seen against the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vortex {
    /// A point of the axis, in metres.
    pub at: DVec3,
    /// The direction of the axis, of any length but zero.
    pub axis: DVec3,
    /// The largest velocity, in m/s. Negative values turn clockwise.
    pub speed: f64,
    /// The radius of the largest velocity, in metres.
    pub radius: f64,
}

/// The growth of a round jet's half-width with the distance.
const SPREADING: f64 = 0.094;

impl Fan {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        table.expect_keys(&["at", "velocity", "radius"])?;
        Ok(Self {
            at: table.required_vector(&AT)?,
            velocity: table.required_vector(&VELOCITY)?,
            radius: table.required_number(&RADIUS)?,
        })
    }

    fn velocity(&self, at: DVec3) -> DVec3 {
        let offset = at - self.at;
        let direction = self.velocity.normalize_or_zero();
        let along = offset.dot(direction);
        if !(along >= 0.0) {
            return DVec3::ZERO;
        }
        let width = self.radius + SPREADING * along;
        let across = (offset - direction * along).length_squared();
        self.velocity * (self.radius / width * exp2(-across / (width * width)))
    }
}

impl Vortex {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        table.expect_keys(&["at", "axis", "speed", "radius"])?;
        let vortex = Self {
            at: table.required_vector(&AT)?,
            axis: table.required_vector(&AXIS)?,
            speed: table.required_number(&TURNING)?,
            radius: table.required_number(&RADIUS)?,
        };
        vortex.check().map_err(|error| table.placed(&error))?;
        Ok(vortex)
    }

    fn check(&self) -> Result<(), ValueError> {
        AT.check_vector(self.at)?;
        AXIS.check_vector(self.axis)?;
        TURNING.check(self.speed)?;
        RADIUS.check(self.radius)?;
        if self.axis == DVec3::ZERO {
            let message = "`axis` must not be zero: it is the axis of the vortex";
            return Err(ValueError::new(AXIS.name, message));
        }
        Ok(())
    }

    fn velocity(&self, at: DVec3) -> DVec3 {
        // The length of this vector is the distance from the axis.
        let turning = self.axis.normalize_or_zero().cross(at - self.at);
        let squared = turning.length_squared() / (self.radius * self.radius);
        turning * (2.0 * self.speed / self.radius / (1.0 + squared))
    }
}

crate::identify!(enum AirSource { 0 => Fan(fan), 1 => Vortex(vortex) });
crate::identify!(Fan { at, velocity, radius });
crate::identify!(Vortex { at, axis, speed, radius });

impl Air for Vec<AirSource> {
    fn velocity(&self, at: DVec3, _: f64) -> DVec3 {
        let each = self.iter().map(|source| match source {
            AirSource::Fan(fan) => fan.velocity(at),
            AirSource::Vortex(vortex) => vortex.velocity(at),
        });
        each.sum()
    }

    fn check(&self) -> Result<(), ValueError> {
        self.iter().try_for_each(|source| match source {
            AirSource::Fan(fan) => {
                AT.check_vector(fan.at)?;
                VELOCITY.check_vector(fan.velocity)?;
                RADIUS.check(fan.radius)
            }
            AirSource::Vortex(vortex) => vortex.check(),
        })
    }
}
