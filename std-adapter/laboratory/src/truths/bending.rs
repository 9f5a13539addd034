//! Bending stiffness: a cantilever, a plate, and Cusick's drape test.

use super::setting::{DENSITY, G, advance_to, elastic, pinned, scene, solved};
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
    meshes: &[8, 16, 32],
    remark: "Free borders are softer than the theory of the strip, by a share of a cell. Long steps do not carry the load of fine meshes.",
    simulate: |cells, step| {
        let mut samples = Vec::new();
        for rigidity in [1e-5, 2e-5, 4e-5] {
            let edge = LENGTH / f64::from(cells);
            let columns = cells + 2;
            let corner = DVec3::new(-2.0 * edge, 0.0, 0.0);
            let sides = [(LENGTH + 2.0 * edge) * DVec3::X, 0.5 * LENGTH * DVec3::Y];
            let mut scene = scene(Cloth::sheet(corner, sides, [columns, cells / 2], DENSITY)?, step);
            elastic(&mut scene, 1000.0, rigidity);
            scene.add(solved(1000.0)).add(Bend {
                stages: 300,
                ..Bend::isotropic(rigidity)
            });
            let row = |row: u32| row * (columns + 1);
            scene.add(pinned(
                (0..=cells / 2)
                    .flat_map(|k| [row(k), row(k) + 1, row(k) + 2])
                    .collect::<Vec<_>>(),
            ));
            scene.add(AirDrag { rate: 8.0 });
            let mut simulation = Simulation::new(scene, 1)?;
            advance_to(&mut simulation, 1.5, step)?;
            samples.push(Sample {
                at: rigidity,
                exact: sinking(rigidity),
                simulated: -simulation.positions()[(row(cells / 4) + columns) as usize].z,
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
    meshes: &[8, 16, 32],
    remark: "The load is small enough for stretch not to count. Clamps end within a share of a cell, as those of the cantilever do.",
    simulate: |cells, step| {
        let (side, gravity) = (0.1_f64, 1.0);
        let sag = |rigidity: f64| 1.265_32e-3 * DENSITY * gravity * side.powi(4) / rigidity;
        let mut samples = Vec::new();
        for rigidity in [1e-4, 2e-4, 4e-4] {
            // Two rings of vertices are pinned: the inner one is the plate's border.
            let edge = side / f64::from(cells);
            let whole = side + 2.0 * edge;
            let sides = [whole * DVec3::X, whole * DVec3::Y];
            let cloth = Cloth::sheet(-0.5 * (sides[0] + sides[1]), sides, [cells + 2; 2], DENSITY)?;
            let is_pinned = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.5 * side - 0.1 * edge;
            let all = (0..).zip(&cloth.mesh().positions);
            let border: Vec<u32> = all.filter(|(_, point)| is_pinned(point)).map(|(vertex, _)| vertex).collect();
            let mut scene = Scene::new(cloth, step);
            let acceleration = -gravity * DVec3::Z;
            scene
                .add(Gravity { acceleration })
                .add(AirDrag { rate: 8.0 })
                .add(pinned(border));
            scene.add(Stretch::isotropic(20.0)).add(Bend {
                stages: 300,
                ..Bend::isotropic(rigidity)
            });
            let mut simulation = Simulation::new(scene, 1)?;
            advance_to(&mut simulation, 1.0, step)?;
            let middle = simulation.positions().len() / 2;
            samples.push(Sample {
                at: rigidity,
                exact: sag(rigidity),
                simulated: -simulation.positions()[middle].z,
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
    meshes: &[10, 15, 20],
    remark: "Fabrics differ: an error up to 12 % is within the published values. Longer steps leave more of the folds undone.",
    simulate: |rings, step| {
        let published = 0.5 * (0.60 + 0.76);
        let mut scene = Scene::new(Cloth::from_mesh(specimen(rings), DVec3::X, DENSITY)?, step);
        scene.add(Bend::isotropic(25e-6));
        scene.add(Stretch {
            sweeps: 4,
            ..Stretch::isotropic(260.0)
        });
        scene.add(Shear {
            sweeps: 4,
            ..Shear::new(65.0)
        });
        Ok(Outcome {
            samples: vec![Sample {
                at: f64::from(rings),
                exact: published,
                simulated: drape_coefficient(scene)?,
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
pub(super) fn drape_coefficient(mut scene: Scene) -> Result<f64, Failure> {
    let step = scene.time_step;
    let held = { (0..).zip(&scene.cloths[0].mesh().positions) }.filter(|(_, p)| p.length() <= DISC + 1e-4);
    let held: Vec<u32> = held.map(|(vertex, _)| vertex).collect();
    scene.add(selvedge_cloth::effects::Gravity::default()).add(pinned(held));
    scene.add(AirDrag { rate: 8.0 }).add(SelfCollision(Thickness::new(1e-3)));
    let mut simulation = Simulation::new(scene, 1)?;
    advance_to(&mut simulation, 1.5, step)?;
    Ok(shadow(&simulation))
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
