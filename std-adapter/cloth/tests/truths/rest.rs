//! Cloth that lies on a body, is too near to it, or is squeezed comes to rest at its thickness. Recovery gives it no speed.

use crate::{elastic, grid, jittered};
use selvedge_cloth::effects::{AirDrag, BodyContact, Friction, Gravity, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, BodyMotion, Cloth, Keyframe, KeyframeMotion, Mesh, OnBlocked, Scene, Simulation};

/// Makes a sheet of 0.3 m in so many cells, in the plane at this height.
fn sheet(height: f64, cells: u32) -> Cloth {
    let corner = DVec3::new(-0.15, -0.15, height);
    Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [cells; 2], 0.15).unwrap()
}

fn table() -> Body {
    Body::from_mesh("table", jittered(grid([2.0, 2.0], [20, 20]), [20, 20], 0.3))
}

fn contact(scene: &mut Scene, thickness: f64, friction: f64) {
    let thickness = Thickness::new(thickness);
    scene.add(BodyContact(thickness)).add(SelfCollision(thickness));
    if friction > 0.0 {
        scene.add(Friction { coefficient: friction });
    }
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
        contact(&mut scene, thickness, 0.3);
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
    contact(&mut scene, thickness, 0.3);
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
    contact(&mut scene, thickness, 0.3);
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

/// Makes a box with these corners.
fn cuboid(low: DVec3, high: DVec3) -> Mesh {
    let corner = |k: u32| {
        DVec3::select(
            selvedge_cloth::glam::BVec3::new(k & 4 != 0, k & 2 != 0, k & 1 != 0),
            high,
            low,
        )
    };
    let triangles = [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ];
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: triangles.into(),
    }
}

/// Makes a sheet whose upper edge hangs between two pads, which leave less room than its thickness on both sides.
fn pinched(friction: f64) -> Simulation {
    let cloth = Cloth::sheet(
        DVec3::new(-0.15, 0.0, -0.27),
        [0.3 * DVec3::X, 0.3 * DVec3::Z],
        [20, 20],
        0.15,
    )
    .unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    scene.on_blocked = OnBlocked::Hold;
    for (name, side) in [("left", -1.0), ("right", 1.0)] {
        let mut pad = Body::from_mesh(name, cuboid(DVec3::new(-0.5, -0.01, -0.03), DVec3::new(0.5, 0.01, 0.06)));
        let key = |time, half: f64| Keyframe {
            time,
            angle: 0.0,
            translation: DVec3::Y * (side * (half + 0.01)),
        };
        pad.motion =
            BodyMotion::Keyframes(KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![key(0.0, 4e-3), key(0.02, 2e-3)]).unwrap());
        scene.bodies.push(pad);
    }
    scene.add(Gravity::default()).add(AirDrag { rate: 1.0 });
    elastic(&mut scene, 400.0, 15e-6);
    contact(&mut scene, 3e-3, friction);
    Simulation::new(scene, 1).unwrap()
}

#[test]
fn squeezed_cloth_is_held_by_friction_in_the_middle() {
    let mut simulation = pinched(0.5);
    let held: Vec<usize> = (0..simulation.cloth_vertices())
        .filter(|&v| simulation.positions()[v].z > -0.02)
        .collect();
    let start = simulation.positions().to_vec();
    (0..2500).for_each(|_| simulation.step().unwrap());
    let count = held.len() as f64;
    let speed = (held.iter().map(|&v| simulation.velocities()[v].length_squared()).sum::<f64>() / count).sqrt();
    let slipped = held
        .iter()
        .map(|&v| (simulation.positions()[v].z - start[v].z).abs())
        .fold(0.0, f64::max);
    let aside = held.iter().map(|&v| simulation.positions()[v].y.abs()).fold(0.0, f64::max);
    println!("{speed} m/s, slipped {slipped} m, {aside} m aside");
    // It slips a little while the pads close.
    assert!(speed < 1e-4, "{speed} m/s");
    assert!(slipped < 1e-3 && aside < 1e-4, "{slipped} m, {aside} m aside");
}

#[test]
fn squeezed_cloth_falls_freely_without_friction() {
    let mut simulation = pinched(0.0);
    let cloth = 0..simulation.cloth_vertices();
    let mean = |of: &[DVec3]| of[cloth.clone()].iter().map(|v| v.z).sum::<f64>() / cloth.len() as f64;
    // Semi-implicit steps that lose a share of the velocity fall in this way.
    let (mut velocity, mut expected, mut start) = (0.0, 0.0, 0.0);
    for step in 1..=250 {
        simulation.step().unwrap();
        velocity = (velocity - 9.81e-3) * (-1e-3_f64).exp();
        expected += velocity * 1e-3;
        if step == 50 {
            // The pads have closed, and their rims have pushed the cloth out a little.
            let pushed = mean(simulation.velocities()) - velocity;
            assert!(pushed.abs() < 0.06, "{pushed} m/s");
            (velocity, expected, start) = (velocity + pushed, 0.0, mean(simulation.positions()));
        }
    }
    let fallen = mean(simulation.positions()) - start;
    println!("{fallen} m for {expected}");
    assert!((fallen / expected - 1.0).abs() < 0.01, "{fallen} for {expected}");
}
