//! Bending stiffness: a cantilever, a plate, and Cusick's drape test.

use super::conditions::{Conditions, irregular, regular};
use super::run::Run;
use super::setting::{DENSITY, G, elastic, membrane, pinned, scene, sheet, vertices_where, weightless};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, Bend, Gravity, SelfCollision, Shear, Stretch, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Mesh, Scene, Simulation};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The length of the cantilever, in m.
const LENGTH: f64 = 0.04;

/// Returns how far the tip of a heavy elastic strip sinks, in metres. Its angle θ satisfies D·θ″ = −ρ·g·u·cos θ at the distance u
/// from the tip, where θ′ = 0, and is zero at the clamp.
fn sinking(rigidity: f64) -> f64 {
    const PARTS: u32 = 4000;
    let part = LENGTH / f64::from(PARTS);
    let at_clamp = |tip: f64| {
        let (mut before, mut angle, mut sinking) = (tip, tip, 0.0);
        for k in 0..PARTS {
            let bent = DENSITY * G / rigidity * part * f64::from(k) * angle.cos();
            (before, angle) = (angle, 2.0 * angle - before - part * part * bent);
            sinking += 0.5 * part * (before.sin() + angle.sin());
        }
        [angle, sinking]
    };
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if at_clamp(middle)[0] < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    at_clamp(low)[1]
}

pub(super) const CANTILEVER: Law = Law {
    name: "cantilever",
    statement: "A strip that is clamped at one end sinks as the heavy elastica: D·θ″ = −ρ·g·(l − s)·cos θ",
    axes: ["bending stiffness D, N·m", "sinking of the tip, m"],
    error: ErrorUnit::Of("the length"),
    mesh: "cells along",
    meshes: &[regular(8), regular(16), irregular(16), regular(32)],
    remark: "Free borders are softer than the theory of the strip, by a share of a cell.",
    simulate: |conditions| {
        let cells = conditions.grid.number;
        let mut samples = Vec::new();
        for rigidity in [1e-5, 2e-5, 4e-5] {
            let edge = LENGTH / f64::from(cells);
            let columns = cells + 2;
            let corner = DVec3::new(-2.0 * edge, 0.0, 0.0);
            let sides = [(LENGTH + 2.0 * edge) * DVec3::X, 0.5 * LENGTH * DVec3::Y];
            let is_clamped = |point: DVec3| point.x < 0.1 * edge;
            let cloth = sheet(corner, sides, [columns, cells / 2], DENSITY, conditions.grid, is_clamped)?;
            let clamp = pinned(vertices_where(cloth.mesh(), is_clamped));
            let mut scene = scene(cloth);
            elastic(&mut scene, 1000.0, rigidity);
            scene.add(clamp).add(AirDrag { rate: 16.0 });
            let tip = cells / 4 * (columns + 1) + columns;
            let mut run = Run::new(scene, conditions)?;
            run.advance_to(1.5)?;
            samples.push(Sample {
                at: rigidity,
                exact: sinking(rigidity),
                simulated: -run.positions()[tip as usize].z,
                ..Sample::default()
            });
        }
        Ok(Outcome { samples, scale: LENGTH })
    },
};

pub(super) const PLATE: Law = Law {
    name: "plate",
    statement: "A square plate that is clamped on all sides sags in the middle by 0.00126532·q·a⁴/D (Timoshenko)",
    axes: ["bending stiffness D, N·m", "sag of the middle, m"],
    error: ErrorUnit::Of("the largest sag"),
    mesh: "cells a side",
    meshes: &[regular(8), regular(16), irregular(16), regular(32)],
    remark: "The load is small enough for stretch not to count. Clamps end within a share of a cell, as those of the cantilever do.",
    simulate: |conditions| {
        let (side, gravity, cells) = (0.1_f64, 1.0, conditions.grid.number);
        let sag = |rigidity: f64| 1.265_32e-3 * DENSITY * gravity * side.powi(4) / rigidity;
        let mut samples = Vec::new();
        for rigidity in [1e-4, 2e-4, 4e-4] {
            // Two rings of vertices are pinned: the inner one is the plate's border.
            let edge = side / f64::from(cells);
            let whole = side + 2.0 * edge;
            let sides = [whole * DVec3::X, whole * DVec3::Y];
            let is_pinned = |point: DVec3| point.x.abs().max(point.y.abs()) > 0.5 * side - 0.1 * edge;
            let corner = -0.5 * (sides[0] + sides[1]);
            let cloth = sheet(corner, sides, [cells + 2; 2], DENSITY, conditions.grid, is_pinned)?;
            let border = vertices_where(cloth.mesh(), is_pinned);
            let mut scene = weightless(cloth);
            let acceleration = -gravity * DVec3::Z;
            scene
                .add(Gravity { acceleration })
                .add(AirDrag { rate: 20.0 })
                .add(pinned(border));
            membrane(&mut scene, 20.0);
            scene.add(Bend::isotropic(rigidity));
            let mut run = Run::new(scene, conditions)?;
            run.advance_to(1.0)?;
            let middle = run.positions().iter().map(|point| point.z).fold(0.0, f64::min);
            samples.push(Sample {
                at: rigidity,
                exact: sag(rigidity),
                simulated: -middle,
                ..Sample::default()
            });
        }
        Ok(Outcome {
            samples,
            scale: sag(1e-4),
        })
    },
};

