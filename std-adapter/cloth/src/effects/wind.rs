//! Wind: each triangle is pushed along its normal by the air that it stops.
//!
//! The force on a triangle of area A is ½ρ·c·A·|u·n|(u·n)·n, u the air's velocity relative to it (Keller et al. 2003 use the
//! same normal term). The triangle's own normal velocity then follows v′ = −k|v|v, k = ½ρc/σ with σ its mass per area, whose exact
//! solution over a step is v/(1 + k·h·|v|): so a step never overshoots the wind. Vertices take the changes of their triangles in
//! the shares that these have in their mass, whose sum is one.
//!
//! Gusts: the wind's speed varies as 1 + g·sin(2πft − q·x) with x along the wind, q one wave in [`GUST_LENGTH`] metres.

use super::registration::{Effect, Registration};
use crate::input::{AIR_DENSITY, FREQUENCY, RATIO, SPEED};
use crate::membrane::Incidence;
use crate::plan::Plan;
use crate::step::{Force, TimeStep};
use libm::sin;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

/// From gust to gust, in metres.
const GUST_LENGTH: f64 = 1.0;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["velocity", "air_density", "drag", "gust", "gust_frequency"],
    needs: &[],
    read: |table, _| {
        let number = |key, quantity, range, default| table.number(key, quantity, range).map(|n| n.unwrap_or(default));
        Ok(Box::new(Wind {
            velocity: table.required_vector("velocity", SPEED, 1e3)?,
            air_density: number("air_density", AIR_DENSITY, 0.0..=1e3, 1.2)?,
            drag: number("drag", RATIO, 0.0..=100.0, 1.0)?,
            gust: number("gust", RATIO, 0.0..=1.0, 0.0)?,
            gust_frequency: number("gust_frequency", FREQUENCY, 0.0..=1e3, 1.0)?,
        }))
    },
};

#[derive(Debug)]
struct Wind {
    velocity: DVec3,
    air_density: f64,
    drag: f64,
    gust: f64,
    gust_frequency: f64,
}

impl Effect for Wind {
    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        let cloth = plan.world.cloth;
        let direction = self.velocity.normalize_or_zero();
        plan.add_force(Blow {
            factor: 0.5 * self.air_density * self.drag / cloth.density,
            wave: direction * (TAU / GUST_LENGTH),
            wind: *self,
            triangles: cloth.mesh.triangles.clone(),
            incidence: Incidence::new(cloth),
            changes: Vec::new(),
        });
    }
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
