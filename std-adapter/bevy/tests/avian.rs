//! Cloth pushes bodies of Avian: the scenes of its example.

#[allow(dead_code, reason = "the example has a main function")]
#[path = "../examples/avian.rs"]
mod example;

use avian3d::prelude::{AngularVelocity, LinearVelocity};
use example::scenes;

#[test]
fn a_ball_of_avian_comes_to_rest_in_a_hammock_which_bears_its_weight() {
    let (mut app, cloth, ball) = example::hammock();
    let force = scenes::run(&mut app, cloth, 6);
    let weight = f64::from(scenes::BALL[1]) * 9.81;
    assert!((force.y - weight).abs() < 5e-3 * weight, "{force} instead of {weight}");
    let simulation = scenes::simulation(&app, cloth).unwrap();
    let placement = simulation.placement(0).unwrap();
    // The entity is where the cloth has left the body, in f32.
    assert!((placement.translation.y - f64::from(scenes::height(&app, ball))).abs() < 1e-6);
    assert!(simulation.is_certified() && simulation.blocked_steps() == 0);
    assert!(app.world().get::<LinearVelocity>(ball).unwrap().length() < 0.3);
}

#[test]
fn a_curtain_slows_a_door_of_avian() {
    let (mut app, cloth, door) = example::door();
    scenes::run(&mut app, cloth, 2);
    let spin = app.world().get::<AngularVelocity>(door).unwrap().y;
    assert!(spin < 0.8 * scenes::DOOR_MOTION[1], "{spin} rad/s");
    assert!(scenes::simulation(&app, cloth).unwrap().is_certified());
}
