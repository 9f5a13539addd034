//! What went wrong, as messages.

use crate::MeshError;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::{Message, MessageWriter};
use selvedge::WorldError;
use selvedge_cloth::{Blocked, DriveError};

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
    /// The mesh of a body cannot collide, or that of a cloth cannot be written. It is looked at again when the asset changes.
    #[error("its mesh cannot be used: {0}")]
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
    /// A cloth's scene cannot be simulated. It never starts.
    #[error("the scene cannot be simulated: {0}")]
    Setup(String),
    /// A cloth cannot go on without an intersection, and its scene wants to stop then: see `Scene::on_blocked`.
    #[error("the cloth ends: {0}")]
    Blocked(Blocked),
    /// An entity leads a body that the scene does not have.
    #[error("there is no body {body} to be led: the scene has {bodies}, from 0 on")]
    NoBody {
        /// Which body.
        body: usize,
        /// How many there are.
        bodies: usize,
    },
    /// A body cannot be led to where its entity is: that is beyond a kilometre, say. It stops on the way.
    #[error("a body cannot be led to where its entity is: {0}")]
    Lead(DriveError),
    /// An entity that leads a body has a scale, which the body would not follow. It stays.
    #[error("entity {entity} leads a body, but has a scale: give the body that size instead")]
    ScaledLeader {
        /// Which entity.
        entity: Entity,
    },
    /// The fixed time step was changed after the cloth had started: it goes on with its own, slower or faster than the rest.
    #[error("the fixed time step is {fixed} s now, but the cloth has started with steps of {step} s")]
    TimeStep {
        /// The cloth's, in seconds.
        step: f64,
        /// Bevy's, in seconds.
        fixed: f64,
    },
    /// The mesh that is seen is not the cloth's.
    #[error(
        "its Mesh3d has {seen} vertices, but the cloth has {cloth}: give it the mesh that the cloth was made of, or `mesh_of`"
    )]
    OtherMesh {
        /// Vertices of the mesh.
        seen: usize,
        /// Vertices of the cloth.
        cloth: usize,
    },
    /// Ropes are to be seen of an entity without cloth.
    #[error("there are no ropes to be seen: entity {entity} has no ClothSimulation")]
    NoCloth {
        /// Which entity.
        entity: Entity,
    },
    /// Ropes are to be seen of a cloth that has none.
    #[error("there are no ropes to be seen: the cloth of entity {entity} has no loose edges")]
    NoRopes {
        /// Which entity.
        entity: Entity,
    },
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
