//! Bodies of an engine of one's own, which cloth pushes.

use crate::{app, scenes, step};
use bevy_app::FixedPostUpdate;
use bevy_ecs::entity::Entity;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::{Query, Res};
use bevy_math::Vec3;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use selvedge_bevy::{ClothSimulation, EngineBody, SelvedgeSystems};

const MASS: f32 = 0.5;

/// An engine that knows gravity alone.
fn fall(mut bodies: Query<'_, '_, (&mut EngineBody, &mut Transform)>, time: Res<'_, Time<Fixed>>) {
    let seconds = time.timestep().as_secs_f32();
    for (mut body, mut transform) in &mut bodies {
        body.velocity += Vec3::NEG_Y * (9.81 * seconds);
        transform.translation += body.velocity * seconds;
    }
}

fn take_impulses(mut bodies: Query<'_, '_, &mut EngineBody>) {
    for mut body in &mut bodies {
        let change = body.impulse / MASS;
        body.velocity += change;
    }
}

fn with_engine() -> (bevy_app::App, Entity, Entity) {
    let mut app = app();
    app.add_systems(
        FixedPostUpdate,
        (
            fall.before(SelvedgeSystems::Cloth),
            take_impulses.after(SelvedgeSystems::Cloth),
        ),
    );
    let engine_body = EngineBody {
        mass: f64::from(MASS),
        ..EngineBody::default()
    };
    let ball = app.world_mut().spawn((engine_body, Transform::from_xyz(0.0, 0.12, 0.0))).id();
    let cloth = ClothSimulation::new(scenes::hammock()).led_by(0, ball);
    let cloth = app.world_mut().spawn(cloth).id();
    (app, cloth, ball)
}

#[test]
fn a_body_of_an_engine_comes_to_rest_in_cloth_that_pushes_it_by_its_weight() {
    let (mut app, cloth, ball) = with_engine();
    let mut impulse = 0.0;
    for done in 0..384 {
        assert_eq!(step(&mut app).problems, []);
        if done >= 320 {
            impulse += app.world().get::<EngineBody>(ball).unwrap().impulse.y;
        }
    }
    // 64 fixed steps are a second.
    let weight = MASS * 9.81;
    assert!((impulse - weight).abs() < 5e-3 * weight, "{impulse} instead of {weight}");
    let simulation = app.world().get::<ClothSimulation>(cloth).unwrap().simulation().unwrap();
    let [of_cloth, of_entity] = [
        simulation.placement(0).unwrap().translation.y,
        f64::from(app.world().get::<Transform>(ball).unwrap().translation.y),
    ];
    assert!((of_cloth - of_entity).abs() < 1e-6 && of_entity < 0.08, "{of_entity}");
    assert!(simulation.is_certified());
}

#[test]
fn without_a_mass_the_cloth_waits_for_the_engine_and_a_cloth_that_has_not_moved_pushes_nothing() {
    let (mut app, cloth, ball) = with_engine();
    let is_running = |app: &bevy_app::App| app.world().get::<ClothSimulation>(cloth).unwrap().simulation().is_some();
    app.world_mut().get_mut::<EngineBody>(ball).unwrap().mass = 0.0;
    step(&mut app);
    assert!(!is_running(&app));
    app.world_mut().get_mut::<EngineBody>(ball).unwrap().mass = f64::from(MASS);
    step(&mut app);
    assert!(is_running(&app));
    for _ in 0..60 {
        step(&mut app);
    }
    assert!(app.world().get::<EngineBody>(ball).unwrap().impulse.length() > 0.0);
    // An entity that jumps is a problem, and the cloth rests.
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation.x += 100.0;
    assert_eq!(step(&mut app).problems.len(), 1);
    assert_eq!(app.world().get::<EngineBody>(ball).unwrap().impulse, Vec3::ZERO);
}
