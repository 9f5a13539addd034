//! Garments from code that intersect themselves or bodies, each at several depths.

use selvedge_cloth::effects::{Bend, BodyContact, SelfCollision, Shear, Stretch, Thickness};
use selvedge_cloth::glam::{DMat3, DVec2, DVec3};
use selvedge_cloth::{Body, Cloth, Mesh, Scene};
use std::f64::consts::{PI, TAU};

pub(crate) const NAMES: [&str; 14] = [
    "fold through itself",
    "corner through itself",
    "curls",
    "two layers, waves",
    "two layers, bumps",
    "two layers, one spike",
    "two sheets, tilted",
    "crumpled sheet",
    "sleeve bent through itself",
    "sleeve, walls exchanged",
    "pleats through each other",
    "sheet in a ball",
    "arm through its sleeve",
    "tube through a tube",
];

/// Makes a garment of [`NAMES`] with `cells` cells along its longer side; `depth` is about one.
pub(crate) fn garment(name: &str, cells: u32, depth: f64) -> Scene {
    let of_any_kind = sheet(name, cells, depth)
        .or_else(|| layers(name, cells, depth))
        .or_else(|| tubes(name, cells, depth));
    let mesh = of_any_kind.unwrap_or_else(|| panic!("no garment is named {name}"));
    let body = match name {
        "sheet in a ball" => Some(Body::ball("ball", DVec3::new(0.2, 0.2, -0.08 + 0.05 * depth), 0.1, 20)),
        "arm through its sleeve" => {
            let ends = [DVec3::new(-0.05, 0.0, 0.025 * depth), DVec3::new(0.45, 0.0, 0.01)];
            Some(Body::capsule("arm", ends, 0.035, 16))
        }
        _ => None,
    };
    let bodies: Vec<Body> = body.into_iter().map(Result::unwrap).collect();
    let mut scene = Scene::new(Cloth::from_mesh(mesh, DVec3::X, 0.2).unwrap(), 1e-3);
    let thickness = Thickness::new(2e-3);
    scene.add(Stretch::isotropic(200.0)).add(Shear::new(50.0));
    scene.add(Bend::isotropic(1e-5)).add(SelfCollision(thickness));
    if !bodies.is_empty() {
        scene.add(BodyContact(thickness));
    }
    scene.bodies = bodies;
    name.clone_into(&mut scene.name);
    scene
}

/// Makes the mesh of a garment of one sheet.
fn sheet(name: &str, n: u32, depth: f64) -> Option<Mesh> {
    let mesh = match name {
        "fold through itself" => grid([n, n], |u, v| {
            let flap = bent(0.4 * u - 0.2, 0.012, PI + 0.25 * depth);
            DVec3::new(flap.x, 0.4 * v, flap.y)
        }),
        "corner through itself" => grid([n, n], |u, v| {
            let (along, across) = (0.3 * (u + v) - 0.36, 0.3 * (u - v));
            let flap = bent(along, 0.01, PI + 0.15 * depth);
            DVec3::new(flap.x, across, flap.y)
        }),
        "curls" => grid([n, n], |u, v| {
            let t = TAU * (2.0 * u - 1.0);
            DVec3::new(
                0.02 * t - 0.022 * (1.0 + 0.3 * depth) * t.sin(),
                0.4 * v,
                -0.022 * (1.0 + 0.3 * depth) * t.cos(),
            )
        }),
        "crumpled sheet" => {
            let mut random = Random(11);
            let waves: Vec<_> = (0..12)
                .map(|_| (random.vector() * 9.0, random.vector() * 0.03 * depth, random.next() * TAU))
                .collect();
            grid([n, n], move |u, v| {
                let flat = DVec3::new(u, v, 0.0);
                let pushed = waves
                    .iter()
                    .map(|(along, way, phase)| *way * (along.dot(flat) * 1.6 + phase).sin());
                flat * 0.4 + pushed.sum::<DVec3>()
            })
        }
        "pleats through each other" => grid([2 * n, n / 2], |u, v| {
            let phase = TAU * 5.0 * u;
            let back = 0.011 * (1.0 + 0.6 * depth) * (2.0 * phase).sin();
            DVec3::new(0.3 * u + back, 0.02 * phase.sin() + 0.004 * v, 0.2 * v)
        }),
        "sheet in a ball" => grid([n, n], |u, v| DVec3::new(0.4 * u, 0.4 * v, 0.0)),
        _ => return None,
    };
    Some(mesh)
}

/// Makes the mesh of a garment of two layers, or two sheets.
fn layers(name: &str, n: u32, depth: f64) -> Option<Mesh> {
    let mesh = match name {
        "two layers, waves" => two_layers(
            n,
            |u, v| 0.004 * depth * (TAU * 2.0 * u).sin() * (TAU * 1.5 * v).sin(),
            0.0025,
        ),
        "two layers, bumps" => {
            let mut random = Random(7);
            let bumps: Vec<_> = (0..9).map(|_| [random.next(), random.next(), 0.5 + random.next()]).collect();
            let height = move |u: f64, v: f64| {
                let bump = |[x, y, z]: &[f64; 3]| 0.012 * depth * z * (-((u - x).powi(2) + (v - y).powi(2)) / 0.006).exp();
                bumps.iter().map(bump).sum()
            };
            two_layers(n, height, 0.004)
        }
        "two layers, one spike" => {
            let height = |u: f64, v: f64| 0.06 * depth * (-((u - 0.52).powi(2) + (v - 0.47).powi(2)) / 0.004).exp();
            two_layers(n, height, 0.006)
        }
        "two sheets, tilted" => two_layers(n, |u, _| 0.12 * depth * (u - 0.3), 0.0),
        _ => return None,
    };
    Some(mesh)
}

