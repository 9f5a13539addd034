//! Motion without contact: free fall, drag, and momenta.

use super::conditions::{irregular, regular};
use super::run::Run;
use super::setting::{DENSITY, G, elastic, farthest, scene, square, weightless};
use super::stepping::{Motion, falling};
use super::{ErrorUnit, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, StrainLimit};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Simulation};

pub(super) const FREE_FALL: Law = Law {
    name: "free_fall",
    statement: "Free fall: s = ½·g·t²",
    axes: ["time, s", "fall, m"],
    error: ErrorUnit::Of("the fall"),
    mesh: "cells a side",
    meshes: &[regular(1), regular(4), irregular(4), regular(16)],
    remark: "Steps of h of first order give ½·g·t·(t + h) on any mesh; those of second order have the error of the first step only.",
    simulate: |conditions| {
        let mut scene = scene(square(0.5, 0.0, conditions.grid)?);
        elastic(&mut scene, 400.0, 1e-2);
        let mut run = Run::new(scene, conditions)?;
        let span = 0.24;
        let samples = run.over_time(span, |run, time| {
            let [predicted, _] = falling(G).after(run.steps(), conditions.accuracy);
            Sample {
                exact: 0.5 * G * time * time,
                predicted: Some(predicted),
                simulated: farthest(run.positions().iter().map(|p| -p.z), predicted),
                ..Sample::default()
            }
        })?;
        Ok(Outcome {
            samples,
            scale: 0.5 * G * span * span,
        })
    },
};

pub(super) const TERMINAL_SPEED: Law = Law {
    name: "terminal_speed",
    statement: "Fall in air with the drag rate k: v = g/k·(1 − exp(−k·t))",
    axes: ["time, s", "speed, m/s"],
    error: ErrorUnit::Of("the terminal speed"),
    mesh: "cells a side",
    meshes: &[regular(1), regular(4), irregular(4), regular(16)],
    remark: "The speed ends at g/k. The error of the approach is of the order of the steps.",
    simulate: |conditions| {
        let rate = 4.0;
        let mut scene = scene(square(0.5, 0.0, conditions.grid)?);
        scene.add(AirDrag { rate });
        elastic(&mut scene, 400.0, 1e-2);
        let mut run = Run::new(scene, conditions)?;
        let samples = run.over_time(1.6, |run, time| {
            let share = -(-rate * time).exp_m1();
            let motion = Motion {
                drag: rate,
                ..falling(G)
            };
            let [_, predicted] = motion.after(run.steps(), conditions.accuracy);
            Sample {
                exact: G / rate * share,
                predicted: Some(predicted),
                simulated: farthest(run.velocities().iter().map(|v| -v.z), predicted),
                ..Sample::default()
            }
        })?;
        Ok(Outcome {
            samples,
            scale: G / rate,
        })
    },
};

pub(super) const MOMENTUM: Law = Law {
    name: "momentum",
    statement: "A spinning sheet that shakes in empty space: angular momentum L and momentum P are constant",
    axes: ["time, s", "change of L over Σ m·|x|·|v|"],
    error: ErrorUnit::Of("Σ m·|x|·|v| and Σ m·|v|"),
    mesh: "cells a side",
    meshes: &[regular(5), regular(10), irregular(10), regular(20)],
    remark: "Inner forces and strain limits leave both momenta, up to rounding.",
    simulate: |conditions| {
        let flat = square(0.5, 0.0, conditions.grid)?;
        let mut mesh = flat.mesh().clone();
        for p in &mut mesh.positions {
            *p += DVec3::new(0.25, 0.25 + 0.01 * (9.0 * p.x).sin(), 0.05 * (11.0 * p.x + 5.0 * p.y).sin());
        }
        let mut masses = vec![0.0; mesh.positions.len()];
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
            let third = DENSITY * (b - a).cross(c - a).length() / 6.0;
            triangle.iter().for_each(|&vertex| masses[vertex as usize] += third);
        }
        let mut scene = weightless(Cloth::from_mesh(mesh.clone(), DVec3::X, DENSITY)?);
        elastic(&mut scene, 400.0, 1e-2);
        scene.add(StrainLimit::at(1.02));
        let mut run = Run::new(scene, conditions)?;
        let spin = DVec3::new(3.0, -2.0, 5.0);
        for (vertex, position) in (0..).zip(&mesh.positions) {
            run.set_velocity(&[vertex], spin.cross(*position))?;
        }
        run.tick()?;
        let momenta = |simulation: &Simulation| {
            let all = simulation.positions().iter().zip(simulation.velocities()).zip(&masses);
            let zero = ([DVec3::ZERO; 2], [0.0; 2]);
            all.fold(zero, |([turn, push], [turns, pushes]), ((x, v), m)| {
                let sizes = [turns + m * x.length() * v.length(), pushes + m * v.length()];
                ([turn + *m * x.cross(*v), push + *m * *v], sizes)
            })
        };
        let (before, _) = momenta(&run);
        let samples = run.over_time(0.96, |run, _| {
            let (now, sizes) = momenta(run);
            let change = |k: usize| (now[k] - before[k]).length() / sizes[k];
            Sample {
                simulated: change(0),
                aside: change(1),
                ..Sample::default()
            }
        })?;
        Ok(Outcome { samples, scale: 1.0 })
    },
};
