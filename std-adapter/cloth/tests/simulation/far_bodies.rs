//! Bodies that are far from the cloth change no bit of its motion, whatever their speed and mesh.

use crate::common::*;

/// A sheet that falls on a ball that sinks.
fn falling(thickness: f64) -> Scene {
    let sides = [0.5 * DVec3::X, 0.5 * DVec3::Y];
    let cloth = Cloth::sheet(DVec3::new(-0.25, -0.25, 0.16), sides, [12, 12], 0.15).unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    let mut ball = Body::ball("ball", DVec3::new(0.03, 0.02, 0.0), 0.12, 16).unwrap();
    ball.motion = along([(0.0, DVec3::ZERO), (0.2, DVec3::ZERO), (0.5, -0.1 * DVec3::Z)]);
    scene.bodies.push(ball);
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(400.0))
        .add(Shear::new(80.0));
    scene.add(Bend::isotropic(15e-6)).add(Friction { coefficient: 0.3 });
    scene.add(StrainLimit::at(1.08));
    let thickness = Thickness::new(thickness);
    scene.add(BodyContact(thickness)).add(SelfCollision(thickness));
    scene
}

/// Returns a rod of 20 cm, 5 m away, that turns by so many radians in a second.
fn rod(speed: f64) -> Body {
    let centre = 5.0 * DVec3::X;
    let mut rod = Body::capsule("rod", [centre - 0.1 * DVec3::Y, centre + 0.1 * DVec3::Y], 0.02, 8).unwrap();
    let key = |time| Keyframe {
        time,
        angle: speed * time,
        ..Keyframe::default()
    };
    rod.motion = KeyframeMotion::new(centre, DVec3::Z, vec![key(0.0), key(1.0)])
        .unwrap()
        .into();
    rod
}

#[test]
fn far_bodies_change_no_bit() {
    compare_with_and_without_far_bodies(3e-3);
}

#[test]
fn far_bodies_change_no_bit_of_cloth_with_many_neighbours() {
    compare_with_and_without_far_bodies(30e-3);
}

fn compare_with_and_without_far_bodies(thickness: f64) {
    let grid = Body::from_mesh("ground", folded(60, 0..120, -700.0));
    let cases = [
        vec![],
        vec![rod(0.0)],
        vec![rod(5.0)],
        vec![rod(300.0)],
        vec![grid.clone()],
        vec![rod(50.0), grid],
    ];
    let mut runs = cases.map(|bodies| {
        let mut scene = falling(thickness);
        scene.bodies.extend(bodies);
        Simulation::new(scene, 1).unwrap()
    });
    for step in 1..=300 {
        let [alone, others @ ..] = &mut runs;
        alone.step().unwrap();
        let count = alone.cloth_vertices();
        for (case, other) in (1..).zip(others) {
            other.step().unwrap();
            let is_same = other.positions()[..count] == alone.positions()[..count];
            assert!(is_same, "case {case}, step {step}");
        }
    }
    assert!(runs[0].contact_counts().unwrap().pushed > 0);
}
