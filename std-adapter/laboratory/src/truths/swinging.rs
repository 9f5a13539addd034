//! Oscillations: an elastic rod, its energy, and a hanging chain.

use super::setting::{G, over_time, pinned, scene};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::RopeStretch;
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};
use std::f64::consts::{FRAC_PI_2, TAU};

const LENGTH: f64 = 0.5;
/// The mass of a rope, in kg/m.
const ROPE: f64 = 0.2;
const PERIOD: f64 = 0.4;
const SPEED: f64 = 0.05;

/// A rod that is held at one end, and moves in its slowest mode.
struct Rod {
    simulation: Simulation,
    /// The frequency of the mode, in rad/s: of a smooth rod, and of the segments.
    exact: f64,
    frequency: f64,
    step: f64,
}

impl Rod {
    fn new(segments: u32, step: f64) -> Result<Self, Failure> {
        // A smooth rod has the frequency ½π/l·√(EA/μ).
        let exact = TAU / PERIOD;
        let stiffness = ROPE * (exact * LENGTH / FRAC_PI_2).powi(2);
        let mut scene = Scene::new(Cloth::rope(&[DVec3::ZERO, LENGTH * DVec3::X], segments, ROPE)?, step);
        scene.add(RopeStretch::new(stiffness)).add(pinned([0]));
        let mut simulation = Simulation::new(scene, 1)?;
        let phase = FRAC_PI_2 / f64::from(segments);
        for vertex in 1..=segments {
            let speed = SPEED * (phase * f64::from(vertex)).sin();
            simulation.set_velocity(&[vertex], speed * DVec3::X)?;
        }
        Ok(Self {
            simulation,
            exact,
            // Masses μ·l/n between springs of EA·n/l, half a mass at the end.
            frequency: 2.0 * (stiffness / ROPE).sqrt() * f64::from(segments) / LENGTH * (0.5 * phase).sin(),
            step,
        })
    }

    /// Returns by what an implicit Euler step multiplies the amplitude of the segments' mode, and by how much it turns its phase.
    fn implicit(&self) -> [f64; 2] {
        let turn = self.frequency * self.step;
        [1.0 / turn.hypot(1.0), turn.atan()]
    }
}

pub(super) const SPRING: Law = Law {
    name: "spring",
    statement: "An elastic rod, held at one end, swings along itself with ω = ½π/l·√(EA/μ)",
    axes: ["time, s", "displacement of the end, m"],
    error: ErrorUnit::Of("the amplitude"),
    mesh: "segments",
    meshes: &[4, 16, 64],
    remark: "An implicit Euler step turns the phase by atan(ω·h) instead of ω·h, and divides the amplitude by √(1 + ω²h²).",
    simulate: |segments, step| {
        let mut rod = Rod::new(segments, step)?;
        let [factor, turn] = rod.implicit();
        let (exact, frequency) = (rod.exact, rod.frequency);
        let samples = over_time(&mut rod.simulation, [2.0 * PERIOD, step], |simulation, time, steps| Sample {
            exact: SPEED / exact * (exact * time).sin(),
            predicted: Some(SPEED / frequency * factor.powf(steps) * (turn * steps).sin()),
            simulated: simulation.positions()[segments as usize].x - LENGTH,
            ..Sample::default()
        })?;
        Ok(Outcome {
            samples,
            scale: SPEED / exact,
        })
    },
};

pub(super) const ENERGY: Law = Law {
    name: "energy",
    statement: "The same rod without damping keeps its energy",
    axes: ["time, s", "energy over that at the start"],
    error: ErrorUnit::Of("the energy"),
    mesh: "segments",
    meshes: &[4, 16, 64],
    remark: "An implicit Euler step divides the energy of a mode by 1 + ω²h². This is the integrator's dissipation, and all of it.",
    simulate: |segments, step| {
        let mut rod = Rod::new(segments, step)?;
        let [factor, _] = rod.implicit();
        let start = rod.simulation.energy().total();
        let samples = over_time(&mut rod.simulation, [2.0 * PERIOD, step], |simulation, _, steps| Sample {
            exact: 1.0,
            predicted: Some(factor.powf(2.0 * steps)),
            simulated: simulation.energy().total() / start,
            ..Sample::default()
        })?;
        Ok(Outcome { samples, scale: 1.0 })
    },
};

pub(super) const PENDULUM: Law = Law {
    name: "pendulum",
    statement: "A hanging chain swings in its slowest mode with T = 4π/j·√(l/g), j = 2.4048 (Bernoulli 1732)",
    axes: ["crossing", "time since the first crossing, s"],
    error: ErrorUnit::Of("the time"),
    mesh: "segments",
    meshes: &[8, 16, 32],
    remark: "Segments are straight and have their mass at their ends; the time step hardly matters.",
    simulate: |segments, step| {
        /// The first zero of J₀.
        const ZERO: f64 = 2.404_825_557_695_773;
        let half = 0.5 * 4.0 * std::f64::consts::PI / ZERO * (LENGTH / G).sqrt();
        let mut scene = scene(Cloth::rope(&[DVec3::ZERO, -LENGTH * DVec3::Z], segments, ROPE)?, step);
        scene.add(RopeStretch::new(1e5)).add(pinned([0]));
        let mut simulation = Simulation::new(scene, 1)?;
        for vertex in 1..=segments {
            let from_end = 1.0 - f64::from(vertex) / f64::from(segments);
            simulation.set_velocity(&[vertex], SPEED * libm::j0(ZERO * from_end.sqrt()) * DVec3::X)?;
        }
        let mut crossings = Vec::new();
        while crossings.len() < 9 {
            let before = simulation.positions()[segments as usize].x;
            simulation.step()?;
            let after = simulation.positions()[segments as usize].x;
            if before * after < 0.0 {
                crossings.push(simulation.time() - step * after / (after - before));
            }
            if simulation.time() > 100.0 * half {
                return Err("the chain does not swing".into());
            }
        }
        let samples = (1..9).map(|k| Sample {
            at: k as f64,
            exact: half * k as f64,
            simulated: crossings[k] - crossings[0],
            ..Sample::default()
        });
        Ok(Outcome {
            samples: samples.collect(),
            scale: 8.0 * half,
        })
    },
};
