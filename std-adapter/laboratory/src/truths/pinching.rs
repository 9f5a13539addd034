//! Cloth that hangs between two pads, which leave less room than its thickness on both sides.

use super::conditions::{Conditions, regular};
use super::run::Run;
use super::setting::{DENSITY, G, contact, elastic, rms, scene};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::AirDrag;
use selvedge_cloth::glam::{BVec3, DVec3};
use selvedge_cloth::{Body, BodyMotion, Cloth, Interpolation, Keyframe, KeyframeMotion, Mesh, OnBlocked, Simulation};

/// The rate of the air's drag, in 1/s.
const DRAG: f64 = 1.0;
/// The time at which the pads have closed and the cloth has settled between them, in seconds.
const CLOSED: f64 = 0.05;

/// Makes a box with these corners.
fn cuboid(low: DVec3, high: DVec3) -> Mesh {
    let corner = |k: u32| DVec3::select(BVec3::new(k & 4 != 0, k & 2 != 0, k & 1 != 0), high, low);
    let sides = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

/// Sets up a sheet of 0.3 m whose upper edge is between the pads, and lets them close.
fn pinched(conditions: &Conditions, friction: f64) -> Result<Run, Failure> {
    let cells = conditions.grid.number;
    let sides = [0.3 * DVec3::X, 0.3 * DVec3::Z];
    let cloth = Cloth::sheet(DVec3::new(-0.15, 0.0, -0.27), sides, [cells; 2], DENSITY)?;
    let mut scene = scene(cloth);
    scene.on_blocked = OnBlocked::Hold;
    for (name, side) in [("left", -1.0), ("right", 1.0)] {
        let mut pad = Body::from_mesh(name, cuboid(DVec3::new(-0.5, -0.01, -0.03), DVec3::new(0.5, 0.01, 0.06)));
        let key = |time, half: f64| Keyframe {
            time,
            translation: DVec3::Y * (side * (half + 0.01)),
            ..Keyframe::default()
        };
        let keys = vec![key(0.0, 4e-3), key(0.02, 2e-3)];
        let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys)?;
        pad.motion = BodyMotion::Keyframes(motion.interpolated(Interpolation::Smooth));
        scene.bodies.push(pad);
    }
    scene.add(AirDrag { rate: DRAG });
    elastic(&mut scene, 400.0, 15e-6);
    contact(&mut scene, 3e-3, friction);
    let mut run = Run::new(scene, conditions)?;
    run.advance_to(CLOSED)?;
    Ok(run)
}

/// Returns the vertices well within the pads.
fn held(simulation: &Simulation) -> Vec<usize> {
    let cloth = 0..simulation.cloth_vertices();
    cloth.filter(|&vertex| simulation.positions()[vertex].z > -0.02).collect()
}

pub(super) const PINCH: Law = Law {
    name: "pinch",
    statement: "Cloth between two pads falls freely, with drag, without friction; friction of μ ≥ 0.5 holds it in the middle",
    axes: ["coefficient of friction μ", "fall or slip, m"],
    error: ErrorUnit::Of("the free fall of 0.2 s"),
    mesh: "cells a side",
    meshes: &[regular(10), regular(20), regular(40)],
    remark: "The pads leave 4 mm for cloth that keeps 3 mm from each. Falls begin with the velocity that the closed pads leave. Slips are those of 2 s.",
    simulate: |conditions| {
        let span = 0.2;
        let fall = |velocity: f64, time: f64| {
            let decayed = (1.0 - (-DRAG * time).exp()) / DRAG;
            velocity * decayed + G / DRAG * (time - decayed)
        };
        let mut samples = Vec::new();
        for friction in [0.0, 0.5, 1.0] {
            let mut run = pinched(conditions, friction)?;
            let of = if friction > 0.0 {
                held(&run)
            } else {
                (0..run.cloth_vertices()).collect()
            };
            let mean = |all: &[DVec3]| of.iter().map(|&vertex| all[vertex]).sum::<DVec3>() / of.len() as f64;
            let (start, velocity) = (mean(run.positions()), -mean(run.velocities()).z);
            let begin = run.time();
            run.advance_to(begin + if friction > 0.0 { 2.0 } else { span })?;
            let way = mean(run.positions()) - start;
            let falls = friction == 0.0;
            samples.push(Sample {
                at: friction,
                exact: if falls { fall(velocity, run.time() - begin) } else { 0.0 },
                simulated: -way.z,
                aside: mean(run.positions()).y,
                ..Sample::default()
            });
        }
        Ok(Outcome {
            samples,
            scale: fall(0.0, span),
        })
    },
};

pub(super) const PINCH_SPEED: Law = Law {
    name: "pinch_speed",
    statement: "Cloth that two pads have held by friction for a second is at rest between them",
    axes: ["time, s", "root mean square of the speed, m/s"],
    error: ErrorUnit::In("m/s"),
    mesh: "cells a side",
    meshes: &[regular(10), regular(20), regular(40)],
    remark: "The speed is that of the vertices well within the pads. The cloth below them swings.",
    simulate: |conditions| {
        let mut run = pinched(conditions, 0.5)?;
        let of = held(&run);
        run.advance_to(1.0 + CLOSED)?;
        let samples = run.over_time(0.4, |run, _| Sample {
            simulated: rms(of.iter().map(|&vertex| run.velocities()[vertex])),
            ..Sample::default()
        })?;
        Ok(Outcome { samples, scale: 1.0 })
    },
};
