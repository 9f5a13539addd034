//! Uniform wind with gusts. It [pushes](crate::solve::air) triangles, and loose edges that have a diameter.
//!
//! Gusts vary the wind's speed as 1 + g·sin(2πft − q·x), with x along the wind and one wave per [`GUST_LENGTH`] metres.

use super::drag::Drag;
use crate::effects::plan::Plan;
use crate::effects::registration::{ActsOn, Effect, Registration};
use crate::input::{FREQUENCY, Field, RATIO, SPEED, ValueError};
use crate::solve::air::Blowing;
use crate::world::SceneParts;
use libm::sin;
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// The distance between gusts, in metres.
const GUST_LENGTH: f64 = 1.0;

const VELOCITY: Field = Field::vector("velocity", SPEED, 1e3);
const GUST: Field = Field::new("gust", RATIO, 0.0, 1.0);
const GUST_FREQUENCY: Field = Field::new("gust_frequency", FREQUENCY, 0.0, 1e3);

pub(in crate::effects) const REGISTRATION: Registration = Registration::new(
    &["velocity", "air_density", "drag", "rope_diameter", "gust", "gust_frequency"],
    |table, _| {
        let number = |field, default| table.number(field).map(|n| n.unwrap_or(default));
        let default = Wind::default();
        let velocity = table.required_vector(&VELOCITY)?;
        let air = Drag::read(table)?;
        Ok(Box::new(Wind {
            velocity,
            air_density: air.density,
            drag: air.coefficient,
            rope_diameter: air.rope_diameter,
            gust: number(&GUST, default.gust)?,
            gust_frequency: number(&GUST_FREQUENCY, default.gust_frequency)?,
        }))
    },
);

/// Uniform wind with gusts. [`Simulation::set_wind`](crate::Simulation::set_wind) changes it from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// The velocity, in m/s.
    pub velocity: DVec3,
    /// The density of the air, in kg/m³.
    pub air_density: f64,
    /// The drag coefficient of a triangle or a loose edge in head-on flow. Round cords have about 1.1.
    pub drag: f64,
    /// The diameter of loose edges, in metres. At 0 the wind does not push them.
    pub rope_diameter: f64,
    /// The amplitude of gusts as a share of the speed. At 0 there are no gusts.
    pub gust: f64,
    /// The number of gusts per second.
    pub gust_frequency: f64,
}

impl Default for Wind {
    /// Returns still air at sea level, without gusts, that does not push ropes.
    fn default() -> Self {
        Self {
            velocity: DVec3::ZERO,
            air_density: Drag::DEFAULT.density,
            drag: Drag::DEFAULT.coefficient,
            rope_diameter: Drag::DEFAULT.rope_diameter,
            gust: 0.0,
            gust_frequency: 1.0,
        }
    }
}

impl Wind {
    pub(crate) fn check_velocity(velocity: DVec3) -> Result<(), ValueError> {
        VELOCITY.check_vector(velocity)
    }

    const fn air(&self) -> Drag {
        Drag {
            density: self.air_density,
            coefficient: self.drag,
            rope_diameter: self.rope_diameter,
        }
    }
}

crate::identify!(Wind {
    velocity,
    air_density,
    drag,
    rope_diameter,
    gust,
    gust_frequency
});

impl Effect for Wind {
    fn name(&self) -> &'static str {
        "wind"
    }

    fn acts_on(&self) -> ActsOn {
        self.air().acts_on()
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        Self::check_velocity(self.velocity)?;
        self.air().check(world)?;
        GUST.check(self.gust)?;
        GUST_FREQUENCY.check(self.gust_frequency)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let gusts = Gusts {
            wind: *self,
            wave: wave(self.velocity),
        };
        plan.add_air(gusts, self.air());
    }
}

fn wave(velocity: DVec3) -> DVec3 {
    velocity.normalize_or_zero() * (TAU / GUST_LENGTH)
}

#[derive(Debug)]
struct Gusts {
    wind: Wind,
    /// The phase per metre.
    wave: DVec3,
}

impl Blowing for Gusts {
    fn velocity(&self, corners: &[DVec3], time: f64) -> DVec3 {
        let phase = TAU * self.wind.gust_frequency * time;
        self.wind.velocity * (1.0 + self.wind.gust * sin(phase - self.wave.dot(corners[0])))
    }

    fn set(&mut self, velocity: DVec3) -> bool {
        self.wind.velocity = velocity;
        self.wave = wave(velocity);
        true
    }
}
