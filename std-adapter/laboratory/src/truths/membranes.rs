//! Forms of rest under tension: catenaries, and a sheet under its own weight.

use super::conditions::{Conditions, irregular, regular};
use super::forms::Catenary;
use super::run::Run;
use super::setting::{DENSITY, G, elastic, pinned, scene, sheet, vertices_where};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, RopeStretch};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene};

const SPAN: f64 = 1.0;
const LENGTH: f64 = 1.25;

/// Lets a cloth come to rest. It starts in the xz plane as a V from the origin to (1, 0, 0).
fn at_rest(mut scene: Scene, row: &[u32], pins: Vec<u32>, conditions: &Conditions) -> Result<Outcome, Failure> {
    scene.add(AirDrag { rate: 4.0 }).add(pinned(pins));
    let mut run = Run::new(scene, conditions)?;
    run.advance_to(6.0)?;
    let curve = Catenary::of_length(SPAN, |_| LENGTH);
    let samples = row.iter().map(|&vertex| {
        let at = run.positions()[vertex as usize];
        Sample {
            at: at.x,
            exact: curve.height(at.x),
            simulated: at.z,
            ..Sample::default()
        }
    });
    Ok(Outcome {
        samples: samples.collect(),
        scale: curve.sag(),
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
    meshes: &[regular(8), regular(16), regular(32)],
    remark: "The error of straight segments falls with the square of their length, and does not depend on the time step.",
    simulate: |conditions| {
        let segments = conditions.grid.number;
        let points = [DVec3::ZERO, lowest(), DVec3::X * SPAN];
        let mut scene = scene(Cloth::rope(&points, segments, 0.05)?);
        scene.add(RopeStretch::new(1e5));
        let row: Vec<u32> = (0..=segments).collect();
        at_rest(scene, &row, vec![0, segments], conditions)
    },
};

pub(super) const CATENARY: Law = Law {
    name: "catenary",
    statement: "A sheet between two parallel bars hangs as z = a·cosh(x/a)",
    axes: ["x, m", "height, m"],
    error: ErrorUnit::Of("the sag"),
    mesh: "cells between the bars",
    meshes: &[regular(8), regular(16), irregular(16), regular(32)],
    remark: "As the hanging chain, and with the stretch of the fabric (10 kN/m).",
    simulate: |conditions| {
        let (cells, across) = (conditions.grid.number, conditions.grid.number / 4);
        let sides = [LENGTH * DVec3::X, 0.3 * DVec3::Y];
        // The fold is an edge, so that a triangle is not bent at the start.
        let is_fold = |point: DVec3| (point.x - 0.5 * LENGTH).abs() < 1e-9;
        let flat = sheet(DVec3::ZERO, sides, [cells, across], DENSITY, conditions.grid, is_fold)?;
        let mut mesh = flat.mesh().clone();
        for p in &mut mesh.positions {
            let way = p.x / LENGTH;
            let folded = lowest() * (2.0 * way).min(2.0 - 2.0 * way);
            *p = DVec3::new(way * SPAN, p.y, folded.z);
        }
        let mut scene = scene(Cloth::from_mesh(mesh, DVec3::X, DENSITY)?);
        elastic(&mut scene, 1e4, 1e-9);
        let first = |row: u32| row * (cells + 1);
        let pins = (0..=across).flat_map(|row| [first(row), first(row) + cells]).collect();
        let row: Vec<u32> = (first(across / 2)..=first(across / 2) + cells).collect();
        at_rest(scene, &row, pins, conditions)
    },
};

pub(super) const OWN_WEIGHT: Law = Law {
    name: "own_weight",
    statement: "A sheet that hangs from its upper edge sinks by u = ρ·g/k·(l·s − ½s²) at the distance s below",
    axes: ["distance below the edge, m", "sinking, m"],
    error: ErrorUnit::Of("the sinking of the lower edge"),
    mesh: "cells along",
    meshes: &[regular(8), regular(16), irregular(16), regular(32)],
    remark: "Straight elements with their mass at their ends are exact on regular meshes. A sheet at rest does not feel the drag of the air.",
    simulate: |conditions| {
        let (length, stiffness) = (1.0, 100.0);
        let (cells, across) = (conditions.grid.number, conditions.grid.number / 4);
        let sides = [0.25 * DVec3::X, -length * DVec3::Z];
        let cloth = sheet(DVec3::ZERO, sides, [across, cells], DENSITY, conditions.grid, |_| false)?;
        let rest = cloth.mesh().positions.clone();
        let edge = pinned(vertices_where(cloth.mesh(), |point| point.z > -1e-9));
        let mut scene = scene(cloth);
        elastic(&mut scene, stiffness, 1e-6);
        scene.add(AirDrag { rate: 8.0 }).add(edge);
        let mut run = Run::new(scene, conditions)?;
        run.advance_to(3.0)?;
        let sinking = |s: f64| DENSITY * G / stiffness * (length * s - 0.5 * s * s);
        let samples = (0..=cells).map(|row| {
            let vertex = (row * (across + 1) + across / 2) as usize;
            let s = -rest[vertex].z;
            Sample {
                at: s,
                exact: sinking(s),
                simulated: -run.positions()[vertex].z - s,
                ..Sample::default()
            }
        });
        Ok(Outcome {
            samples: samples.collect(),
            scale: sinking(length),
        })
    },
};
