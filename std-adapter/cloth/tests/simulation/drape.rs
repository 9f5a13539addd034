//! Cusick's drape test: one number of a fabric that laboratories publish.

use crate::{load, scene_file};
use selvedge_cloth::Scene;
use std::f64::consts::{PI, TAU};

const SPECIMEN: f64 = 0.15;
const DISC: f64 = 0.09;

/// The share of the ring around the disc that the cloth's shadow covers. The shadow is taken to be star-shaped: in each direction
/// all up to the farthest point of an edge.
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

#[test]
fn cotton_drapes_as_laboratories_say() {
    let scene = Scene::read(&scene_file("drape-cotton.toml")).unwrap();
    let steps = scene.steps();
    let mut simulation = load("drape-cotton.toml", |text| text, 1);
    let cloth = simulation.triangles()[..simulation.cloth_triangles()].to_vec();
    let flat = coefficient(simulation.positions(), &cloth);
    assert!((0.98..1.0001).contains(&flat), "{flat}");
    let mut last = 0.0;
    for step in 1..=steps {
        simulation.step().unwrap();
        if step == steps - 500 {
            last = coefficient(simulation.positions(), &cloth);
        }
    }
    let found = coefficient(simulation.positions(), &cloth);
    assert!((0.60..=0.76).contains(&found), "{found}");
    // At rest but for slow creeping.
    assert!((found - last).abs() < 0.02, "{last} and {found}");
}
