//! Entities that follow the free bodies of cloth, and bodies of a physics engine that cloth pushes.

use crate::cloth::ClothSimulation;
use crate::error::tell;
use crate::place::{Place, Places};
use crate::{EngineBody, SelvedgeError, SelvedgeProblem};
use bevy_ecs::change_detection::DetectChangesMut;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::MessageWriter;
use bevy_ecs::system::{ParamSet, Query};
use bevy_math::{Quat, Vec3};
use bevy_transform::components::Transform;
use selvedge_cloth::Placement;

/// Returns the `Transform` in a parent at `parent` of what is at `placement` in the world, with this scale.
fn within(parent: Option<Place>, placement: Placement, scale: Vec3) -> Option<Transform> {
    let Placement {
        mut rotation,
        mut translation,
    } = placement;
    if let Some(parent) = parent {
        let (turn, origin) = parent.pose();
        translation = parent.linear().inverse() * (translation - origin);
        rotation = turn.inverse() * rotation;
    }
    let transform = Transform {
        translation: Vec3::from_array(translation.as_vec3().to_array()),
        rotation: Quat::from_array(rotation.as_quat().to_array()).normalize(),
        scale,
    };
    (transform.translation.is_finite() && transform.rotation.is_finite()).then_some(transform)
}

/// Moves the entities that follow free bodies to where these are, and those of bodies of an engine to where cloth has pushed
/// them. Writes its impulses.
pub(crate) fn show_bodies(
    mut cloths: Query<'_, '_, (Entity, &mut ClothSimulation)>,
    mut transforms: ParamSet<'_, '_, (Places<'_, '_>, Query<'_, '_, &'static mut Transform>)>,
    mut engine_bodies: Query<'_, '_, &mut EngineBody>,
    mut problems: MessageWriter<'_, SelvedgeProblem>,
) {
    for mut pushed in &mut engine_bodies {
        (pushed.impulse, pushed.angular_impulse) = (Vec3::ZERO, Vec3::ZERO);
    }
    for (entity, mut cloth) in &mut cloths {
        let Some(simulation) = cloth.simulation() else { continue };
        let bodies = simulation.body_names().len();
        let mut results = Vec::new();
        // Cloth that has not moved pushes nothing.
        let seconds = cloth.advanced();
        let pushed = || cloth.pushed().filter(|_| seconds.is_some());
        for (body, entity) in pushed() {
            let load = simulation.proxy_load(body).zip(seconds);
            if let (Ok(mut engine_body), Some((load, seconds))) = (engine_bodies.get_mut(entity), load) {
                engine_body.push(load, seconds);
            }
        }
        let followers = cloth.followers().iter().map(|(&body, &follower)| (body, follower));
        for (body, follower) in followers.chain(pushed()) {
            let placement = match simulation.body_motion(body).and(simulation.placement(body)) {
                Some(placement) => Ok(placement),
                None if body < bodies => Err(SelvedgeError::NotFree { body }),
                None => Err(SelvedgeError::NoBody { body, bodies }),
            };
            let moved = placement.and_then(|placement| {
                let parent = transforms.p0().of_parent(follower)?;
                let mut all = transforms.p1();
                let mut own = all
                    .get_mut(follower)
                    .map_err(|_| SelvedgeError::NoTransform { entity: follower })?;
                let transform = within(parent, placement, own.scale).ok_or(SelvedgeError::BadTransform)?;
                own.set_if_neq(transform);
                Ok(())
            });
            results.push((body, moved));
        }
        for (body, result) in results {
            if let Some(error) = cloth.is_new_of_follower(body, result) {
                tell(&mut problems, Some(entity), error);
            }
        }
    }
}
