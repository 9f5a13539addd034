//! Steady wind on cloth that is held, and still air around cloth that falls. The air pushes along the normal n with ½ρc·(u·n)², u
//! the relative velocity, ρ = 1.2 kg/m³, c = 1.
//!
//! **A sail** that is held at two sides, 1 m apart, across a wind of the speed u: no force acts along the cloth, so that its
//! tension T is the same everywhere. At the angle θ to the chord the pressure is q·cos²θ with q = ½ρc·u². So T·dθ/ds = q·cos²θ,
//! which is the catenary of the parameter a = T/q. Its length is 2a·sinh(1/2a) = 1 + T/k. Chords have an error of 0.12 % of the
//! sag with 16 cells. It falls with their square.
//!
//! **A free sheet** of the mass σ (kg/m²) falls flat at √(2σg/ρc) in the end.

use super::conditions::{irregular, regular};
use super::forms::Catenary;
use super::run::Run;
use super::setting::{G, elastic, held_strip, middle_of_strip, scene, sheet, speed};
use super::{ErrorUnit, Law, Outcome, Sample};
use selvedge_cloth::effects::Wind;
use selvedge_cloth::glam::DVec3;

const AIR: f64 = 1.2;

pub(super) const SAIL: Law = Law {
    name: "sail",
    statement: "A sail that is held at two sides bulges in a steady wind as z = a·cosh(x/a), a = T/(½ρ·u²), whatever it weighs",
    axes: ["speed of the wind, m/s", "bulge of the middle, m"],
    error: ErrorUnit::Of("the largest bulge"),
    mesh: "cells between the sides",
    meshes: &[regular(16), irregular(16), regular(32)],
    remark: "Sails have 15, 60 and 300 g/m², and k = 2 kN/m. The error of the chords falls with the square of their length.",
    simulate: |conditions| {
        let (mut samples, mut scale, stiffness) = (Vec::new(), 0.0, 2e3);
        for velocity in [5.0, 10.0, 20.0] {
            let pressure = 0.5 * AIR * velocity * velocity;
            let curve = Catenary::of_length(1.0, |a| 1.0 + pressure * a / stiffness);
            scale = curve.sag();
            for density in [0.015, 0.06, 0.3] {
                let mut scene = held_strip(density, stiffness, conditions.grid)?;
                scene.add(Wind {
                    velocity: velocity * DVec3::Z,
                    air_density: AIR,
                    ..Wind::default()
                });
                let mut run = Run::new(scene, conditions)?;
                run.advance_to(2.0)?;
                let middle = run.positions()[middle_of_strip(conditions.grid)];
                samples.push(Sample {
                    at: velocity,
                    exact: -curve.height(middle.x),
                    simulated: middle.z,
                    ..Sample::default()
                });
            }
        }
        Ok(Outcome { samples, scale })
    },
};

pub(super) const AIR_SPEED: Law = Law {
    name: "air_speed",
    statement: "A sheet of the mass σ falls flat in still air at √(2σg/ρ) in the end",
    axes: ["mass, kg/m²", "speed, m/s"],
    error: ErrorUnit::Of("the largest speed"),
    mesh: "cells a side",
    meshes: &[regular(4), irregular(8), regular(16)],
    remark: "All triangles have the same force on their mass, so that the sheet stays flat.",
    simulate: |conditions| {
        let (cells, terminal) = (conditions.grid.number, |density: f64| (2.0 * density * G / AIR).sqrt());
        let mut samples = Vec::new();
        for density in [0.015, 0.05, 0.3] {
            let sides = [0.4 * DVec3::X, 0.4 * DVec3::Y];
            let mut scene = scene(sheet(DVec3::ZERO, sides, [cells; 2], density, conditions.grid, |_| false)?);
            elastic(&mut scene, 1000.0, 1e-5);
            scene.add(Wind {
                air_density: AIR,
                ..Wind::default()
            });
            let mut run = Run::new(scene, conditions)?;
            run.advance_to(2.0)?;
            samples.push(Sample {
                at: density,
                exact: terminal(density),
                simulated: speed(&run),
                ..Sample::default()
            });
        }
        Ok(Outcome {
            samples,
            scale: terminal(0.3),
        })
    },
};