/// Makes the mesh of a garment of tubes.
fn tubes(name: &str, n: u32, depth: f64) -> Option<Mesh> {
    let mesh = match name {
        "sleeve bent through itself" => tube([n * 2 / 3, n], |angle, t| {
            let radius = 0.05;
            let middle = bent(0.5 * t - 0.25, 0.045 / depth, 2.3);
            let next = bent(0.5 * t - 0.25 + 1e-4, 0.045 / depth, 2.3);
            let along = (next - middle).normalize();
            let outward = DVec2::new(-along.y, along.x);
            let flat = middle + outward * (radius * angle.cos());
            DVec3::new(flat.x, radius * angle.sin(), flat.y)
        }),
        "sleeve, walls exchanged" => tube([n * 2 / 3, n], |angle, t| {
            let pinch = 1.0 - (1.0 + 0.15 * depth) * (-((t - 0.5) / 0.12).powi(2)).exp();
            DVec3::new(0.4 * t, 0.05 * angle.cos(), 0.05 * pinch * angle.sin())
        }),
        "arm through its sleeve" => tube([n * 2 / 3, n], |angle, t| {
            DVec3::new(0.4 * t, 0.05 * angle.cos(), 0.05 * angle.sin())
        }),
        "tube through a tube" => {
            let turned = |p: DVec3| DMat3::from_rotation_y(1.3) * p + DVec3::new(0.2, 0.05 - 0.03 * depth, 0.0);
            let one = tube([n / 2, n], |angle, t| {
                DVec3::new(0.4 * t, 0.05 * angle.cos(), 0.05 * angle.sin())
            });
            let other = tube([n / 2, n], |angle, t| {
                turned(DVec3::new(0.4 * t - 0.2, 0.03 * angle.cos() + 0.05, 0.03 * angle.sin()))
            });
            joined([one, other])
        }
        _ => return None,
    };
    Some(mesh)
}

/// Returns a point of a line that is bent by `angle` in an arc of this radius. `way` is its distance from the start of the arc.
fn bent(way: f64, radius: f64, angle: f64) -> DVec2 {
    let turned = (way / radius).clamp(0.0, angle);
    let on_arc = DVec2::new(radius * turned.sin(), radius * (1.0 - turned.cos()));
    let beyond = (way - angle * radius).max(0.0) * DVec2::new(angle.cos(), angle.sin());
    on_arc + beyond + DVec2::X * way.min(0.0)
}

/// Makes a grid over [0, 1]² with alternating diagonals.
fn grid([across, along]: [u32; 2], point: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let at = |i: u32, j: u32| i * (along + 1) + j;
    let points = (0..=across).flat_map(|i| (0..=along).map(move |j| (i, j)));
    let positions = points.map(|(i, j)| point(f64::from(i) / f64::from(across), f64::from(j) / f64::from(along)));
    let cells = (0..across).flat_map(|i| (0..along).map(move |j| (i, j)));
    let triangles = cells.flat_map(|(i, j)| cell([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], i + j));
    Mesh::new(positions.collect(), triangles.collect())
}

fn cell([a, b, c, d]: [u32; 4], parity: u32) -> [[u32; 3]; 2] {
    match parity % 2 {
        0 => [[a, b, c], [a, c, d]],
        _ => [[a, b, d], [b, c, d]],
    }
}

/// Makes rings of points. `point` gets an angle and a share of the length.
fn tube([around, along]: [u32; 2], point: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let at = |i: u32, j: u32| j * around + i % around;
    let points = (0..=along).flat_map(|j| (0..around).map(move |i| (i, j)));
    let positions = points.map(|(i, j)| {
        point(
            TAU * (f64::from(i) + 0.5 * f64::from(j % 2)) / f64::from(around),
            f64::from(j) / f64::from(along),
        )
    });
    let cells = (0..along).flat_map(|j| (0..around).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        cell(corners, j)
    });
    Mesh::new(positions.collect(), triangles.collect())
}

/// Makes two sheets: a lower one with this height, and a flat one at the height `gap`.
fn two_layers(n: u32, height: impl Fn(f64, f64) -> f64, gap: f64) -> Mesh {
    let lower = grid([n, n], |u, v| DVec3::new(0.4 * u, 0.4 * v, height(u, v)));
    let upper = grid([n - 1, n + 1], |u, v| DVec3::new(0.01 + 0.38 * u, 0.4 * v - 0.003, gap));
    joined([lower, upper])
}

fn joined(meshes: [Mesh; 2]) -> Mesh {
    let [mut one, other] = meshes;
    let first = one.positions.len() as u32;
    one.positions.extend(other.positions);
    one.triangles
        .extend(other.triangles.iter().map(|t| t.map(|vertex| first + vertex)));
    one
}

struct Random(u64);

impl Random {
    /// Returns a number in [0, 1).
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / f64::from(1 << 24)
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}
