//! Pressure: balloons, a gas, and a strip that is held at two sides.
//!
//! **A closed skin** of the stiffness k (N/m, in all directions) around a ball of the radius R at rest grows by the factor l. Its
//! energy is k(l − 1)² on each area at rest, and the pressure p does the work p·4πR²·l²·R·dl. At rest 2k(l − 1) = p·R·l². A
//! polyhedron that grows evenly obeys the same equation if R is three times its volume over its area at rest. Its flat faces grow
//! nearly evenly: the least energy of a mesh has another growth by at most 0.4, 0.2 and 0.04 % of it with 6, 10 and 16 edges
//! (foil; less the more the skin grows).
//!
//! **A gas** of the modulus K that has room in r times the volume V₀ has the pressure p = K(1 − V/(r·V₀)), V = l³·V₀.
//!
//! **A strip** of the length 1 m that is held at two sides, 1 m apart, is an arc of a circle: pressure acts along the normal, so
//! that the tension T is the same everywhere, and T = p·R. The length of the arc is 2R·asin(1/2R) = 1 + T/k. Chords instead of
//! the arc, and their loads at their ends, have an error of 0.12 % of the sag with 16 cells. It falls with their square.
//!
//! **Half a balloon** pulls at its border with p times the area in the border, whatever its shape and stiffness.

use super::conditions::{Conditions, Grid, irregular, regular};
use super::forms::root;
use super::run::Run;
use super::setting::{held_strip, membrane, middle_of_strip, pinned, speed, vertices_where, weightless};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use fastrand::Rng;
use selvedge_cloth::effects::{AirDrag, Effect, Inflation, InternalPressure, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Mesh, Simulation};
use std::collections::BTreeMap;

/// The radius of balloons at rest, in m.
const RADIUS: f64 = 0.1;

/// A fabric of a balloon.
#[derive(Clone, Copy)]
struct Skin {
    /// The mass, in kg/m².
    density: f64,
    /// The stiffness, in N/m.
    stiffness: f64,
}

const LIGHT: Skin = Skin {
    density: 0.02,
    stiffness: 2e3,
};
const FOIL: Skin = Skin {
    density: 0.03,
    stiffness: 1e5,
};
const LATEX: Skin = Skin {
    density: 0.23,
    stiffness: 375.0,
};

/// Returns a ball from an octahedron whose edges are cut into a number of parts. On an irregular grid vertices are moved on the
/// ball, except those at height zero.
fn ball(grid: Grid) -> Mesh {
    let count = grid.number as i32;
    let (mut mesh, mut known, mut random) = (Mesh::default(), BTreeMap::new(), Rng::with_seed(7));
    for octant in 0..8 {
        let signs = [1, 2, 4].map(|bit| if octant & bit == 0 { 1 } else { -1 });
        let mut vertex = |corner: [i32; 3]| {
            let place: [i32; 3] = std::array::from_fn(|axis| signs[axis] * corner[axis]);
            *known.entry(place).or_insert_with(|| {
                let mut point = DVec3::from_array(place.map(f64::from)).normalize();
                let mut moved = || 0.5 * (random.f64() - 0.5) / f64::from(count);
                let way = DVec3::new(moved(), moved(), moved());
                if grid.is_irregular && place[2] != 0 {
                    point = (point + way).normalize();
                }
                mesh.positions.push(RADIUS * point);
                mesh.positions.len() as u32 - 1
            })
        };
        for (a, b) in (0..count).flat_map(|a| (0..count - a).map(move |b| (a, b))) {
            let c = count - 1 - a - b;
            let mut faces = vec![[[a + 1, b, c], [a, b + 1, c], [a, b, c + 1]]];
            if c > 0 {
                faces.push([[a + 1, b + 1, c - 1], [a, b + 1, c], [a + 1, b, c]]);
            }
            for face in faces {
                let [first, second, third] = face.map(&mut vertex);
                let is_turned = signs.iter().product::<i32>() < 0;
                mesh.triangles.push(if is_turned {
                    [first, third, second]
                } else {
                    [first, second, third]
                });
            }
        }
    }
    mesh
}

/// Returns the volume in a closed mesh.
fn volume(triangles: &[[u32; 3]], positions: &[DVec3]) -> f64 {
    let parts = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        a.dot(b.cross(c)) / 6.0
    });
    parts.sum()
}

/// Returns the area of a mesh.
fn area(mesh: &Mesh) -> f64 {
    let parts = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        0.5 * (b - a).cross(c - a).length()
    });
    parts.sum()
}

/// Sets up a balloon, without gravity and drag.
fn inflated(skin: Skin, load: impl Effect + 'static, conditions: &Conditions) -> Result<Run, Failure> {
    let mut scene = weightless(Cloth::from_mesh(ball(conditions.grid), DVec3::Z, skin.density)?);
    membrane(&mut scene, skin.stiffness);
    scene.add(load).add(SelfCollision(Thickness::new(1e-3)));
    Run::new(scene, conditions)
}

