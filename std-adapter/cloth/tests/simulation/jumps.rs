//! Bodies and pins that the caller moves: not too fast, and elsewhere at once.

use crate::common::*;
use selvedge_cloth::glam::DQuat;

/// A sheet that hangs on a driven ball by the middle of its upper edge, and hangs beside it.
fn cape() -> Scene {
    let sides = [0.2 * DVec3::X, 0.2 * DVec3::Z];
    let cloth = Cloth::sheet(DVec3::new(-0.1, 0.11, -0.2), sides, [8, 8], 0.2).unwrap();
    let mut scene = Scene::new(cloth, 2e-3);
    let mut ball = Body::ball("ball", DVec3::ZERO, 0.1, 16).unwrap();
    ball.motion = BodyMotion::Driven(Placement::default());
    scene.bodies.push(ball);
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(400.0))
        .add(Shear::new(100.0));
    scene
        .add(BodyContact(Thickness::new(3e-3)))
        .add(SelfCollision(Thickness::new(3e-3)));
    scene.add(Friction { coefficient: 0.3 });
    scene.add(pinned([75, 76, 77], PinMotion::Body(0)));
    scene
}

fn swinging(scene: Scene) -> Simulation {
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for step in 1..=100 {
        simulation
            .place_body(0, Placement::at(DVec3::X * 1e-3 * f64::from(step)))
            .unwrap();
        simulation.step().unwrap();
    }
    simulation
}

#[test]
fn a_body_that_is_moved_too_fast_is_an_error_before_anything_moves() {
    for on_blocked in [OnBlocked::Stop, OnBlocked::Hold, OnBlocked::Yield] {
        let mut scene = cape();
        scene.on_blocked = on_blocked;
        let mut simulation = swinging(scene);
        let before = simulation.positions().to_vec();
        let placement = simulation.placement(0).unwrap();
        simulation.place_body(0, Placement::at(50.0 * DVec3::X)).unwrap();
        let blocked = simulation.advance(1.0 / 60.0).unwrap_err().to_string();
        let expected =
            "the body 'ball' is to move at 2994 m/s at 0.200000 s, but must not be faster than 100 m/s; `teleport` moves it";
        assert!(blocked.starts_with(expected), "{blocked}");
        assert_eq!(
            (simulation.positions(), simulation.placement(0)),
            (&before[..], Some(placement))
        );
        // The goal is dropped.
        simulation.step().unwrap();
        assert!(simulation.velocities().iter().all(|velocity| velocity.length() < 10.0));
    }
}

#[test]
fn vertices_and_pins_that_are_moved_too_fast_are_errors_with_their_names() {
    let mut simulation = swinging(cape());
    let far: Vec<DVec3> = simulation.positions()[81..]
        .iter()
        .map(|position| *position + DVec3::X)
        .collect();
    simulation.move_body(0, &far).unwrap();
    let blocked = simulation.step().unwrap_err();
    assert_eq!(
        (blocked.body.as_deref(), blocked.speed.map(f64::round)),
        (Some("ball"), Some(500.0))
    );
    let mut scene = cape();
    scene.add(pinned([0], PinMotion::Own(BodyMotion::Driven(Placement::default()))));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    simulation.move_pins(0, &[DVec3::splat(1.0)]).unwrap();
    let blocked = simulation.step().unwrap_err().to_string();
    assert!(blocked.starts_with("the group 0 of pins is to move at "), "{blocked}");
    // A vertex that follows a body far away is as fast as the body turns it.
    let mut scene = cape();
    scene.bodies[0].motion = BodyMotion::Driven(Placement::at(40.0 * DVec3::Y));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let turned = Placement::new(DQuat::from_rotation_z(0.1), 40.0 * DVec3::Y);
    simulation.place_body(0, turned).unwrap();
    assert!(simulation.step().unwrap_err().speed.is_some_and(|speed| speed > 1000.0));
}

#[test]
fn a_teleport_moves_body_pins_and_cloth_and_they_go_on_as_if_nothing_had_happened() {
    let [mut simulation, mut stays] = [0, 1].map(|_| {
        let mut scene = cape();
        // Without gravity the world looks alike everywhere.
        scene.add(Gravity {
            acceleration: DVec3::ZERO,
        });
        swinging(scene)
    });
    let (before, velocities) = (simulation.positions().to_vec(), simulation.velocities().to_vec());
    let by = Placement::new(DQuat::from_rotation_y(2.0), DVec3::new(30.0, -4.0, 2.0));
    simulation.teleport(&[0], &[], by).unwrap();
    let turned = |vector: DVec3| by.rotation * vector;
    for (now, before) in simulation.positions().iter().zip(&before) {
        assert!(now.distance(by.apply(*before)) < 1e-13);
    }
    for (now, before) in simulation.velocities().iter().zip(&velocities) {
        assert!(now.distance(turned(*before)) < 1e-13);
    }
    let placement = simulation.placement(0).unwrap();
    assert!(placement.translation.distance(by.apply(0.1 * DVec3::X)) < 1e-13);
    assert!(simulation.is_certified());
    // It swings on there as it would here.
    for _ in 0..50 {
        simulation.step().unwrap();
        stays.step().unwrap();
    }
    for (there, here) in simulation.positions().iter().zip(stays.positions()) {
        let off = there.distance(by.apply(*here));
        assert!(off < 1e-4, "{off} m off");
    }
    assert!(simulation.is_certified() && simulation.edge_stretch().largest < 1.2);
}

