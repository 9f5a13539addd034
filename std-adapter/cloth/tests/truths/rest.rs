//! Cloth that lies on a body or is too near to it comes to rest at its thickness. Recovery gives it no speed.

use crate::{elastic, grid, jittered};
use selvedge_cloth::effects::{BodyContact, Friction, Gravity, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Scene, Simulation};

/// Makes a sheet of 0.3 m in so many cells, in the plane at this height.
fn sheet(height: f64, cells: u32) -> Cloth {
    let corner = DVec3::new(-0.15, -0.15, height);
    Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [cells; 2], 0.15).unwrap()
}

fn table() -> Body {
    Body::from_mesh("table", jittered(grid([2.0, 2.0], [20, 20]), [20, 20], 0.3))
}

fn contact(scene: &mut Scene, thickness: f64) {
    let thickness = Thickness::new(thickness);
    scene.add(BodyContact(thickness)).add(SelfCollision(thickness));
    scene.add(Friction { coefficient: 0.3 });
}

/// Returns the root mean square of the speeds of all cloth.
fn speed(simulation: &Simulation) -> f64 {
    let cloth = &simulation.velocities()[..simulation.cloth_vertices()];
    (cloth.iter().map(|v| v.length_squared()).sum::<f64>() / cloth.len() as f64).sqrt()
}

#[test]
fn cloth_that_starts_too_near_rises_to_its_thickness_and_no_higher_with_gravity_and_without() {
    let thickness = 5e-3;
    for has_gravity in [true, false] {
        let mut scene = Scene::new(sheet(1e-3, 6), 1e-3);
        scene.bodies.push(table());
        elastic(&mut scene, 400.0, 15e-6);
        contact(&mut scene, thickness);
        if has_gravity {
            scene.add(Gravity::default());
        }
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let mut highest = 0.0_f64;
        for _ in 0..1000 {
            simulation.step().unwrap();
            let cloth = &simulation.positions()[..simulation.cloth_vertices()];
            highest = cloth.iter().map(|p| p.z).fold(highest, f64::max);
        }
        let cloth = &simulation.positions()[..simulation.cloth_vertices()];
        let lowest = cloth.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        println!("gravity {has_gravity}: {lowest} to {highest} m, {} m/s", speed(&simulation));
        assert!(
            lowest > 0.99 * thickness && highest < 1.05 * thickness,
            "{lowest} to {highest}"
        );
        assert!(speed(&simulation) < 1e-4, "{}", speed(&simulation));
    }
}

#[test]
fn ten_layers_on_a_table_come_to_rest() {
    let thickness = 2e-3;
    let layer = |k: u32| sheet(1.1 * thickness * f64::from(k + 1), 6).named(&format!("layer {k}"));
    let mut scene = Scene::new(layer(0), 1e-3);
    scene.cloths.extend((1..10).map(layer));
    scene.bodies.push(table());
    elastic(&mut scene, 400.0, 15e-6);
    scene.add(Gravity::default());
    contact(&mut scene, thickness);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    (0..1000).for_each(|_| simulation.step().unwrap());
    let means = (0..10).map(|k| {
        let own = simulation.vertices_of_cloth(k).unwrap();
        let count = own.len() as f64;
        simulation.positions()[own].iter().map(|p| p.z).sum::<f64>() / count
    });
    for (k, height) in means.enumerate() {
        let expected = thickness * (k + 1) as f64;
        assert!(
            (height / expected - 1.0).abs() < 0.05,
            "layer {k} at {height} instead of {expected}"
        );
    }
    let fastest = (0..100).fold(0.0_f64, |fastest, _| {
        simulation.step().unwrap();
        fastest.max(speed(&simulation))
    });
    println!("{fastest} m/s");
    assert!(fastest < 1e-4, "{fastest} m/s");
}

#[test]
fn a_sheet_that_falls_flat_on_a_table_does_not_bounce() {
    let thickness = 2e-3;
    let mut scene = Scene::new(sheet(0.05, 6), 1e-3);
    scene.bodies.push(table());
    elastic(&mut scene, 400.0, 15e-6);
    scene.add(Gravity::default());
    contact(&mut scene, thickness);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let (mut fastest, mut highest) = (0.0_f64, 0.0_f64);
    // It lands after 0.0989 s with 0.97 m/s.
    for step in 1..=300 {
        simulation.step().unwrap();
        let cloth = 0..simulation.cloth_vertices();
        let up = cloth
            .clone()
            .map(|v| simulation.velocities()[v].z)
            .fold(f64::NEG_INFINITY, f64::max);
        if step < 95 {
            assert!(up < -0.9 * 9.81e-3 * f64::from(step), "step {step}: {up} m/s");
        } else if step > 105 {
            fastest = fastest.max(up);
            highest = cloth.map(|v| simulation.positions()[v].z).fold(highest, f64::max);
        }
    }
    println!("{fastest} m/s upward, {highest} m high");
    assert!(
        fastest < 1e-4 && highest < 1.0001 * thickness,
        "{fastest} m/s upward, {highest} m high"
    );
}
