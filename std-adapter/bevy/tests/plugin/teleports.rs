//! Entities that jump, and the cloth that they lead.

use crate::cloth::{over_a_ball, simulation, wide};
use crate::{app, step};
use bevy_app::App;
use bevy_ecs::entity::Entity;
use bevy_math::{Quat, Vec3};
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge_cloth::effects::{PinGroup, PinMotion, Pins};
use selvedge_bevy::selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_bevy::selvedge_cloth::{Body, Placement};
use selvedge_bevy::{ClothSimulation, SelvedgeError, SelvedgeProblem};

/// Spawns an entity that leads the ball, and a sheet that is pinned to the ball by its middle.
fn spawn_pinned_to_a_ball(app: &mut App) -> [Entity; 2] {
    let mut scene = over_a_ball();
    let middle = PinGroup::new([84], PinMotion::Body(0));
    scene.add(Pins { groups: vec![middle] });
    let ball = app.world_mut().spawn(Transform::default()).id();
    let cloth = ClothSimulation::new(scene).led_by(0, ball);
    [ball, app.world_mut().spawn(cloth).id()]
}

#[test]
fn a_teleport_moves_body_pins_and_cloth_without_a_step_and_they_go_on_as_if_they_had_stayed() {
    let mut app = app();
    let [[ball, cloth], [other_ball, stays]] = [0, 1].map(|_| spawn_pinned_to_a_ball(&mut app));
    for k in 1..=10 {
        for ball in [ball, other_ball] {
            app.world_mut().get_mut::<Transform>(ball).unwrap().translation.x = 0.004 * k as f32;
        }
        assert_eq!(step(&mut app).problems, []);
    }
    let state = |app: &App, entity| {
        let it = simulation(app, entity);
        (it.positions().to_vec(), it.velocities().to_vec(), it.steps_done(), it.time())
    };
    let (before, velocities, steps, time) = state(&app, cloth);
    assert!(velocities[..169].iter().any(|velocity| velocity.length() > 0.1), "it swings");

    // An entity that jumps alone is a problem, and the cloth rests.
    let turn = Quat::from_rotation_y(2.0);
    let away = Vec3::new(30.0, -4.0, 2.0);
    let there = Transform::from_translation(turn * Vec3::X * 0.04 + away).with_rotation(turn);
    *app.world_mut().get_mut::<Transform>(ball).unwrap() = there;
    let told = step(&mut app).problems;
    assert!(
        matches!(&told[..], [SelvedgeProblem { entity: Some(own), error: SelvedgeError::TooFast(_) }] if *own == cloth),
        "{told:?}"
    );
    assert_eq!(state(&app, cloth), (before.clone(), velocities.clone(), steps, time));

    // The world is the same after a turn about the vertical, so the cloth goes on there as it does here.
    let [x, y, z, w] = turn.to_array().map(f64::from);
    let by = Placement::new(DQuat::from_xyzw(x, y, z, w).normalize(), wide(away.to_array()));
    app.world_mut()
        .get_mut::<ClothSimulation>(cloth)
        .unwrap()
        .teleport(&[], by)
        .unwrap();
    let (now, turned, steps_now, time_now) = state(&app, cloth);
    assert_eq!((steps_now, time_now), (steps, time));
    for (now, before) in now.iter().zip(&before) {
        assert!(now.distance(by.apply(*before)) < 1e-12);
    }
    for (now, before) in turned.iter().zip(&velocities) {
        assert!(now.distance(by.rotation * *before) < 1e-12);
    }
    // The other one went on while this one rested, so it is one fixed step ahead. Solves are not exact, so they differ a little.
    let cloth_of = |app: &App, entity| simulation(app, entity).positions()[..169].to_vec();
    let largest = |ways: &mut dyn Iterator<Item = f64>| ways.fold(0.0, f64::max);
    let here = cloth_of(&app, stays);
    assert_eq!(step(&mut app).problems, []);
    let there = cloth_of(&app, cloth);
    let off = largest(&mut there.iter().zip(&here).map(|(there, here)| there.distance(by.apply(*here))));
    let way = largest(&mut now.iter().zip(&there).map(|(from, to)| from.distance(*to)));
    assert!(off < 0.25 * way, "{off} m off after {way} m");
    for _ in 0..20 {
        assert_eq!(step(&mut app).problems, []);
    }
    let arrived = simulation(&app, cloth);
    assert!(arrived.is_certified() && arrived.blocked_steps() == 0);
}

#[test]
fn a_teleport_without_room_changes_nothing() {
    let mut app = app();
    let mut scene = over_a_ball();
    scene
        .bodies
        .push(Body::ball("post", DVec3::new(5.0, 0.1, 0.0), 0.1, 16).unwrap());
    let ball = app.world_mut().spawn(Transform::default()).id();
    let cloth = app.world_mut().spawn(ClothSimulation::new(scene).led_by(0, ball)).id();
    assert_eq!(step(&mut app).problems, []);
    let before = simulation(&app, cloth).positions().to_vec();
    let mut own = app.world_mut().get_mut::<ClothSimulation>(cloth).unwrap();
    let refused = own.teleport(&[0], Placement::at(5.0 * DVec3::X)).unwrap_err();
    assert!(refused.to_string().starts_with("there is no room"), "{refused}");
    assert_eq!(simulation(&app, cloth).positions(), before);
    assert_eq!(step(&mut app).problems, []);
}