#[test]
fn a_teleport_takes_attached_cloth_and_named_cloths_along_and_leaves_the_others() {
    let mut scene = cape();
    let sheet = |x: f64| Cloth::sheet(DVec3::new(x, 1.0, 0.0), [0.2 * DVec3::X, 0.2 * DVec3::Y], [2, 2], 0.2).unwrap();
    for (name, x) in [("worn", 1.0), ("other", 2.0)] {
        let mut cloth = sheet(x);
        name.clone_into(&mut cloth.name);
        scene.cloths.push(cloth);
    }
    let mut held = AttachmentGroup::resting([0, 1], 5.0);
    held.motion = PinMotion::Body(0);
    let mut simulation = {
        scene
            .add(pinned([4], PinMotion::Body(0)))
            .add(Attachments { groups: vec![held] });
        Simulation::new(scene, 1).unwrap()
    };
    let x_of =
        |simulation: &Simulation, cloth: usize| simulation.positions()[simulation.vertices_of_cloth(cloth).unwrap().start].x;
    let before = [0, 1, 2].map(|cloth| x_of(&simulation, cloth));
    simulation.teleport(&[0], &[1], Placement::at(10.0 * DVec3::X)).unwrap();
    let ways: Vec<f64> = (0..3)
        .map(|cloth| (x_of(&simulation, cloth) - before[cloth]).round())
        .collect();
    assert_eq!(ways, [10.0, 10.0, 0.0]);
    simulation.step().unwrap();
    assert_eq!(simulation.released(), []);
}

#[test]
fn a_teleport_that_cannot_be_is_an_error_and_changes_nothing() {
    let mut scene = cape();
    let mut wall = Body::ball("wall", DVec3::new(5.0, 0.0, 0.0), 0.2, 16).unwrap();
    wall.motion = KeyframeMotion::resting().into();
    scene.bodies.push(wall);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let before = simulation.positions().to_vec();
    let mut message = |bodies: &[usize], cloths: &[usize], x: f64| {
        let error = simulation
            .teleport(bodies, cloths, Placement::at(DVec3::X * x))
            .unwrap_err()
            .to_string();
        assert_eq!(simulation.positions(), before);
        error
    };
    assert!(message(&[0], &[], 5.0).starts_with("there is no room: "));
    assert_eq!(
        message(&[1], &[], 1.0),
        "the body 'wall' cannot be moved by hand: make it driven (`driven = true` in a scene's text, `BodyMotion::Driven` in code)"
    );
    assert_eq!(
        message(&[2], &[], 1.0),
        "there is no body 2: the scene has 2, numbered from 0"
    );
    assert_eq!(
        message(&[], &[3], 1.0),
        "there is no cloth 3: the scene has 1, numbered from 0"
    );
    assert!(message(&[], &[0], 1.0).starts_with("the cloth 'cloth' is held by the body 'ball' as well, which stays"));
    assert!(message(&[0], &[], f64::NAN).contains("`translation`"));
    assert!(message(&[0], &[], 999.95).contains("which is not within 1000 metres"));
    simulation.step().unwrap();
}

/// A sheet whose middle is pinned and led down through a ball.
fn pressed() -> Scene {
    let sides = [0.4 * DVec3::X, 0.4 * DVec3::Y];
    let cloth = Cloth::sheet(DVec3::new(-0.2, -0.2, 0.13), sides, [8, 8], 0.2).unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 16).unwrap());
    scene.on_blocked = OnBlocked::Hold;
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(1000.0))
        .add(Shear::new(300.0));
    scene
        .add(BodyContact(Thickness::new(3e-3)))
        .add(SelfCollision(Thickness::new(3e-3)));
    scene.add(pinned(
        [40],
        PinMotion::Own(along([(0.0, DVec3::ZERO), (0.3, -0.3 * DVec3::Z)])),
    ));
    scene
}

#[test]
fn a_motion_that_stays_impossible_is_seldom_tried_and_changes_nothing() {
    let mut simulation = Simulation::new(pressed(), 1).unwrap();
    // At first the pin creeps on.
    while simulation.blocked_steps() < 50 {
        simulation.step().unwrap();
    }
    let (mut cuts, mut tried) = (simulation.contact_counts().unwrap().cuts, 0);
    let begin = simulation.blocked_steps();
    let pin = simulation.positions()[40];
    for _ in 0..100 {
        simulation.step().unwrap();
        let now = simulation.contact_counts().unwrap().cuts;
        tried += u32::from(now > cuts);
        cuts = now;
    }
    assert_eq!(simulation.blocked_steps() - begin, 100, "each of them is counted");
    // Some are tried in parts at once, others with their shortest part, which is not cut.
    assert!(tried < 10, "{tried} steps were tried in parts");
    assert!(simulation.positions()[40].distance(pin) < 2e-3 && simulation.is_certified());
    assert!(simulation.lag() > 0.1);
}

#[test]
fn a_motion_that_becomes_possible_continues() {
    let mut scene = pressed();
    scene.bodies[0].motion = BodyMotion::Driven(Placement::default());
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for _ in 0..250 {
        simulation.step().unwrap();
    }
    let lag = simulation.lag();
    assert!(lag > 0.0);
    // The caller takes the ball away.
    for step in 1..=400 {
        simulation
            .place_body(0, Placement::at(-1e-3 * f64::from(step.min(350)) * DVec3::Z))
            .unwrap();
        simulation.step().unwrap();
    }
    let pin = simulation.positions()[40].z;
    assert!((pin - (0.13 - 0.3)).abs() < 1e-9, "{pin}");
}
