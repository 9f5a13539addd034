//! Motion without contact: free fall, drag, and momenta.

use super::setting::{DENSITY, G, elastic, farthest, over_time, scene, square};
use super::{ErrorUnit, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, StrainLimit};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};

pub(super) const FREE_FALL: Law = Law {
    name: "free_fall",
    statement: "Free fall: s = ½·g·t²",
    axes: ["time, s", "fall, m"],
    error: ErrorUnit::Of("the fall"),
    mesh: "cells a side",
    meshes: &[1, 4, 16],
    remark: "Semi-implicit steps of h give ½·g·t·(t + h) on any mesh.",
    simulate: |cells, step| {
        let mut scene = scene(square(0.5, 0.0, cells)?, step);
        elastic(&mut scene, 400.0, 1e-2);
        let mut simulation = Simulation::new(scene, 1)?;
        let span = 0.24;
        let samples = over_time(&mut simulation, [span, step], |simulation, time, _| {
            let predicted = 0.5 * G * time * (time + step);
            Sample {
                exact: 0.5 * G * time * time,
                predicted: Some(predicted),
                simulated: farthest(simulation.positions().iter().map(|p| -p.z), predicted),
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
    meshes: &[1, 4, 16],
    remark: "A step takes gravity first and then exact drag, so that it ends at g·h/(exp(k·h) − 1), which is ½·k·h below g/k.",
    simulate: |cells, step| {
        let rate = 4.0;
        let mut scene = scene(square(0.5, 0.0, cells)?, step);
        scene.add(AirDrag { rate });
        elastic(&mut scene, 400.0, 1e-2);
        let mut simulation = Simulation::new(scene, 1)?;
        let samples = over_time(&mut simulation, [1.6, step], |simulation, time, _| {
            let share = -(-rate * time).exp_m1();
            let predicted = G * step / (rate * step).exp_m1() * share;
            Sample {
                exact: G / rate * share,
                predicted: Some(predicted),
                simulated: farthest(simulation.velocities().iter().map(|v| -v.z), predicted),
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
    meshes: &[5, 10, 20],
    remark: "Inner forces and strain limits leave both momenta, up to rounding.",
    simulate: |cells, step| {
        let flat = square(0.5, 0.0, cells)?;
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
        let mut scene = Scene::new(Cloth::from_mesh(mesh.clone(), DVec3::X, DENSITY)?, step);
        elastic(&mut scene, 400.0, 1e-2);
        scene.add(StrainLimit::at(1.02));
        let mut simulation = Simulation::new(scene, 1)?;
        let spin = DVec3::new(3.0, -2.0, 5.0);
        for (vertex, position) in (0..).zip(&mesh.positions) {
            simulation.set_velocity(&[vertex], spin.cross(*position))?;
        }
        simulation.step()?;
        let momenta = |simulation: &Simulation| {
            let all = simulation.positions().iter().zip(simulation.velocities()).zip(&masses);
            let zero = ([DVec3::ZERO; 2], [0.0; 2]);
            all.fold(zero, |([turn, push], [turns, pushes]), ((x, v), m)| {
                let sizes = [turns + m * x.length() * v.length(), pushes + m * v.length()];
                ([turn + *m * x.cross(*v), push + *m * *v], sizes)
            })
        };
        let (before, _) = momenta(&simulation);
        let samples = over_time(&mut simulation, [0.96, step], |simulation, _, _| {
            let (now, sizes) = momenta(simulation);
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