/// Returns the growth that a pressure gives a balloon. `pressure` takes the growth factor.
fn exact_growth(stiffness: f64, pressure: impl Fn(f64) -> f64, mesh: &Mesh) -> f64 {
    let radius = 3.0 * volume(&mesh.triangles, &mesh.positions) / area(mesh);
    // The smaller of two roots: a balloon that grows beyond the other one bursts.
    root([1.0, 1.9], |l| 2.0 * stiffness * (l - 1.0) - pressure(l) * radius * l * l) - 1.0
}

/// Returns the sample of a balloon at rest: its growth, and how far its centre has moved, over the radius.
fn growth(run: &Simulation, mesh: &Mesh, at: f64, exact: f64) -> Sample {
    let positions = run.positions();
    let ratio = volume(&mesh.triangles, positions) / volume(&mesh.triangles, &mesh.positions);
    Sample {
        at,
        exact,
        simulated: ratio.cbrt() - 1.0,
        aside: (centre(positions) - centre(&mesh.positions)).length() / RADIUS,
        ..Sample::default()
    }
}

/// Returns the mean of points.
fn centre(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len() as f64
}

/// Lets balloons at pressures in Pa come to rest.
fn inflate_balloons(skin: Skin, pressures: &[f64], conditions: &Conditions) -> Result<Outcome, Failure> {
    let (mut samples, mut scale) = (Vec::new(), 0.0);
    for &pressure in pressures {
        let mesh = ball(conditions.grid);
        let mut run = inflated(skin, Inflation::at(pressure), conditions)?;
        run.advance_to(0.5)?;
        let exact = exact_growth(skin.stiffness, |_| pressure, &mesh);
        samples.push(growth(&run, &mesh, pressure, exact));
        scale = exact;
    }
    Ok(Outcome { samples, scale })
}

pub(super) const BALLOON: Law = Law {
    name: "balloon",
    statement: "A balloon of 200 g/m² and k = 200 N/m grows by the factor l, 2k(l − 1) = p·R·l² (Laplace), and stays in its place",
    axes: ["pressure, Pa", "growth"],
    error: ErrorUnit::Of("the largest growth"),
    mesh: "edges from pole to equator",
    meshes: &[regular(6), regular(10), irregular(10), regular(16)],
    remark: "R is that of the polyhedron, three times its volume over its area. Faces do not grow quite evenly.",
    simulate: |conditions| {
        let skin = Skin {
            density: 0.2,
            stiffness: 200.0,
        };
        inflate_balloons(skin, &[20.0, 40.0], conditions)
    },
};

pub(super) const LIGHT_BALLOON: Law = Law {
    name: "light_balloon",
    statement: "A balloon of 20 g/m² and k = 2 kN/m grows by the factor l, 2k(l − 1) = p·R·l², and stays in its place",
    remark: "In a step of 1 ms the pressure would carry the free skin by 10 and 50 mm. The radius grows by 0.5 and 2.6 mm.",
    simulate: |conditions| inflate_balloons(LIGHT, &[200.0, 1000.0], conditions),
    ..BALLOON
};

pub(super) const FOIL_BALLOON: Law = Law {
    name: "foil_balloon",
    statement: "A balloon of foil, 30 g/m² and k = 100 kN/m, grows by the factor l, 2k(l − 1) = p·R·l², and stays in its place",
    remark: "Foil hardly grows: by 0.025 % at 500 Pa.",
    simulate: |conditions| inflate_balloons(FOIL, &[200.0, 500.0], conditions),
    ..BALLOON
};

pub(super) const LATEX_BALLOON: Law = Law {
    name: "latex_balloon",
    statement: "A balloon of latex, 230 g/m² and k = 375 N/m, grows by the factor l, 2k(l − 1) = p·R·l², and stays in its place",
    remark: "At 1 kPa it grows by 19 %. From 1.9 kPa on it would burst.",
    simulate: |conditions| inflate_balloons(LATEX, &[500.0, 1000.0], conditions),
    ..BALLOON
};

pub(super) const BALLOON_SPEED: Law = Law {
    name: "balloon_speed",
    statement: "Balloons of a light fabric (1 kPa), of foil (500 Pa) and of latex (1 kPa) are at rest after half a second",
    axes: ["mass, kg/m²", "root mean square of the speed, m/s"],
    error: ErrorUnit::In("m/s"),
    remark: "Nothing but the time stepping damps their motion.",
    simulate: |conditions| {
        let mut samples = Vec::new();
        for (skin, pressure) in [(LIGHT, 1000.0), (FOIL, 500.0), (LATEX, 1000.0)] {
            let mut run = inflated(skin, Inflation::at(pressure), conditions)?;
            run.advance_to(0.5)?;
            samples.push(Sample {
                at: skin.density,
                simulated: speed(&run),
                ..Sample::default()
            });
        }
        Ok(Outcome { samples, scale: 1.0 })
    },
    ..BALLOON
};

