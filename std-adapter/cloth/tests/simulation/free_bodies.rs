//! Free bodies in whole scenes: every state is free by the exact test, and what lies still stays still.

use crate::common::*;

const THICKNESS: f64 = 2e-3;

/// A ball with its centre at the origin, a mass in kg and a radius in m.
fn ball(name: &str, centre: DVec3, radius: f64, mass: f64) -> Body {
    let mut body = Body::ball(name, centre, radius, 12).unwrap();
    body.motion = FreeMotion::new(BodyMass::Mass(mass)).into();
    body
}

/// A sheet that is held at its border.
fn hammock(side: f64, cells: u32) -> Scene {
    let corner = DVec3::new(-0.5 * side, -0.5 * side, 0.0);
    let cloth = Cloth::sheet(corner, [DVec3::X * side, DVec3::Y * side], [cells; 2], 0.2).unwrap();
    let edge = |point: &DVec3| point.x.abs().max(point.y.abs()) > 0.4999 * side;
    let vertices = cloth.mesh().positions.iter().zip(0..);
    let border: Vec<u32> = vertices.filter(|(point, _)| edge(point)).map(|(_, vertex)| vertex).collect();
    let mut scene = Scene::new(cloth, 4e-3);
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(500.0))
        .add(Shear::new(100.0))
        .add(Bend::isotropic(1e-4))
        .add(Friction { coefficient: 0.4 })
        .add(BodyContact(Thickness::new(THICKNESS)))
        .add(SelfCollision(Thickness::new(THICKNESS)))
        .add(Pins {
            groups: vec![PinGroup::resting(border)],
        });
    scene
}

#[test]
fn twenty_balls_in_a_sack_are_free_in_every_state_and_come_to_rest() {
    let mut scene = hammock(0.5, 16);
    for k in 0..20_u32 {
        let [column, row, layer] = [k % 3, k / 3 % 3, k / 9].map(f64::from);
        // Not quite above each other.
        let place = DVec3::new(column - 1.0 + 0.05 * layer, row - 1.0 - 0.03 * layer, layer) * 0.075;
        scene
            .bodies
            .push(ball(&format!("ball {k}"), place + DVec3::Z * 0.05, 0.03, 0.05));
    }
    let mut simulation = Simulation::new(scene, 2).unwrap();
    for step in 0..2500 {
        simulation.step().unwrap();
        if step % 5 == 0 {
            assert_eq!(intersections(&simulation), [], "step {step}");
        }
        if std::env::var("TT").is_ok() && step % 125 == 0 {
            let speeds: Vec<f64> = (0..20)
                .map(|body| simulation.body_motion(body).unwrap().velocity.length())
                .collect();
            println!(
                "{step} fastest {:e} {:?}",
                speeds.iter().copied().fold(0.0, f64::max),
                simulation.solve_counts()
            );
        }
    }
    assert!(simulation.is_certified());
    for body in 0..20 {
        let motion = simulation.body_motion(body).unwrap();
        assert!(motion.velocity.length() < 1e-3, "ball {body}: {}", motion.velocity);
    }
}

#[test]
fn locked_axes_have_names_in_scene_files_and_other_names_are_refused_with_the_right_ones() {
    let scene = |locked: &str| {
        let text = format!(
            "time_step = \"4 ms\"\nduration = \"0.2 s\"\n[cloth]\nshape = \"sheet\"\ncorner = [0, 0, 5]\n\
             sides = {{ first = [1, 0, 0], second = [0, 1, 0] }}\ncells = [2, 2]\ndensity = \"100 g/m2\"\n\
             [[body]]\nname = \"weight\"\nshape = \"ball\"\ncentre = [0, 0, 0]\nradius = \"5 cm\"\nmass = \"1 kg\"\n\
             velocity = [1, 2, 3]\nspin = [0, 0, \"1 rad/s\"]\nlocked = {locked}\n[effects.gravity]\n[effects.stretch]\nstiffness = \"100 N/m\"\n"
        );
        Scene::parse(&text, Path::new("scene.toml"))
    };
    let mut simulation = Simulation::new(scene("[\"x\", \"z\", \"rotation_z\"]").unwrap(), 1).unwrap();
    advance(&mut simulation, 50);
    let motion = simulation.body_motion(0).unwrap();
    assert!(
        motion.velocity.distance(DVec3::Y * 2.0) < 1e-12 && motion.spin == DVec3::ZERO,
        "{motion:?}"
    );
    assert!((motion.centre - DVec3::Y * 0.4).length() < 1e-9, "{}", motion.centre);
    for wrong in ["[\"rotation-z\"]", "\"x\"", "[1]"] {
        let error = scene(wrong).unwrap_err().to_string();
        assert!(error.contains("`locked`") && error.contains("rotation_z"), "{error}");
    }
}

#[test]
fn what_cannot_hold_on_to_a_free_body_is_refused_with_the_remedy() {
    let error = |scene: Scene| Simulation::new(scene, 1).map(drop).unwrap_err().to_string();
    let with = |add: &dyn Fn(&mut Scene)| {
        let corner = DVec3::new(-0.1, -0.1, 0.0);
        let cloth = Cloth::sheet(corner, [DVec3::X * 0.2, DVec3::Y * 0.2], [4; 2], 0.2).unwrap();
        let mut scene = Scene::new(cloth, 4e-3);
        scene.add(Stretch::isotropic(500.0));
        scene.bodies.push(ball("weight", DVec3::Z * -0.1, 0.03, 0.05));
        add(&mut scene);
        error(scene)
    };
    let soft = with(&|scene| {
        let group = PinGroup {
            stiffness: Some(10.0),
            ..PinGroup::new(vec![0], PinMotion::Body(0))
        };
        scene.add(Pins { groups: vec![group] });
    });
    assert!(soft.contains("'weight'") && soft.contains("leave out `stiffness`"), "{soft}");
    let attached = with(&|scene| {
        let group = AttachmentGroup {
            motion: PinMotion::Body(0),
            ..AttachmentGroup::resting([0], 1.0)
        };
        scene.add(Attachments { groups: vec![group] });
    });
    assert!(
        attached.contains("'weight'") && attached.contains("pin the vertices to it"),
        "{attached}"
    );
}