pub(super) const DRAPE: Law = Law {
    name: "drape",
    statement: "Cotton covers 60 to 76 % of the ring in Cusick's drape test (published measurements)",
    axes: ["rings of triangles", "drape coefficient"],
    error: ErrorUnit::Of("the mean of the published values"),
    mesh: "rings of triangles",
    meshes: &[regular(10), regular(15), regular(20)],
    remark: "Fabrics differ: an error up to 12 % is within the published values. Finer meshes cover more, 78 % with 20 rings.",
    simulate: |conditions| {
        let rings = conditions.grid.number;
        let published = 0.5 * (0.60 + 0.76);
        let mut scene = weightless(Cloth::from_mesh(specimen(rings), DVec3::X, DENSITY)?);
        scene.add(Bend::isotropic(25e-6));
        scene.add(Stretch::isotropic(260.0)).add(Shear::new(65.0));
        Ok(Outcome {
            samples: vec![Sample {
                at: f64::from(rings),
                exact: published,
                simulated: drape_coefficient(scene, conditions)?,
                ..Sample::default()
            }],
            scale: published,
        })
    },
};

const SPECIMEN: f64 = 0.15;
const DISC: f64 = 0.09;

/// Returns a specimen for Cusick's test: a round sheet 30 cm across, of so many rings of triangles.
pub(super) fn specimen(rings: u32) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.positions.push(DVec3::ZERO);
    for ring in 1..=rings {
        mesh.positions.extend((0..6 * ring).map(|k| {
            let (sine, cosine) = (TAU * f64::from(k) / f64::from(6 * ring)).sin_cos();
            SPECIMEN * f64::from(ring) / f64::from(rings) * DVec3::new(cosine, sine, 0.0)
        }));
    }
    let vertex = |ring: u32, k: u32| match ring {
        0 => 0,
        _ => 1 + 3 * ring * (ring - 1) + k % (6 * ring),
    };
    for ring in 1..=rings {
        for (side, k) in (0..6).flat_map(|side| (0..ring).map(move |k| (side, k))) {
            let outer = |k: u32| vertex(ring, side * ring + k);
            let inner = |k: u32| vertex(ring - 1, side * (ring - 1) + k);
            mesh.triangles.push([outer(k), outer(k + 1), inner(k)]);
            if k + 1 < ring {
                mesh.triangles.push([inner(k), outer(k + 1), inner(k + 1)]);
            }
        }
    }
    mesh
}

/// Makes Cusick's drape test of a [`specimen`] with the effects of its fabric. Returns the drape coefficient: the share of the
/// ring around the disc, 18 cm across, that the cloth's shadow covers.
///
/// # Errors
/// Returns an error if the scene cannot be set up, or if a step is blocked.
pub(super) fn drape_coefficient(mut scene: Scene, conditions: &Conditions) -> Result<f64, Failure> {
    let held = vertices_where(scene.cloths[0].mesh(), |point| point.length() <= DISC + 1e-4);
    scene.add(Gravity::default()).add(pinned(held));
    scene.add(AirDrag { rate: 8.0 }).add(SelfCollision(Thickness::new(1e-3)));
    let mut run = Run::new(scene, conditions)?;
    run.advance_to(1.5)?;
    Ok(shadow(&run))
}

/// Returns the share of the ring in the shadow, which is taken to be star-shaped: in each direction it reaches the farthest point
/// of an edge.
fn shadow(simulation: &Simulation) -> f64 {
    const DIRECTIONS: usize = 360;
    let mut farthest = [0.0_f64; DIRECTIONS];
    for triangle in simulation.triangles() {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [from, to].map(|k| simulation.positions()[triangle[k] as usize]);
            for step in 0..=10 {
                let point = from.lerp(to, f64::from(step) / 10.0);
                let share = (point.y.atan2(point.x) / TAU).rem_euclid(1.0);
                let direction = (share * DIRECTIONS as f64) as usize % DIRECTIONS;
                farthest[direction] = farthest[direction].max(point.x.hypot(point.y));
            }
        }
    }
    let shadow = farthest.iter().map(|radius| radius * radius).sum::<f64>() * PI / DIRECTIONS as f64;
    let [all, disc] = [SPECIMEN, DISC].map(|radius| PI * radius * radius);
    (shadow - disc) / (all - disc)
}
