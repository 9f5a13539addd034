//! Cloth that comes to rest: a sheet that lands on a table, a stack, and a bag around balls.

use super::conditions::{Conditions, Grid, irregular, regular};
use super::run::Run;
use super::setting::{DENSITY, G, contact, elastic, farthest, irregular_body, scene, sheet, speed, square};
use super::stepping::falling;
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{BodyContact, Seam, Seams, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, OnBlocked, Scene};

const THICKNESS: f64 = 2e-3;

fn with_table(mut scene: Scene, conditions: &Conditions) -> Result<Run, Failure> {
    scene
        .bodies
        .push(irregular_body("table", [2.0 * DVec3::X, 2.0 * DVec3::Y], [20; 2])?);
    elastic(&mut scene, 400.0, 15e-6);
    contact(&mut scene, THICKNESS, 0.3);
    Run::new(scene, conditions)
}

pub(super) const LANDING: Law = Law {
    name: "landing",
    statement: "A sheet that falls flat on a table stays where it lands: z = max(z₀ − ½·g·t², thickness)",
    axes: ["time, s", "height, m"],
    error: ErrorUnit::Of("the fall"),
    mesh: "cells a side",
    meshes: &[regular(3), regular(6), irregular(6), regular(12)],
    remark: "Steps of h of first order fall by ½·g·t·(t + h). There is no bounce.",
    simulate: |conditions| {
        let height = 0.05;
        let mut run = with_table(scene(square(0.3, height, conditions.grid)?), conditions)?;
        let samples = run.over_time(0.32, |run, time| {
            let after = |fall: f64| (height - fall).max(THICKNESS);
            let predicted = after(falling(G).after(run.steps(), conditions.accuracy)[0]);
            let cloth = &run.positions()[..run.cloth_vertices()];
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

/// Sets up a stack of sheets of 16 cells with a little room between them, and lets it settle for a second. Irregular sheets are
/// all alike.
fn stack(conditions: &Conditions) -> Result<Run, Failure> {
    let layer = |k: u32| -> Result<_, Failure> {
        let height = 1.1 * THICKNESS * f64::from(k + 1);
        let grid = Grid {
            number: 4,
            ..conditions.grid
        };
        Ok(square(0.3, height, grid)?.named(&format!("layer {k}")))
    };
    let mut scene = scene(layer(0)?);
    for k in 1..conditions.grid.number {
        scene.cloths.push(layer(k)?);
    }
    let mut run = with_table(scene, conditions)?;
    run.advance_to(1.0)?;
    Ok(run)
}

fn heights(conditions: &Conditions) -> Result<Outcome, Failure> {
    let run = stack(conditions)?;
    let samples = (0..conditions.grid.number).filter_map(|k| {
        let own = run.vertices_of_cloth(k as usize)?;
        let count = own.len() as f64;
        Some(Sample {
            at: f64::from(k + 1),
            exact: THICKNESS * f64::from(k + 1),
            simulated: run.positions()[own].iter().map(|p| p.z).sum::<f64>() / count,
            ..Sample::default()
        })
    });
    Ok(Outcome {
        samples: samples.collect(),
        scale: THICKNESS,
    })
}

fn speeds(conditions: &Conditions) -> Result<Outcome, Failure> {
    let samples = stack(conditions)?.over_time(0.4, |run, _| Sample {
        simulated: speed(run),
        ..Sample::default()
    })?;
    Ok(Outcome { samples, scale: 1.0 })
}

pub(super) const STACK_HEIGHT: Law = Law {
    name: "stack_height",
    statement: "The k-th sheet of a stack on a table lies at k times the thickness",
    axes: ["layer", "mean height, m"],
    error: ErrorUnit::Of("the thickness"),
    mesh: "layers",
    meshes: &[regular(2), regular(10), irregular(10), regular(20)],
    remark: "A layer bears the weight of all layers above it.",
    simulate: heights,
};

pub(super) const STACK_SPEED: Law = Law {
    name: "stack_speed",
    statement: "A stack that has lain on a table for a second is at rest",
    axes: ["time, s", "root mean square of the speed, m/s"],
    error: ErrorUnit::In("m/s"),
    mesh: "layers",
    meshes: &[regular(2), regular(10), irregular(10), regular(20)],
    remark: "Layers tremble if their contacts do not converge in a step.",
    simulate: speeds,
};

pub(super) const TALL_STACK_HEIGHT: Law = Law {
    name: "tall_stack_height",
    statement: "The k-th of fifty sheets on a table lies at k times the thickness",
    meshes: &[regular(50)],
    ..STACK_HEIGHT
};

pub(super) const TALL_STACK_SPEED: Law = Law {
    name: "tall_stack_speed",
    statement: "Fifty sheets that have lain on a table for a second are at rest",
    meshes: &[regular(50)],
    ..STACK_SPEED
};

pub(super) const BAG_SPEED: Law = Law {
    name: "bag_speed",
    statement: "A bag of two panels that are sewn together tightly around two balls is at rest a second after the seams have closed",
    axes: ["time, s", "root mean square of the speed, m/s"],
    error: ErrorUnit::In("m/s"),
    mesh: "cells along",
    meshes: &[regular(12), irregular(12), regular(18)],
    remark: "The cloth of 3 kN/m is too small for the balls, so that it is under tension everywhere.",
    simulate: |conditions| {
        let cells = conditions.grid.number;
        let panel = |name: &str, height: f64| -> Result<_, Failure> {
            let sides = [0.36 * DVec3::X, 0.26 * DVec3::Y];
            let corner = DVec3::new(-0.18, -0.13, height);
            let cells = [cells, 13 * cells / 18];
            Ok(sheet(corner, sides, cells, DENSITY, conditions.grid, |_| false)?.named(name))
        };
        let mut scene = scene(panel("front", 0.085)?);
        // The closing seams may need more time than they have.
        scene.on_blocked = OnBlocked::Hold;
        scene.cloths.push(panel("back", -0.085)?);
        for (name, x) in [("left ball", -0.08), ("right ball", 0.08)] {
            scene.bodies.push(Body::ball(name, x * DVec3::X, 0.08, 20)?);
        }
        elastic(&mut scene, 3e3, 20e-6);
        contact(&mut scene, 2e-3, 0.3);
        scene.add(BodyContact(Thickness::new(3e-3)));
        let rows = border(cells, 13 * cells / 18);
        let panel_size = (cells + 1) * (13 * cells / 18 + 1);
        let sewn = |row: Vec<u32>| Seam {
            closing: Some(0.5),
            ..Seam::new(row.clone(), row.iter().map(|vertex| vertex + panel_size).collect())
        };
        scene.add(Seams {
            seams: rows.map(sewn).into(),
        });
        let mut run = Run::new(scene, conditions)?;
        run.advance_to(1.5)?;
        let samples = run.over_time(0.5, |run, _| Sample {
            simulated: speed(run),
            ..Sample::default()
        })?;
        Ok(Outcome { samples, scale: 1.0 })
    },
};

/// Returns the four sides of a grid of vertices.
fn border(columns: u32, rows: u32) -> [Vec<u32>; 4] {
    let at = |column: u32, row: u32| row * (columns + 1) + column;
    [
        (0..=rows).map(|row| at(0, row)).collect(),
        (0..=rows).map(|row| at(columns, row)).collect(),
        (0..=columns).map(|column| at(column, rows)).collect(),
        (0..=columns).map(|column| at(column, 0)).collect(),
    ]
}
