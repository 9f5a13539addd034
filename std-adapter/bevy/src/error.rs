//! What went wrong, as messages.

use crate::MeshError;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::{Message, MessageWriter};
use selvedge::WorldError;

/// Something that could not be done, and to whom it happened. It is logged as a warning as well; everything else goes on.
#[derive(Message, Clone, Debug, PartialEq)]
pub struct SelvedgeProblem {
    /// Whose; `None` if it is the [settings'](crate::CollisionSettings) or a whole step's.
    pub entity: Option<Entity>,
    /// What it is.
    pub error: SelvedgeError,
}

/// What can go wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SelvedgeError {
    /// A body's mesh cannot collide. It is looked at again when the asset changes.
    #[error("its mesh cannot collide: {0}")]
    Mesh(#[from] MeshError),
    /// A body or one of its ancestors has no `Transform`. It stays out, or where it is, until that changes.
    #[error("it cannot be placed: entity {entity} has no Transform; give it one")]
    NoTransform {
        /// Which of them.
        entity: Entity,
    },
    /// Numbers of a `Transform` are not finite, or its rotation is zero. It stays out, or where it is, until that changes.
    #[error("it cannot be placed: a Transform of it or its ancestors has numbers that are not finite, or a rotation of zero")]
    BadTransform,
    /// The world of bodies did not take one: it is out of the range of numbers, or they are too many.
    #[error("{0}")]
    World(WorldError),
    /// A step's contacts were not found: there are more pairs than the limit, say. Bodies are where they would have ended.
    #[error("this step's contacts are not known: {0}")]
    Step(WorldError),
    /// A setting was not taken; the one before holds.
    #[error("a setting was not taken: {0}")]
    Setting(String),
}

/// Tells and logs problems.
pub(crate) fn tell(problems: &mut MessageWriter<'_, SelvedgeProblem>, entity: Option<Entity>, error: SelvedgeError) {
    match entity {
        Some(entity) => tracing::warn!("selvedge: entity {entity}: {error}"),
        None => tracing::warn!("selvedge: {error}"),
    }
    problems.write(SelvedgeProblem { entity, error });
}
