//! Cloth pushes bodies of Rapier: the scenes of its example.

#[allow(dead_code, reason = "the example has a main function")]
#[path = "../examples/rapier.rs"]
mod example;

use bevy_app::App;
use bevy_ecs::message::Messages;
use bevy_rapier3d::prelude::{TimestepMode, Velocity};
use example::scenes;
use selvedge_bevy::{SelvedgeError, SelvedgeProblem};

#[test]
fn a_ball_of_rapier_comes_to_rest_in_a_hammock_which_bears_its_weight() {
    let (mut app, cloth, ball) = example::hammock();
    let force = scenes::run(&mut app, cloth, 6);
    let weight = f64::from(scenes::BALL[1]) * 9.81;
    assert!((force.y - weight).abs() < 5e-3 * weight, "{force} instead of {weight}");
    let simulation = scenes::simulation(&app, cloth).unwrap();
    let placement = simulation.placement(0).unwrap();
    // The entity is where the cloth has left the body, in f32.
    assert!((placement.translation.y - f64::from(scenes::height(&app, ball))).abs() < 1e-6);
    assert!(simulation.is_certified() && simulation.blocked_steps() == 0);
    assert!(app.world().get::<Velocity>(ball).unwrap().linear.length() < 0.3);
}

#[test]
fn a_curtain_slows_a_door_of_rapier() {
    let (mut app, cloth, door) = example::door();
    scenes::run(&mut app, cloth, 2);
    let spin = app.world().get::<Velocity>(door).unwrap().angular.y;
    assert!(spin < 0.8 * scenes::DOOR_MOTION[1], "{spin} rad/s");
    assert!(scenes::simulation(&app, cloth).unwrap().is_certified());
}

#[test]
fn an_engine_with_another_step_than_the_cloth_is_told_once() {
    let (mut app, ..) = example::hammock();
    app.insert_resource(TimestepMode::Fixed { dt: 0.01, substeps: 1 });
    let told = |app: &mut App| {
        app.update();
        let problems: Vec<_> = app.world_mut().resource_mut::<Messages<SelvedgeProblem>>().drain().collect();
        problems.into_iter().map(|problem| problem.error).collect::<Vec<_>>()
    };
    // Time starts with the first update.
    let first = [told(&mut app), told(&mut app)].concat();
    assert!(
        matches!(first[..], [SelvedgeError::EngineStep { engine: Some(dt), cloth }] if (dt - 0.01).abs() < 1e-9 && cloth == 1.0 / 64.0),
        "{first:?}"
    );
    assert_eq!(told(&mut app), []);
}
