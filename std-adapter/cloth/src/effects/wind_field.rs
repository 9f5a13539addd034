//! Wind from a field: air whose velocity depends on place and time. It pushes as [`Panels`] say, by the air in the middle of each triangle.
//!
//! A scene file makes a field of fans and vortices, whose velocities add up; code may give any function ([`Air`]).
//!
//! **A fan** is a round jet. Its middle goes straight on, and its half-width grows with the distance s as R + 0.094·s (Hussein, Capp and
//! George 1994). The momentum that goes through each section is the same, ∝ U²R², so that the velocity in the middle falls as R/(R + 0.094·s);
//! across it is 2^(−r²/half-width²). Behind the fan the air is still, as is what the jet draws in from its sides.
//!
//! **A vortex** turns about its axis with the velocity 2·v·(r/R)/(1 + (r/R)²), which is v at its core's radius R and most there
//! (Kaufmann 1962).

use super::panels::{Panels, check_drag, read_drag};
use super::registration::{Effect, Registration};
use crate::input::{Field, LARGEST_COORDINATE, LENGTH, RATIO, SPEED, SceneError, Table, ValueError};
use crate::plan::Plan;
use crate::step::{Force, TimeStep};
use crate::world::SceneParts;
use libm::exp2;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;
use std::sync::Arc;

const AT: Field = Field::vector("at", LENGTH, LARGEST_COORDINATE);
const VELOCITY: Field = Field::vector("velocity", SPEED, 1e3);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-3, LARGEST_COORDINATE);
const AXIS: Field = Field::vector("axis", RATIO, LARGEST_COORDINATE);
const TURNING: Field = Field::new("speed", SPEED, -1e3, 1e3);

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["fan", "vortex", "air_density", "drag"],
    needs: &[],
    read: |table, _| {
        let mut sources = Vec::new();
        for fan in table.tables("fan")? {
            sources.push(AirSource::Fan(Fan::read(&fan)?));
        }
        for vortex in table.tables("vortex")? {
            sources.push(AirSource::Vortex(Vortex::read(&vortex)?));
        }
        if sources.is_empty() {
            let message = "a field of wind needs at least one [[effects.wind_field.fan]] or [[effects.wind_field.vortex]]";
            return Err(table.error("fan", message.to_owned()));
        }
        let mut field = WindField::of(sources);
        [field.air_density, field.drag] = read_drag(table, [field.air_density, field.drag])?;
        Ok(Box::new(field))
    },
};

/// Air that moves: its velocity at a place, in metres, and a time, in seconds, in m/s.
///
/// It must depend on its arguments alone: a step that cannot be made is tried again, and triangles ask in any order. `Debug` is to show all that
/// it depends on: checkpoints tell scenes apart by it.
pub trait Air: Debug + Send + Sync {
    /// In m/s. What is not finite counts as still.
    fn velocity(&self, at: DVec3, time: f64) -> DVec3;

    /// Whether its numbers make sense.
    ///
    /// # Errors
    /// Which of them does not, and what would.
    fn check(&self) -> Result<(), ValueError> {
        Ok(())
    }
}

/// Wind that is not the same everywhere.
///
/// ```
/// use selvedge_cloth::effects::{Air, WindField};
/// use selvedge_cloth::glam::DVec3;
///
/// /// Faster with height, and with the time.
/// #[derive(Debug)]
/// struct Rising;
///
/// impl Air for Rising {
///     fn velocity(&self, at: DVec3, time: f64) -> DVec3 {
///         DVec3::X * (2.0 * at.z * time.min(1.0))
///     }
/// }
///
/// let field = WindField::new(Rising);
/// assert_eq!(field.air.velocity(DVec3::Z, 0.5), DVec3::X);
/// ```
#[derive(Clone, Debug)]
pub struct WindField {
    /// How the air moves.
    pub air: Arc<dyn Air>,
    /// In kg/m³.
    pub air_density: f64,
    /// The drag coefficient of a triangle that the wind meets head-on.
    pub drag: f64,
}

impl WindField {
    /// At sea level.
    #[must_use]
    pub fn new(air: impl Air + 'static) -> Self {
        Self {
            air: Arc::new(air),
            air_density: 1.2,
            drag: 1.0,
        }
    }

    /// Of fans and vortices, as scene files have them.
    #[must_use]
    pub fn of(sources: Vec<AirSource>) -> Self {
        Self::new(sources)
    }
}

/// What moves air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AirSource {
    /// A round jet.
    Fan(Fan),
    /// Air that turns.
    Vortex(Vortex),
}

/// A round jet of air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fan {
    /// In metres.
    pub at: DVec3,
    /// In its middle, where it stands, in m/s. Its direction is that of the jet.
    pub velocity: DVec3,
    /// Where the velocity is half of that in the middle, in metres.
    pub radius: f64,
}

/// Air that turns about an axis, counter-clockwise as seen from where the axis points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vortex {
    /// A point of the axis, in metres.
    pub at: DVec3,
    /// Of any length but zero.
    pub axis: DVec3,
    /// The largest, in m/s; negative: clockwise.
    pub speed: f64,
    /// Where it is largest, in metres.
    pub radius: f64,
}

/// Of a round jet's half-width, with the distance.
const SPREADING: f64 = 0.094;

impl Fan {
    fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        table.expect_keys(&["at", "velocity", "radius"])?;
        Ok(Self {
            at: table.required_vector(&AT)?,
            velocity: table.required_vector(&VELOCITY)?,
            radius: table.required_number(&RADIUS)?,
        })
    }

    fn velocity(&self, at: DVec3) -> DVec3 {
        let way = at - self.at;
        let direction = self.velocity.normalize_or_zero();
        let along = way.dot(direction);
        if !(along >= 0.0) {
            return DVec3::ZERO;
        }
        let width = self.radius + SPREADING * along;
        let across = (way - direction * along).length_squared();
        self.velocity * (self.radius / width * exp2(-across / (width * width)))
    }
}

impl Vortex {
    fn read(table: &Table<'_>) -> Result<Self, SceneError> {
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
            let message = "`axis` must not be zero: it is the direction that the air turns about";
            return Err(ValueError::new(AXIS.name, message));
        }
        Ok(())
    }

    fn velocity(&self, at: DVec3) -> DVec3 {
        // Its length is the distance from the axis.
        let turning = self.axis.normalize_or_zero().cross(at - self.at);
        let squared = turning.length_squared() / (self.radius * self.radius);
        turning * (2.0 * self.speed / self.radius / (1.0 + squared))
    }
}

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

impl Effect for WindField {
    fn name(&self) -> &'static str {
        "wind_field"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        self.air.check()?;
        check_drag([self.air_density, self.drag])
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let panels = Panels::new(plan.scene.cloth, [self.air_density, self.drag]);
        plan.add_force(Blowing {
            air: Arc::clone(&self.air),
            panels,
        });
    }
}

#[derive(Debug)]
struct Blowing {
    air: Arc<dyn Air>,
    panels: Panels,
}

impl Force for Blowing {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let air = &self.air;
        self.panels.push(step, velocities, |[a, b, c]| {
            let velocity = air.velocity((a + b + c) / 3.0, step.time);
            if velocity.is_finite() { velocity } else { DVec3::ZERO }
        });
    }
}