pub(super) const GAS: Law = Law {
    name: "gas",
    statement: "Gas of K = 10 kPa with room in r times a latex balloon has the pressure p = K(1 − l³/r), 2k(l − 1) = p·R·l²",
    axes: ["room of the gas over the balloon's at rest, r", "growth"],
    remark: "As the balloons.",
    simulate: |conditions| {
        let (mut samples, mut scale, modulus) = (Vec::new(), 0.0, 1e4);
        for room in [1.2, 1.5] {
            let gas = InternalPressure { volume: room, modulus };
            let mesh = ball(conditions.grid);
            let mut run = inflated(LATEX, gas, conditions)?;
            run.advance_to(0.5)?;
            let pressure = |l: f64| modulus * (1.0 - l.powi(3) / room);
            let exact = exact_growth(LATEX.stiffness, pressure, &mesh);
            samples.push(growth(&run, &mesh, room, exact));
            scale = exact;
        }
        Ok(Outcome { samples, scale })
    },
    ..BALLOON
};

pub(super) const PILLOW: Law = Law {
    name: "pillow",
    statement: "A strip that is held at two sides, flat at first, becomes an arc under pressure: T = p·R, 2R·asin(1/2R) = 1 + T/k",
    axes: ["pressure, Pa", "height of the middle, m"],
    error: ErrorUnit::Of("the largest height"),
    mesh: "cells between the sides",
    meshes: &[regular(16), irregular(16), regular(32)],
    remark: "The strip has 20 g/m² and k = 2 kN/m. The error of the chords falls with the square of their length.",
    simulate: |conditions| {
        let (mut samples, mut scale, stiffness) = (Vec::new(), 0.0, 2e3);
        for pressure in [50.0, 200.0, 800.0] {
            let mut scene = held_strip(LIGHT.density, stiffness, conditions.grid)?;
            scene.add(AirDrag { rate: 20.0 }).add(Inflation::at(pressure));
            let mut run = Run::new(scene, conditions)?;
            run.advance_to(1.5)?;
            let lack = |radius: f64| 1.0 + pressure * radius / stiffness - 2.0 * radius * (0.5 / radius).asin();
            let radius = root([0.500_001, 1e3], lack);
            let height = |x: f64| (radius * radius - (x - 0.5).powi(2)).sqrt() - (radius * radius - 0.25).sqrt();
            let middle = run.positions()[middle_of_strip(conditions.grid)];
            samples.push(Sample {
                at: pressure,
                exact: height(middle.x),
                simulated: middle.z,
                ..Sample::default()
            });
            scale = height(0.5);
        }
        Ok(Outcome { samples, scale })
    },
};

pub(super) const HALF_BALLOON: Law = Law {
    name: "half_balloon",
    statement: "Half a balloon pulls at the pins of its border with the pressure times the area in the border",
    axes: ["pressure, Pa", "sum of the pins' forces, N"],
    error: ErrorUnit::Of("the largest sum"),
    remark: "The skin is the light fabric. The area is that of the polygon of pins, so that the mesh has no error.",
    simulate: |conditions| {
        let whole = ball(conditions.grid);
        let upper = |triangle: &&[u32; 3]| triangle.iter().all(|&vertex| whole.positions[vertex as usize].z >= 0.0);
        let triangles: Vec<[u32; 3]> = whole.triangles.iter().filter(upper).copied().collect();
        let mesh = without_isolated(&whole.positions, triangles);
        let border = vertices_where(&mesh, |point| point.z == 0.0);
        let (mut samples, mut scale) = (Vec::new(), 0.0);
        for pressure in [200.0, 1000.0] {
            let mut scene = weightless(Cloth::from_mesh(mesh.clone(), DVec3::Z, LIGHT.density)?);
            membrane(&mut scene, LIGHT.stiffness);
            scene.add(Inflation::at(pressure)).add(pinned(border.clone()));
            let mut run = Run::new(scene, conditions)?;
            run.advance_to(0.5)?;
            scale = pressure * flat_area(&mesh);
            let load = run.pin_load(0, DVec3::ZERO).expect("the border is pinned");
            samples.push(Sample {
                at: pressure,
                exact: scale,
                simulated: load.force.z,
                ..Sample::default()
            });
        }
        Ok(Outcome { samples, scale })
    },
    ..BALLOON
};

fn without_isolated(positions: &[DVec3], mut triangles: Vec<[u32; 3]>) -> Mesh {
    let mut numbers = BTreeMap::new();
    let mut kept = Vec::new();
    for vertex in triangles.iter_mut().flatten() {
        let point = positions[*vertex as usize];
        *vertex = *numbers.entry(*vertex).or_insert_with(|| {
            kept.push(point);
            kept.len() as u32 - 1
        });
    }
    Mesh::new(kept, triangles)
}

/// Returns the area of a mesh as seen along z.
fn flat_area(mesh: &Mesh) -> f64 {
    let parts = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        0.5 * (b - a).cross(c - a).z
    });
    parts.sum()
}
