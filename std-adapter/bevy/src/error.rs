//! Problems, as messages.

use crate::RenderMeshError;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::{Message, MessageWriter};
use selvedge::WorldError;
use selvedge_cloth::{Blocked, DriveError, ValueError};

/// A problem of an entity. It is also logged as a warning, and everything else continues.
#[derive(Message, Clone, Debug, PartialEq)]
pub struct SelvedgeProblem {
    /// The entity; `None` for a problem of the [settings](crate::CollisionSettings) or of a whole step.
    pub entity: Option<Entity>,
    /// The problem.
    pub error: SelvedgeError,
}

/// The kinds of problems.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SelvedgeError {
    /// The mesh of a body cannot collide, or that of a cloth cannot be written. It is read again when the asset changes.
    #[error("its mesh cannot be used: {0}")]
    Mesh(#[from] RenderMeshError),
    /// A body or one of its ancestors has no `Transform`. Until that changes, it does not take part or stays where it is.
    #[error("it cannot be placed: entity {entity} has no Transform; give it one")]
    NoTransform {
        /// The entity without it.
        entity: Entity,
    },
    /// A `Transform` is not finite, or its rotation is zero. Until that changes, the body does not take part or stays where it
    /// is.
    #[error("it cannot be placed: its Transform or that of an ancestor is not finite or has a rotation of zero")]
    BadTransform,
    /// A body was refused: it is out of range, or there are too many bodies.
    #[error("{0}")]
    World(WorldError),
    /// The contacts of a step could not be found, for example because of the limit of pairs. The bodies are at the end of the
    /// step.
    #[error("the contacts of this step could not be found: {0}")]
    Step(WorldError),
    /// The scene of a cloth is invalid. It never starts.
    #[error("the scene cannot be simulated: {0}")]
    Setup(String),
    /// A cloth cannot continue without an intersection, and its scene stops then; see `Scene::on_blocked`.
    #[error("the cloth stops: {0}")]
    Blocked(Blocked),
    /// A body would have to follow its entity faster than 100 m/s. The cloth rests; see `ClothSimulation::teleport`.
    #[error("the cloth rests: {0}")]
    TooFast(Blocked),
    /// A followed body does not exist in the scene.
    #[error("there is no body {body}: the scene has {bodies}, numbered from 0")]
    NoBody {
        /// The index of the body.
        body: usize,
        /// The number of bodies.
        bodies: usize,
    },
    /// A body that an entity follows is not free: it has no mass. The entity stays.
    #[error("no entity can follow body {body}, which is not free: give it a `FreeMotion` (`mass` or `density` in a file)")]
    NotFree {
        /// The index of the body.
        body: usize,
    },
    /// A body cannot reach its entity, for example because it is more than a kilometre away. It stops on the way.
    #[error("a body cannot follow its entity: {0}")]
    Lead(DriveError),
    /// The entity of a body has a scale, which the body cannot follow. The body stays.
    #[error("entity {entity} has a scale, which its body cannot follow: give the body that size instead")]
    ScaledLeader {
        /// The entity.
        entity: Entity,
    },
    /// The fixed time step is no frame of cloth, which takes from a microsecond to a second. The cloth rests.
    #[error("the cloth cannot take this fixed time step: {0}")]
    FixedStep(ValueError),
    /// Cloth or bodies are too fast for a fixed step: edges may be longer than their limit, and contacts act late.
    #[error("the cloth needs {needed} steps in a fixed step, but does no more than {steps}: use a shorter fixed time step")]
    ShortOfSteps {
        /// The number of steps that were done.
        steps: u32,
        /// The number of steps that the cloth needs.
        needed: u32,
    },
    /// The physics engine does not make the fixed step, so that cloth pushes its bodies too much or too little.
    #[error("the engine's step is {}, but the fixed step is {cloth} s: make them the same, such as by `TimestepMode::Fixed`", .engine.map_or_else(|| "not fixed".to_owned(), |engine| format!("{engine} s")))]
    EngineStep {
        /// The engine's step in seconds, if it is fixed.
        engine: Option<f64>,
        /// The fixed step in seconds.
        cloth: f64,
    },
    /// The rendered mesh does not match the cloth.
    #[error(
        "its Mesh3d has {seen} vertices, but the cloth has {cloth}: give it the mesh that the cloth was made of, or `mesh_of`"
    )]
    OtherMesh {
        /// The number of vertices of the mesh.
        seen: usize,
        /// The number of vertices of the cloth.
        cloth: usize,
    },
    /// The entity whose ropes are shown has no cloth.
    #[error("no ropes to show: entity {entity} has no ClothSimulation")]
    NoCloth {
        /// The entity.
        entity: Entity,
    },
    /// The cloth whose ropes are shown has none.
    #[error("no ropes to show: the cloth of entity {entity} has no loose edges")]
    NoRopes {
        /// The entity.
        entity: Entity,
    },
    /// A setting was refused; the previous one remains.
    #[error("a setting was refused: {0}")]
    Setting(String),
}

pub(crate) fn tell(problems: &mut MessageWriter<'_, SelvedgeProblem>, entity: Option<Entity>, error: SelvedgeError) {
    match entity {
        Some(entity) => tracing::warn!("selvedge: entity {entity}: {error}"),
        None => tracing::warn!("selvedge: {error}"),
    }
    problems.write(SelvedgeProblem { entity, error });
}
