//! A figure of capsules that walks along keyframes, with a cape on its shoulders. y is up, and lengths are in metres.

use bevy_asset::Assets;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::system::{Query, Res};
use bevy_ecs::world::World;
use bevy_math::{Quat, Vec3};
use bevy_mesh::{Mesh, Mesh3d};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge_cloth::effects::{
    AirDrag, Bend, BodyContact, Friction, Gravity, PinGroup, PinMotion, Pins, SelfCollision, Shear, StrainLimit, Stretch,
    Thickness,
};
use selvedge_bevy::selvedge_cloth::glam::DVec3;
use selvedge_bevy::selvedge_cloth::{Body, Cloth, OnBlocked, Scene, ValueError};
use selvedge_bevy::{ClothSimulation, CollisionBody, CollisionGroups, Groups, mesh_of};

/// The length of the walk in seconds.
pub(crate) const DURATION: f32 = 4.5;

/// The distance between cape and body, and between parts of the cape.
const THICKNESS: f64 = 4e-3;

/// The group of the limbs, which overlap without contacts.
const PARTS: CollisionGroups = CollisionGroups(Groups::new(0b01, 0b10));

/// The places of an entity over time, in seconds, with smooth motion between them.
#[derive(Component, Clone, Debug)]
pub(crate) struct Keyframes(Vec<(f32, Transform)>);

impl Keyframes {
    fn at(&self, time: f32) -> Transform {
        let next = self.0.partition_point(|key| key.0 <= time);
        let (Some(from), Some(to)) = (self.0.get(next.saturating_sub(1)), self.0.get(next).or(self.0.last())) else {
            return Transform::IDENTITY;
        };
        let share = if to.0 > from.0 {
            ((time - from.0) / (to.0 - from.0)).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let share = share * share * (3.0 - 2.0 * share);
        Transform {
            translation: from.1.translation.lerp(to.1.translation, share),
            rotation: from.1.rotation.slerp(to.1.rotation, share),
            scale: Vec3::ONE,
        }
    }
}

/// Moves entities along their keyframes; a system for `FixedUpdate`.
pub(crate) fn walk(time: Res<'_, Time<Fixed>>, mut limbs: Query<'_, '_, (&Keyframes, &mut Transform)>) {
    for (keyframes, mut transform) in &mut limbs {
        *transform = keyframes.at(time.elapsed_secs());
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Figure {
    pub(crate) parts: Vec<Entity>,
    pub(crate) cape: Entity,
}

/// Spawns a figure whose cape has this many cells across and down.
///
/// # Errors
/// Returns an error if a cape cannot have so many cells.
pub(crate) fn spawn(world: &mut World, cells: [u32; 2]) -> Result<Figure, ValueError> {
    let root = world.spawn(stroll()).id();
    let capsule = |name, from: [f64; 3], to: [f64; 3], radius| Body::capsule(name, [from, to].map(DVec3::from_array), radius, 24);
    let still = |at: [f32; 3]| Keyframes(vec![(0.0, Transform::from_translation(at.into()))]);
    // Each limb's capsule, relative to its joint, and the motion of the joint.
    let parts = [
        (capsule("torso", [0.0, 1.0, 0.0], [0.0, 1.32, 0.0], 0.12)?, still([0.0; 3])),
        (
            capsule("shoulders", [-0.16, 1.42, 0.0], [0.16, 1.42, 0.0], 0.06)?,
            still([0.0; 3]),
        ),
        (Body::ball("head", DVec3::ZERO, 0.11, 24)?, still([0.0, 1.61, 0.02])),
        (
            capsule("left leg", [0.0; 3], [0.0, -0.78, 0.0], 0.075)?,
            swing([0.08, 0.92, 0.0], 0.45),
        ),
        (
            capsule("right leg", [0.0; 3], [0.0, -0.78, 0.0], 0.075)?,
            swing([-0.08, 0.92, 0.0], -0.45),
        ),
        (
            capsule("left arm", [0.0; 3], [0.05, -0.55, 0.0], 0.045)?,
            swing([0.24, 1.40, 0.0], -0.5),
        ),
        (
            capsule("right arm", [0.0; 3], [-0.05, -0.55, 0.0], 0.045)?,
            swing([-0.24, 1.40, 0.0], 0.5),
        ),
    ];
    let mut scene = cape(cells)?;
    let mut entities = Vec::new();
    for (body, motion) in parts {
        let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh_of(&body.mesh));
        let part = (
            Mesh3d(mesh),
            CollisionBody::Rigid,
            PARTS,
            motion.at(0.0),
            motion,
            ChildOf(root),
        );
        entities.push(world.spawn(part).id());
        scene.bodies.push(body);
    }
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh_of(scene.cloths[0].mesh()));
    let led = entities.iter().enumerate();
    let simulation = led.fold(ClothSimulation::new(scene), |simulation, (body, &entity)| {
        simulation.led_by(body, entity)
    });
    let cape = world.spawn((simulation, Mesh3d(mesh))).id();
    Ok(Figure { parts: entities, cape })
}

fn cape(cells: [u32; 2]) -> Result<Scene, ValueError> {
    // The cape hangs down the back from the shoulders of the torso.
    let sides = [DVec3::new(0.44, 0.0, 0.0), DVec3::new(0.0, -0.96, -0.25)];
    let cloth = Cloth::sheet(DVec3::new(-0.22, 1.46, -0.10), sides, cells, 0.25)?;
    let top = cloth.part("bottom").unwrap_or_default().iter().copied();
    let clasped: Vec<u32> = top
        .filter(|&vertex| cloth.mesh().positions[vertex as usize].x.abs() > 0.1)
        .collect();
    let mut scene = Scene::new(cloth, 4e-3);
    scene.name = "cape".to_owned();
    scene.on_blocked = OnBlocked::Yield;
    scene.add(Gravity {
        acceleration: DVec3::NEG_Y * 9.81,
    });
    scene.add(Pins {
        groups: vec![PinGroup::new(clasped, PinMotion::Body(0))],
    });
    scene
        .add(Stretch::isotropic(400.0))
        .add(Shear::new(60.0))
        .add(Bend::isotropic(2e-5));
    scene
        .add(StrainLimit::at(1.08))
        .add(AirDrag { rate: 1.0 })
        .add(Friction { coefficient: 0.3 });
    scene
        .add(BodyContact(Thickness::new(THICKNESS)))
        .add(SelfCollision(Thickness::new(THICKNESS)));
    Ok(scene)
}

/// Returns the motion of the torso: it walks two and a half metres and turns round quickly.
fn stroll() -> (Keyframes, Transform) {
    let there = Vec3::new(0.0, 0.0, 2.4);
    let turned = |part: f32| Transform::from_translation(there).with_rotation(Quat::from_rotation_y(part * std::f32::consts::PI));
    let keyframes = vec![
        (0.0, Transform::IDENTITY),
        (0.5, Transform::IDENTITY),
        (2.5, turned(0.0)),
        (2.8, turned(0.5)),
        (3.1, turned(0.99)),
        (DURATION, turned(0.99)),
    ];
    (Keyframes(keyframes), Transform::IDENTITY)
}

/// Returns the motion of a limb that swings while the figure walks.
fn swing(joint: [f32; 3], angle: f32) -> Keyframes {
    let at = |share: f32| Transform::from_translation(joint.into()).with_rotation(Quat::from_rotation_x(share * angle));
    let times = [(0.5, 0.0), (0.75, 1.0), (1.25, -1.0), (1.75, 1.0), (2.25, -1.0), (2.5, 0.0)];
    Keyframes(times.map(|(time, share)| (time, at(share))).to_vec())
}
