//! Cloth that comes to rest on a table: one sheet that lands, and a stack.

use super::setting::{G, advance_to, contact, elastic, farthest, irregular, over_time, rms, scene, square};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Scene, Simulation};

const THICKNESS: f64 = 2e-3;

fn with_table(mut scene: Scene) -> Result<Simulation, Failure> {
    scene
        .bodies
        .push(irregular("table", [2.0 * DVec3::X, 2.0 * DVec3::Y], [20; 2])?);
    elastic(&mut scene, 400.0, 15e-6);
    contact(&mut scene, THICKNESS, 0.3);
    Ok(Simulation::new(scene, 1)?)
}

pub(super) const LANDING: Law = Law {
    name: "landing",
    statement: "A sheet that falls flat on a table stays where it lands: z = max(z₀ − ½·g·t², thickness)",
    axes: ["time, s", "height, m"],
    error: ErrorUnit::Of("the fall"),
    mesh: "cells a side",
    meshes: &[3, 6, 12],
    remark: "Semi-implicit steps of h fall by ½·g·t·(t + h). There is no bounce.",
    simulate: |cells, step| {
        let height = 0.05;
        let mut simulation = with_table(scene(square(0.3, height, cells)?, step))?;
        let samples = over_time(&mut simulation, [0.32, step], |simulation, time, _| {
            let after = |fall: f64| (height - fall).max(THICKNESS);
            let predicted = after(0.5 * G * time * (time + step));
            let cloth = &simulation.positions()[..simulation.cloth_vertices()];
            Sample {
                exact: after(0.5 * G * time * time),
                predicted: Some(predicted),
                simulated: farthest(cloth.iter().map(|p| p.z), predicted),
                ..Sample::default()
            }
        })?;
        Ok(Outcome {
            samples,
            scale: height - THICKNESS,
        })
    },
};

/// Sets up a stack of sheets with a little room between them, and lets it settle for a second.
fn stack(layers: u32, step: f64) -> Result<Simulation, Failure> {
    let layer = |k: u32| -> Result<_, Failure> {
        let height = 1.1 * THICKNESS * f64::from(k + 1);
        Ok(square(0.3, height, 4)?.named(&format!("layer {k}")))
    };
    let mut scene = scene(layer(0)?, step);
    for k in 1..layers {
        scene.cloths.push(layer(k)?);
    }
    let mut simulation = with_table(scene)?;
    advance_to(&mut simulation, 1.0, step)?;
    Ok(simulation)
}

pub(super) const STACK_HEIGHT: Law = Law {
    name: "stack_height",
    statement: "The k-th sheet of a stack on a table lies at k times the thickness",
    axes: ["layer", "mean height, m"],
    error: ErrorUnit::Of("the thickness"),
    mesh: "layers",
    meshes: &[2, 10, 50],
    remark: "A step sweeps four times over contacts, which does not carry the weight of many layers down to the table at once.",
    simulate: |layers, step| {
        let simulation = stack(layers, step)?;
        let samples = (0..layers).filter_map(|k| {
            let own = simulation.vertices_of_cloth(k as usize)?;
            let count = own.len() as f64;
            Some(Sample {
                at: f64::from(k + 1),
                exact: THICKNESS * f64::from(k + 1),
                simulated: simulation.positions()[own].iter().map(|p| p.z).sum::<f64>() / count,
                ..Sample::default()
            })
        });
        Ok(Outcome {
            samples: samples.collect(),
            scale: THICKNESS,
        })
    },
};

pub(super) const STACK_SPEED: Law = Law {
    name: "stack_speed",
    statement: "A stack that has lain on a table for a second is at rest",
    axes: ["time, s", "root mean square of the speed, m/s"],
    error: ErrorUnit::In("m/s"),
    mesh: "layers",
    meshes: &[2, 10, 50],
    remark: "Layers tremble, since the sweeps over their contacts do not converge in a step.",
    simulate: |layers, step| {
        let mut simulation = stack(layers, step)?;
        let samples = over_time(&mut simulation, [0.4, step], |simulation, _, _| Sample {
            simulated: rms(simulation.velocities()[..simulation.cloth_vertices()].iter().copied()),
            ..Sample::default()
        })?;
        Ok(Outcome { samples, scale: 1.0 })
    },
};
