//! Cloth and bodies of Avian push each other: a ball falls into a hammock, and a curtain slows a door.
//!
//! `cargo run --release --features avian --example avian`

pub(crate) mod scenes;

use avian3d::prelude::{AngularVelocity, Collider, LinearVelocity, LockedAxes, Mass, PhysicsPlugins, RigidBody};
use bevy_app::App;
use bevy_ecs::bundle::Bundle;
use bevy_ecs::entity::Entity;
use bevy_transform::components::Transform;
use scenes::{BALL, DOOR, DOOR_MOTION};
use selvedge_bevy::AvianBridge;
use selvedge_bevy::selvedge_cloth::Scene;

fn start(scene: Scene, body: impl Bundle) -> (App, Entity, Entity) {
    let mut app = scenes::app();
    app.add_plugins((PhysicsPlugins::default(), AvianBridge));
    let body = app.world_mut().spawn((RigidBody::Dynamic, body)).id();
    let cloth = scenes::start(&mut app, scene, body);
    (app, cloth, body)
}

/// A ball in a hammock.
pub(crate) fn hammock() -> (App, Entity, Entity) {
    let [radius, mass, height] = BALL;
    let ball = (Collider::sphere(radius), Mass(mass), Transform::from_xyz(0.0, height, 0.0));
    start(scenes::hammock(), ball)
}

/// A door before a curtain.
pub(crate) fn door() -> (App, Entity, Entity) {
    let [x, y, z] = DOOR;
    let [mass, spin] = DOOR_MOTION;
    let axes = LockedAxes::TRANSLATION_LOCKED.lock_rotation_x().lock_rotation_z();
    let spin = AngularVelocity(bevy_math::Vec3::Y * spin);
    let door = (Collider::cuboid(x, y, z), Mass(mass), axes, spin, Transform::default());
    start(scenes::door(), door)
}

fn main() {
    let (mut app, cloth, ball) = hammock();
    let force = scenes::run(&mut app, cloth, 5);
    let speed = app
        .world()
        .get::<LinearVelocity>(ball)
        .map_or(f32::NAN, |velocity| velocity.length());
    println!(
        "the ball is at {:.3} m, at {speed:.3} m/s; the sheet bears {:.3} N",
        scenes::height(&app, ball),
        force.y
    );
    let (mut app, cloth, door) = door();
    for _ in 0..4 {
        scenes::run(&mut app, cloth, 1);
        let spin = app.world().get::<AngularVelocity>(door).map_or(f32::NAN, |spin| spin.y);
        println!("the door turns at {spin:.3} rad/s");
    }
}
