//! Wind: each triangle is pushed along its normal by the air that it stops.
//!
//! The force on a triangle of area A is ½ρ·c·A·|u·n|(u·n)·n, u the air's velocity relative to it (Keller et al. 2003 use the
//! same normal term). The triangle's own normal velocity then follows v′ = −k|v|v, k = ½ρc/σ with σ its mass per area, whose exact
//! solution over a step is v/(1 + k·h·|v|): so a step never overshoots the wind. Vertices take the changes of their triangles in
//! the shares that these have in their mass, whose sum is one.
//!
//! Gusts: the wind's speed varies as 1 + g·sin(2πft − q·x) with x along the wind, q one wave in [`GUST_LENGTH`] metres.

use super::registration::{Effect, Registration};
use crate::input::{AIR_DENSITY, FREQUENCY, Field, RATIO, SPEED, ValueError};
use crate::membrane::Incidence;
use crate::plan::Plan;
use crate::step::{Force, TimeStep};
use crate::world::SceneParts;
use libm::sin;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// From gust to gust, in metres.
const GUST_LENGTH: f64 = 1.0;

const VELOCITY: Field = Field::vector("velocity", SPEED, 1e3);
const DENSITY: Field = Field::new("air_density", AIR_DENSITY, 0.0, 1e3);
const DRAG: Field = Field::new("drag", RATIO, 0.0, 100.0);
const GUST: Field = Field::new("gust", RATIO, 0.0, 1.0);
const GUST_FREQUENCY: Field = Field::new("gust_frequency", FREQUENCY, 0.0, 1e3);

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["velocity", "air_density", "drag", "gust", "gust_frequency"],
    needs: &[],
    read: |table, _| {
        let number = |field, default| table.number(field).map(|n| n.unwrap_or(default));
        let default = Wind::default();
        Ok(Box::new(Wind {
            velocity: table.required_vector(&VELOCITY)?,
            air_density: number(&DENSITY, default.air_density)?,
            drag: number(&DRAG, default.drag)?,
            gust: number(&GUST, default.gust)?,
            gust_frequency: number(&GUST_FREQUENCY, default.gust_frequency)?,
        }))
    },
};

/// Wind, the same everywhere but for gusts. [`Simulation::set_wind`](crate::Simulation::set_wind) changes it from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// In m/s.
    pub velocity: DVec3,
    /// In kg/m³.
    pub air_density: f64,
    /// The drag coefficient of a triangle that the wind meets head-on.
    pub drag: f64,
    /// By which share gusts change the speed; 0: none.
    pub gust: f64,
    /// Gusts a second.
    pub gust_frequency: f64,
}

impl Default for Wind {
    /// No wind yet, at sea level; no gusts.
    fn default() -> Self {
        Self {
            velocity: DVec3::ZERO,
            air_density: 1.2,
            drag: 1.0,
            gust: 0.0,
            gust_frequency: 1.0,
        }
    }
}

impl Wind {
    /// Whether a wind can blow so.
    pub(crate) fn check_velocity(velocity: DVec3) -> Result<(), ValueError> {
        VELOCITY.check_vector(velocity)
    }
}

impl Effect for Wind {
    fn name(&self) -> &'static str {
        "wind"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        Self::check_velocity(self.velocity)?;
        DENSITY.check(self.air_density)?;
        DRAG.check(self.drag)?;
        GUST.check(self.gust)?;
        GUST_FREQUENCY.check(self.gust_frequency)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        plan.add_force(Blow {
            factor: 0.5 * self.air_density * self.drag / cloth.density,
            wave: wave(self.velocity),
            wind: *self,
            triangles: cloth.mesh.triangles.clone(),
            incidence: Incidence::new(cloth),
            changes: Vec::new(),
        });
    }
}

/// Phase per metre.
fn wave(velocity: DVec3) -> DVec3 {
    velocity.normalize_or_zero() * (TAU / GUST_LENGTH)
}

#[derive(Debug)]
struct Blow {
    wind: Wind,
    /// k of the module.
    factor: f64,
    /// Phase per metre.
    wave: DVec3,
    triangles: Vec<[u32; 3]>,
    incidence: Incidence,
    /// Of each triangle's velocity.
    changes: Vec<DVec3>,
}

impl Force for Blow {
    fn set_wind(&mut self, velocity: DVec3) -> bool {
        self.wind.velocity = velocity;
        self.wave = wave(velocity);
        true
    }

    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let Self {
            wind,
            factor,
            wave,
            triangles,
            incidence,
            changes,
        } = self;
        let phase = TAU * wind.gust_frequency * step.time;
        let read: &[DVec3] = velocities;
        parallel::fill(changes, triangles, |triangle| {
            let [a, b, c] = triangle.map(|v| step.start[v as usize]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let [u, v, w] = triangle.map(|v| read[v as usize]);
            let strength = 1.0 + wind.gust * sin(phase - wave.dot(a));
            let across = (wind.velocity * strength - (u + v + w) / 3.0).dot(normal);
            let slowing = *factor * step.h * across.abs();
            normal * (across * (slowing / (1.0 + slowing)))
        });
        for (vertex, velocity) in velocities.iter_mut().enumerate().take(incidence.len()) {
            if step.inverse_masses[vertex] > 0.0 {
                for &(triangle, share) in incidence.of(vertex) {
                    *velocity += changes[triangle as usize] * share;
                }
            }
        }
    }
}
