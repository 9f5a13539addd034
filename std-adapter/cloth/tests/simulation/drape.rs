//! Cusick's drape test measures one number of a fabric that laboratories publish.

use crate::common::*;
use std::fmt::Write;

const SPECIMEN: f64 = 0.15;
const DISC: f64 = 0.09;

/// Returns the share of the ring around the disc that the cloth's shadow covers. The shadow is taken to be star-shaped: in each
/// direction it reaches the farthest point of an edge.
fn coefficient(positions: &[selvedge::glam::DVec3], triangles: &[[u32; 3]]) -> f64 {
    const DIRECTIONS: usize = 360;
    let mut farthest = [0.0_f64; DIRECTIONS];
    for triangle in triangles {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [from, to].map(|k| positions[triangle[k] as usize]);
            for step in 0..=10 {
                let point = from.lerp(to, f64::from(step) / 10.0);
                let share = (point.y.atan2(point.x) / TAU).rem_euclid(1.0);
                let direction = (share * DIRECTIONS as f64) as usize % DIRECTIONS;
                farthest[direction] = farthest[direction].max(point.x.hypot(point.y));
            }
        }
    }
    let shadow: f64 = farthest.iter().map(|radius| radius * radius).sum::<f64>() * PI / DIRECTIONS as f64;
    let [all, disc] = [SPECIMEN, DISC].map(|radius| PI * radius * radius);
    (shadow - disc) / (all - disc)
}

fn specimen(rings: u32) -> String {
    let mut text = String::from("v 0 0 0\n");
    let first = |ring: u32| if ring == 0 { 1 } else { 2 + 3 * ring * (ring - 1) };
    for ring in 1..=rings {
        for k in 0..6 * ring {
            let angle = TAU * f64::from(k) / f64::from(6 * ring);
            let radius = SPECIMEN * f64::from(ring) / f64::from(rings);
            writeln!(text, "v {} {} 0", radius * angle.cos(), radius * angle.sin()).unwrap();
        }
    }
    for ring in 1..=rings {
        for (side, k) in (0..6).flat_map(|side| (0..ring).map(move |k| (side, k))) {
            let outer = |k: u32| first(ring) + (side * ring + k) % (6 * ring);
            let inner = |k: u32| match ring {
                1 => 1,
                _ => first(ring - 1) + (side * (ring - 1) + k) % (6 * (ring - 1)),
            };
            writeln!(text, "f {} {} {}", outer(k), outer(k + 1), inner(k)).unwrap();
            if k + 1 < ring {
                writeln!(text, "f {} {} {}", inner(k), outer(k + 1), inner(k + 1)).unwrap();
            }
        }
    }
    text
}

fn cotton() -> String {
    std::fs::read_to_string(scene_file("drape-cotton.toml")).unwrap()
}

/// Returns the scene of `cotton` with a named material instead of numbers.
pub(crate) fn of_material(name: &str) -> String {
    let text = cotton();
    let (before, rest) = text.split_once("[effects.stretch]").unwrap();
    let (_, after) = rest.split_once("[effects.self_collision]").unwrap();
    let before = before.replace("density = \"150 g/m2\"", &format!("material = \"{name}\""));
    format!("{before}[effects.self_collision]{after}")
}

/// Returns the coefficient at the end of a scene, for a specimen of `rings` rings and a time step in milliseconds.
pub(crate) fn drape(text: &str, rings: u32, time_step: f64) -> f64 {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let name = format!("drape-{rings}.obj");
    std::fs::write(folder.join(&name), specimen(rings)).unwrap();
    let text = text.replace("drape-specimen.obj", &name);
    let text = text.replace("time_step = \"1 ms\"", &format!("time_step = \"{time_step} ms\""));
    let scene = Scene::parse(&text, &folder.join("drape.toml")).unwrap();
    let steps = scene.steps();
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let cloth = simulation.triangles()[..simulation.cloth_triangles()].to_vec();
    let flat = coefficient(simulation.positions(), &cloth);
    assert!((0.98..1.0001).contains(&flat), "{flat}");
    let mut last = 0.0;
    for step in 1..=steps {
        simulation.step().unwrap();
        if 6 * step == 5 * steps {
            last = coefficient(simulation.positions(), &cloth);
        }
    }
    let found = coefficient(simulation.positions(), &cloth);
    assert!(
        (found - last).abs() < 0.02,
        "at rest but for slow creeping: {last} and {found}"
    );
    found
}

#[test]
fn cotton_drapes_as_laboratories_say_at_three_resolutions_and_two_time_steps() {
    let found = [(15, 1.0), (20, 1.0), (30, 1.0), (15, 0.5), (20, 0.5)].map(|(rings, step)| drape(&cotton(), rings, step));
    assert!(found.iter().all(|found| (0.60..=0.76).contains(found)), "{found:?}");
    let [least, most] = [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| found.into_iter().reduce(of).unwrap());
    assert!(most - least < 0.05, "{found:?}");
}
