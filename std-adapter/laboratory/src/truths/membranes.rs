//! Forms of rest under tension: catenaries, a sheet under its own weight, and a balloon.

use super::setting::{DENSITY, G, advance_to, elastic, pinned, scene, solved};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, Inflation, RopeStretch, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Scene, Simulation};

const SPAN: f64 = 1.0;
const LENGTH: f64 = 1.25;

/// Returns the parameter a of the catenary between two points at one height. Its length is 2a·sinh(span/2a).
fn parameter() -> f64 {
    let (mut low, mut high) = (0.1, 10.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        // A flatter catenary is shorter.
        if 2.0 * middle * (0.5 * SPAN / middle).sinh() > LENGTH {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Lets a cloth come to rest. It starts in the xz plane as a V from the origin to (1, 0, 0).
fn at_rest(mut scene: Scene, row: &[u32], pins: Vec<u32>, step: f64) -> Result<Outcome, Failure> {
    scene.add(AirDrag { rate: 4.0 }).add(pinned(pins));
    let mut simulation = Simulation::new(scene, 1)?;
    advance_to(&mut simulation, 6.0, step)?;
    let a = parameter();
    let height = |x: f64| a * ((x - 0.5 * SPAN) / a).cosh();
    let samples = row.iter().map(|&vertex| {
        let at = simulation.positions()[vertex as usize];
        Sample {
            at: at.x,
            exact: height(at.x) - height(0.0),
            simulated: at.z,
            ..Sample::default()
        }
    });
    Ok(Outcome {
        samples: samples.collect(),
        scale: height(0.0) - height(0.5 * SPAN),
    })
}

/// Returns the lowest point of the V.
fn lowest() -> DVec3 {
    let depth = 0.5 * (LENGTH * LENGTH - SPAN * SPAN).sqrt();
    DVec3::new(0.5 * SPAN, 0.0, -depth)
}

pub(super) const HANGING_CHAIN: Law = Law {
    name: "hanging_chain",
    statement: "A rope between two points hangs as z = a·cosh(x/a)",
    axes: ["x, m", "height, m"],
    error: ErrorUnit::Of("the sag"),
    mesh: "segments",
    meshes: &[8, 16, 32],
    remark: "The error of straight segments falls with the square of their length, and does not depend on the time step.",
    simulate: |segments, step| {
        let points = [DVec3::ZERO, lowest(), DVec3::X * SPAN];
        let mut scene = scene(Cloth::rope(&points, segments, 0.05)?, step);
        scene.add(RopeStretch::new(1e5));
        let row: Vec<u32> = (0..=segments).collect();
        at_rest(scene, &row, vec![0, segments], step)
    },
};

pub(super) const CATENARY: Law = Law {
    name: "catenary",
    statement: "A sheet between two parallel bars hangs as z = a·cosh(x/a)",
    axes: ["x, m", "height, m"],
    error: ErrorUnit::Of("the sag"),
    mesh: "cells between the bars",
    meshes: &[8, 16, 32],
    remark: "As the hanging chain, and with the stretch of the fabric (10 kN/m).",
    simulate: |cells, step| {
        let across = cells / 4;
        let flat = Cloth::sheet(DVec3::ZERO, [LENGTH * DVec3::X, 0.3 * DVec3::Y], [cells, across], DENSITY)?;
        let mut mesh = flat.mesh().clone();
        for p in &mut mesh.positions {
            let way = p.x / LENGTH;
            let folded = lowest() * (2.0 * way).min(2.0 - 2.0 * way);
            *p = DVec3::new(way * SPAN, p.y, folded.z);
        }
        let mut scene = scene(Cloth::from_mesh(mesh, DVec3::X, DENSITY)?, step);
        elastic(&mut scene, 1e4, 1e-9);
        scene.add(solved(1e4));
        let first = |row: u32| row * (cells + 1);
        let pins = (0..=across).flat_map(|row| [first(row), first(row) + cells]).collect();
        let row: Vec<u32> = (first(across / 2)..=first(across / 2) + cells).collect();
        at_rest(scene, &row, pins, step)
    },
};

pub(super) const OWN_WEIGHT: Law = Law {
    name: "own_weight",
    statement: "A sheet that hangs from its upper edge sinks by u = ρ·g/k·(l·s − ½s²) at the distance s below",
    axes: ["distance below the edge, m", "sinking, m"],
    error: ErrorUnit::Of("the sinking of the lower edge"),
    mesh: "cells along",
    meshes: &[8, 16, 32],
    remark: "Straight elements with their mass at their ends are exact here. The rest is the air drag, and what the solver leaves in a step.",
    simulate: |cells, step| {
        let (length, stiffness) = (1.0, 100.0);
        let across = cells / 4;
        let sides = [0.25 * DVec3::X, -length * DVec3::Z];
        let mut scene = scene(Cloth::sheet(DVec3::ZERO, sides, [across, cells], DENSITY)?, step);
        elastic(&mut scene, stiffness, 1e-6);
        scene.add(solved(stiffness));
        scene.add(AirDrag { rate: 4.0 }).add(pinned((0..=across).collect::<Vec<_>>()));
        let mut simulation = Simulation::new(scene, 1)?;
        advance_to(&mut simulation, 3.0, step)?;
        let sinking = |s: f64| DENSITY * G / stiffness * (length * s - 0.5 * s * s);
        let samples = (0..=cells).map(|row| {
            let s = length * f64::from(row) / f64::from(cells);
            Sample {
                at: s,
                exact: sinking(s),
                simulated: -simulation.positions()[(row * (across + 1) + across / 2) as usize].z - s,
                ..Sample::default()
            }
        });
        Ok(Outcome {
            samples: samples.collect(),
            scale: sinking(length),
        })
    },
};

pub(super) const BALLOON: Law = Law {
    name: "balloon",
    statement: "A balloon whose skin has the tension T = k·(r − R)/R holds the pressure p = 2T/r (Laplace)",
    axes: ["pressure, Pa", "radius, m"],
    error: ErrorUnit::Of("the growth at 40 Pa"),
    mesh: "edges around",
    meshes: &[12, 24, 48],
    remark: "The error of flat triangles falls with the square of the edges. That of the pressure, which acts at the start of a step, falls with the step.",
    simulate: |around, step| {
        let (radius, stiffness) = (0.1, 200.0);
        let grown = |pressure: f64| radius / (1.0 - pressure * radius / (2.0 * stiffness));
        let mut samples = Vec::new();
        for pressure in [20.0, 40.0] {
            let mesh = Body::ball("ball", DVec3::ZERO, radius, around)?.mesh;
            let mut scene = Scene::new(Cloth::from_mesh(mesh, DVec3::Z, 0.2)?, step);
            scene.add(solved(stiffness)).add(AirDrag { rate: 20.0 });
            scene.add(Inflation::at(pressure)).add(SelfCollision(Thickness::new(1e-3)));
            let mut simulation = Simulation::new(scene, 1)?;
            advance_to(&mut simulation, 0.8, step)?;
            let radii = simulation.positions().iter().map(|p| p.length());
            samples.push(Sample {
                at: pressure,
                exact: grown(pressure),
                simulated: radii.sum::<f64>() / simulation.positions().len() as f64,
                ..Sample::default()
            });
        }
        Ok(Outcome {
            samples,
            scale: grown(40.0) - radius,
        })
    },
};
