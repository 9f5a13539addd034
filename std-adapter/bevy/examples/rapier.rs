//! Cloth and bodies of Rapier push each other: a ball falls into a hammock, and a curtain slows a door.
//!
//! `cargo run --release --features rapier --example rapier`

pub(crate) mod scenes;

use bevy_app::App;
use bevy_ecs::bundle::Bundle;
use bevy_ecs::entity::Entity;
use bevy_rapier3d::prelude::{
    Collider, ColliderMassProperties, LockedAxes, RapierPhysicsPlugin, RigidBody, TimestepMode, Velocity,
};
use bevy_transform::components::Transform;
use scenes::{BALL, DOOR, DOOR_MOTION, STEPS};
use selvedge_bevy::RapierBridge;
use selvedge_bevy::selvedge_cloth::Scene;

fn start(scene: Scene, body: impl Bundle) -> (App, Entity, Entity) {
    let mut app = scenes::app();
    let dt = 1.0 / STEPS as f32;
    app.insert_resource(TimestepMode::Fixed { dt, substeps: 1 })
        .add_plugins((RapierPhysicsPlugin::<()>::default().in_fixed_schedule(), RapierBridge));
    let body = app.world_mut().spawn((RigidBody::Dynamic, body)).id();
    let cloth = scenes::start(&mut app, scene, body);
    (app, cloth, body)
}

/// A ball in a hammock.
pub(crate) fn hammock() -> (App, Entity, Entity) {
    let [radius, mass, height] = BALL;
    let mass = ColliderMassProperties::Mass(mass);
    let ball = (Collider::ball(radius), mass, Transform::from_xyz(0.0, height, 0.0));
    start(scenes::hammock(), ball)
}

/// A door before a curtain.
pub(crate) fn door() -> (App, Entity, Entity) {
    let [x, y, z] = DOOR.map(|side| 0.5 * side);
    let [mass, spin] = DOOR_MOTION;
    let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Z;
    let mass = ColliderMassProperties::Mass(mass);
    let motion = Velocity::angular(bevy_math::Vec3::Y * spin);
    let door = (Collider::cuboid(x, y, z), mass, axes, motion, Transform::default());
    start(scenes::door(), door)
}

fn main() {
    let motion = |app: &App, body| app.world().get::<Velocity>(body).copied().unwrap_or_default();
    let (mut app, cloth, ball) = hammock();
    let force = scenes::run(&mut app, cloth, 5);
    let (height, speed) = (scenes::height(&app, ball), motion(&app, ball).linear.length());
    println!(
        "the ball is at {height:.3} m, at {speed:.3} m/s; the sheet bears {:.3} N",
        force.y
    );
    let (mut app, cloth, door) = door();
    for _ in 0..4 {
        scenes::run(&mut app, cloth, 1);
        println!("the door turns at {:.3} rad/s", motion(&app, door).angular.y);
    }
}
