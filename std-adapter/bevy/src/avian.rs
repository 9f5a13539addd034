//! Avian's bodies, which cloth pushes.

use crate::{ClothSimulation, EngineBody, SelvedgeSystems};
use avian3d::prelude::{
    AngularVelocity, ComputedMass, Forces, LinearVelocity, LockedAxes, PhysicsSystems, RigidBody, SleepingDisabled,
    WriteRigidBodyForces,
};
use bevy_app::{App, FixedPostUpdate, Plugin};
use bevy_ecs::entity::Entity;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::{Commands, Query};

/// Lets cloth push the dynamic bodies of Avian that its bodies [follow](ClothSimulation::led_by), and lets it follow all others.
/// Add it beside [`SelvedgePlugin`](crate::SelvedgePlugin) and Avian's `PhysicsPlugins`, which run in `FixedPostUpdate` by
/// default.
///
/// A body that cloth may push never sleeps. See [`EngineBody`].
#[derive(Clone, Copy, Debug, Default)]
pub struct AvianBridge;

impl Plugin for AvianBridge {
    fn build(&self, app: &mut App) {
        app.configure_sets(FixedPostUpdate, SelvedgeSystems::Cloth.after(PhysicsSystems::Last))
            .add_systems(
                FixedPostUpdate,
                (
                    read_bodies.after(PhysicsSystems::Last).before(SelvedgeSystems::Cloth),
                    push_bodies.after(SelvedgeSystems::Cloth),
                ),
            );
    }
}

type Moving = (
    &'static RigidBody,
    &'static ComputedMass,
    &'static LinearVelocity,
    &'static AngularVelocity,
    Option<&'static LockedAxes>,
    Option<&'static mut EngineBody>,
);

fn read_bodies(cloths: Query<'_, '_, &ClothSimulation>, mut bodies: Query<'_, '_, Moving>, mut commands: Commands<'_, '_>) {
    for leader in cloths.iter().flat_map(ClothSimulation::leading_entities) {
        let Ok((body, mass, velocity, spin, locked, known)) = bodies.get_mut(leader) else {
            continue;
        };
        if !body.is_dynamic() {
            continue;
        }
        let new = EngineBody {
            mass: f64::from(mass.value()),
            velocity: velocity.0,
            spin: spin.0,
            locked: locked.map_or_else(Default::default, axes),
            ..EngineBody::default()
        };
        match known {
            Some(mut known) => *known = new,
            None => insert(&mut commands, leader, new),
        }
    }
}

fn insert(commands: &mut Commands<'_, '_>, entity: Entity, body: EngineBody) {
    commands.entity(entity).insert((body, SleepingDisabled));
}

fn axes(locked: &LockedAxes) -> selvedge_cloth::LockedAxes {
    selvedge_cloth::LockedAxes {
        translation: [
            locked.is_translation_x_locked(),
            locked.is_translation_y_locked(),
            locked.is_translation_z_locked(),
        ],
        rotation: [
            locked.is_rotation_x_locked(),
            locked.is_rotation_y_locked(),
            locked.is_rotation_z_locked(),
        ],
    }
}

fn push_bodies(mut bodies: Query<'_, '_, (Forces, &EngineBody)>) {
    for (mut forces, pushed) in &mut bodies {
        forces.apply_linear_impulse(pushed.impulse);
        forces.apply_angular_impulse(pushed.angular_impulse);
    }
}
