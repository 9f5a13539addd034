//! Two scenes in which cloth and a body of a physics engine push each other, without a window.

use bevy_app::{App, TaskPoolPlugin};
use bevy_asset::AssetPlugin;
use bevy_ecs::entity::Entity;
use bevy_mesh::{Mesh, MeshPlugin};
use bevy_shape::Cuboid;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge_cloth::effects::{
    BodyContact, Friction, Gravity, PinGroup, Pins, SelfCollision, Shear, Stretch, Thickness,
};
use selvedge_bevy::selvedge_cloth::glam::DVec3;
use selvedge_bevy::selvedge_cloth::{Body, Cloth, Scene, Simulation};
use selvedge_bevy::{ClothSimulation, SelvedgePlugin, body_of_mesh};

/// The number of fixed steps in a second, as many as Bevy makes by default.
pub(crate) const STEPS: u32 = 64;
/// The radius of the ball in m, its mass in kg, and its height at the start.
pub(crate) const BALL: [f32; 3] = [0.08, 0.5, 0.12];
/// The sides of the door in m.
pub(crate) const DOOR: [f32; 3] = [0.9, 0.8, 0.03];
/// The mass of the door in kg, and its angular velocity at the start in rad/s.
pub(crate) const DOOR_MOTION: [f32; 2] = [2.0, 2.0];

/// Makes an app without a window, in which each update is one fixed step.
pub(crate) fn app() -> App {
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin::default(),
        TimePlugin,
        TransformPlugin,
        AssetPlugin::default(),
        MeshPlugin,
        SelvedgePlugin,
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
    app
}

fn with_cloth(cloth: Cloth, pinned: impl Fn(&DVec3) -> bool, body: Body) -> Scene {
    let vertices = cloth.mesh().positions.iter().zip(0..).filter(|(point, _)| pinned(point));
    let pins: Vec<u32> = vertices.map(|(_, vertex)| vertex).collect();
    let mut scene = Scene::new(cloth, 4e-3);
    scene.bodies.push(body);
    let acceleration = DVec3::NEG_Y * 9.81;
    scene
        .add(Gravity { acceleration })
        .add(Stretch::isotropic(1000.0))
        .add(Shear::new(200.0));
    scene
        .add(Pins {
            groups: vec![PinGroup::resting(pins)],
        })
        .add(Friction { coefficient: 0.3 });
    scene
        .add(BodyContact(Thickness::new(4e-3)))
        .add(SelfCollision(Thickness::new(4e-3)));
    scene
}

/// A sheet of 40 g, held at its border, and the ball above it, number 0 of its bodies.
pub(crate) fn hammock() -> Scene {
    let corner = DVec3::new(-0.25, 0.0, -0.25);
    let sheet = Cloth::sheet(corner, [DVec3::Z * 0.5, DVec3::X * 0.5], [12, 12], 0.16);
    let ball = Body::ball("ball", DVec3::ZERO, f64::from(BALL[0]), 16);
    let border = |point: &DVec3| point.x.abs().max(point.z.abs()) > 0.249;
    with_cloth(sheet.expect("the sheet is valid"), border, ball.expect("the ball is valid"))
}

/// A curtain of 100 g that hangs from above in the way of a door, number 0 of its bodies, which turns about the y axis.
pub(crate) fn door() -> Scene {
    let corner = DVec3::new(0.1, -0.35, -0.2);
    let curtain = Cloth::sheet(corner, [DVec3::X * 0.45, DVec3::Y * 0.9], [9, 18], 0.25);
    let [x, y, z] = DOOR;
    let door = body_of_mesh("door", &Mesh::from(Cuboid::new(x, y, z)));
    let top = |point: &DVec3| point.y > 0.549;
    with_cloth(curtain.expect("the curtain is valid"), top, door.expect("the door is valid"))
}

/// Starts a scene whose body follows an entity of the engine. Returns the entity of the cloth.
pub(crate) fn start(app: &mut App, scene: Scene, body: Entity) -> Entity {
    let cloth = app.world_mut().spawn(ClothSimulation::new(scene).led_by(0, body)).id();
    app.finish();
    app.cleanup();
    cloth
}

/// Runs the app for so many seconds. Returns the mean force of the cloth on the body in the last second, in N.
pub(crate) fn run(app: &mut App, cloth: Entity, seconds: u32) -> DVec3 {
    let mut force = DVec3::ZERO;
    for step in 0..seconds * STEPS {
        app.update();
        if let (true, Some(simulation)) = (step >= (seconds - 1) * STEPS, simulation(app, cloth)) {
            force += simulation.proxy_load(0).map_or(DVec3::ZERO, |load| load.force) / f64::from(STEPS);
        }
    }
    force
}

/// The simulation of a cloth; `None` before it starts.
pub(crate) fn simulation(app: &App, cloth: Entity) -> Option<&Simulation> {
    app.world().get::<ClothSimulation>(cloth)?.simulation()
}

/// The height of an entity.
pub(crate) fn height(app: &App, entity: Entity) -> f32 {
    app.world()
        .get::<Transform>(entity)
        .map_or(f32::NAN, |transform| transform.translation.y)
}
