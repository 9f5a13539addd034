//! Rapier's bodies, which cloth pushes.

use crate::error::tell;
use crate::{ClothSimulation, EngineBody, SelvedgeError, SelvedgeProblem, SelvedgeSystems};
use bevy_app::{App, FixedPostUpdate, Plugin};
use bevy_ecs::message::MessageWriter;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::{Commands, Local, Query, Res};
use bevy_rapier3d::prelude::{ExternalImpulse, LockedAxes, ReadMassProperties, RigidBody, Sleeping, TimestepMode, Velocity};
use bevy_time::{Fixed, Time};

/// Lets cloth push the dynamic bodies of Rapier that its bodies [follow](ClothSimulation::led_by), and lets it follow all others.
/// Add it beside [`SelvedgePlugin`](crate::SelvedgePlugin) and `RapierPhysicsPlugin::in_fixed_schedule`, with a
/// `TimestepMode::Fixed` of the fixed time step; another step is reported.
///
/// A body that cloth may push never sleeps. See [`EngineBody`].
#[derive(Clone, Copy, Debug, Default)]
pub struct RapierBridge;

impl Plugin for RapierBridge {
    fn build(&self, app: &mut App) {
        app.add_systems(
            FixedPostUpdate,
            (
                (check_step, read_bodies).before(SelvedgeSystems::Cloth),
                push_bodies.after(SelvedgeSystems::Cloth),
            ),
        );
    }
}

/// Reports once that the engine's step is not the cloth's.
fn check_step(
    mode: Option<Res<'_, TimestepMode>>,
    time: Res<'_, Time<Fixed>>,
    mut told: Local<'_, Option<f64>>,
    mut problems: MessageWriter<'_, SelvedgeProblem>,
) {
    let cloth = time.timestep().as_secs_f64();
    let engine = match mode.as_deref() {
        Some(TimestepMode::Fixed { dt, .. }) => Some(f64::from(*dt)),
        _ => None,
    };
    // The engine's step is a rounded `f32`.
    let is_same = engine.is_some_and(|engine| (engine - cloth).abs() < 1e-6 * cloth);
    let now = (!is_same).then(|| engine.unwrap_or(0.0));
    if now.is_some() && now != *told {
        tell(&mut problems, None, SelvedgeError::EngineStep { engine, cloth });
    }
    *told = now;
}

type Moving = (
    &'static RigidBody,
    Option<&'static ReadMassProperties>,
    Option<&'static Velocity>,
    Option<&'static LockedAxes>,
    Option<&'static mut EngineBody>,
);

fn read_bodies(cloths: Query<'_, '_, &ClothSimulation>, mut bodies: Query<'_, '_, Moving>, mut commands: Commands<'_, '_>) {
    for leader in cloths.iter().flat_map(ClothSimulation::leading_entities) {
        let Ok((RigidBody::Dynamic, mass, velocity, locked, known)) = bodies.get_mut(leader) else {
            continue;
        };
        // Rapier writes the mass and the velocity in its next step, if these components are there.
        let mut entity = commands.entity(leader);
        if mass.is_none() {
            entity.insert(ReadMassProperties::default());
        }
        if velocity.is_none() {
            entity.insert(Velocity::default());
        }
        let motion = velocity.copied().unwrap_or_default();
        let new = EngineBody {
            mass: mass.map_or(0.0, |mass| f64::from(mass.get().mass)),
            velocity: motion.linear,
            spin: motion.angular,
            locked: locked.map_or_else(Default::default, |locked| axes(*locked)),
            ..EngineBody::default()
        };
        match known {
            Some(mut known) => *known = new,
            None => {
                entity.insert((new, Sleeping::disabled()));
                entity.insert_if_new(ExternalImpulse::default());
            }
        }
    }
}

fn axes(locked: LockedAxes) -> selvedge_cloth::LockedAxes {
    let are = |flags: [LockedAxes; 3]| flags.map(|flag| locked.contains(flag));
    selvedge_cloth::LockedAxes {
        translation: are([
            LockedAxes::TRANSLATION_LOCKED_X,
            LockedAxes::TRANSLATION_LOCKED_Y,
            LockedAxes::TRANSLATION_LOCKED_Z,
        ]),
        rotation: are([
            LockedAxes::ROTATION_LOCKED_X,
            LockedAxes::ROTATION_LOCKED_Y,
            LockedAxes::ROTATION_LOCKED_Z,
        ]),
    }
}

fn push_bodies(mut bodies: Query<'_, '_, (&mut ExternalImpulse, &EngineBody)>) {
    for (mut impulse, pushed) in &mut bodies {
        impulse.impulse += pushed.impulse;
        impulse.torque_impulse += pushed.angular_impulse;
    }
}
