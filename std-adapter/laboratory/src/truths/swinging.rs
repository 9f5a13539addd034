//! Oscillations: an elastic rod, its energy, and a hanging chain.

use super::conditions::{Conditions, regular};
use super::run::Run;
use super::setting::{G, pinned, scene, weightless};
use super::stepping::Motion;
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::Cloth;
use selvedge_cloth::effects::RopeStretch;
use selvedge_cloth::glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

const LENGTH: f64 = 0.5;
/// The mass of a rope, in kg/m.
const ROPE: f64 = 0.2;
const PERIOD: f64 = 0.4;
const SPEED: f64 = 0.05;

/// A rod that is held at one end, and moves in its slowest mode.
struct Rod {
    run: Run,
    /// The frequency of the mode, in rad/s: of a smooth rod, and of the segments.
    exact: f64,
    frequency: f64,
}

impl Rod {
    fn new(conditions: &Conditions) -> Result<Self, Failure> {
        let segments = conditions.grid.number;
        // A smooth rod has the frequency ½π/l·√(EA/μ).
        let exact = TAU / PERIOD;
        let stiffness = ROPE * (exact * LENGTH / FRAC_PI_2).powi(2);
        let mut scene = weightless(Cloth::rope(&[DVec3::ZERO, LENGTH * DVec3::X], segments, ROPE)?);
        scene.add(RopeStretch::new(stiffness)).add(pinned([0]));
        let mut run = Run::new(scene, conditions)?;
        let phase = FRAC_PI_2 / f64::from(segments);
        for vertex in 1..=segments {
            let speed = SPEED * (phase * f64::from(vertex)).sin();
            run.set_velocity(&[vertex], speed * DVec3::X)?;
        }
        Ok(Self {
            run,
            exact,
            // Masses μ·l/n between springs of EA·n/l, half a mass at the end.
            frequency: 2.0 * (stiffness / ROPE).sqrt() * f64::from(segments) / LENGTH * (0.5 * phase).sin(),
        })
    }
}

pub(super) const SPRING: Law = Law {
    name: "spring",
    statement: "An elastic rod, held at one end, swings along itself with ω = ½π/l·√(EA/μ)",
    axes: ["time, s", "displacement of the end, m"],
    error: ErrorUnit::Of("the amplitude"),
    mesh: "segments",
    meshes: &[regular(16), regular(32), regular(64)],
    remark: "Steps of first order divide the amplitude by √(1 + ω²h²), and turn the phase by atan(ω·h) instead of ω·h.",
    simulate: |conditions| {
        let Rod {
            mut run,
            exact,
            frequency,
        } = Rod::new(conditions)?;
        let end = conditions.grid.number as usize;
        let samples = run.over_time(2.0 * PERIOD, |run, time| {
            let motion = Motion {
                velocity: SPEED,
                frequency,
                ..Motion::default()
            };
            Sample {
                exact: SPEED / exact * (exact * time).sin(),
                predicted: Some(motion.after(run.steps(), conditions.accuracy)[0]),
                simulated: run.positions()[end].x - LENGTH,
                ..Sample::default()
            }
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
    meshes: &[regular(16), regular(32), regular(64)],
    remark: "Steps of first order divide the energy of a mode by 1 + ω²h². Steps of second order take ω²h² once, in the first step, and then nearly nothing.",
    simulate: |conditions| {
        let Rod { mut run, frequency, .. } = Rod::new(conditions)?;
        let start = run.energy().total();
        let motion = Motion {
            velocity: 1.0,
            frequency,
            ..Motion::default()
        };
        let samples = run.over_time(2.0 * PERIOD, |run, _| {
            let [position, velocity] = motion.after(run.steps(), conditions.accuracy);
            Sample {
                exact: 1.0,
                predicted: Some(velocity.powi(2) + (frequency * position).powi(2)),
                simulated: run.energy().total() / start,
                ..Sample::default()
            }
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
    meshes: &[regular(8), regular(16), regular(32)],
    remark: "Segments are straight and have their mass at their ends; the time step hardly matters.",
    simulate: |conditions| {
        /// The first zero of J₀.
        const ZERO: f64 = 2.404_825_557_695_773;
        let segments = conditions.grid.number;
        let half = 0.5 * 4.0 * std::f64::consts::PI / ZERO * (LENGTH / G).sqrt();
        let mut scene = scene(Cloth::rope(&[DVec3::ZERO, -LENGTH * DVec3::Z], segments, ROPE)?);
        scene.add(RopeStretch::new(1e5)).add(pinned([0]));
        let mut run = Run::new(scene, conditions)?;
        for vertex in 1..=segments {
            let from_end = 1.0 - f64::from(vertex) / f64::from(segments);
            run.set_velocity(&[vertex], SPEED * libm::j0(ZERO * from_end.sqrt()) * DVec3::X)?;
        }
        let mut crossings = Vec::new();
        while crossings.len() < 9 {
            let before = run.positions()[segments as usize].x;
            run.tick()?;
            let after = run.positions()[segments as usize].x;
            if before * after < 0.0 {
                crossings.push(run.time() - conditions.pace.seconds() * after / (after - before));
            }
            if run.time() > 100.0 * half {
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
