//! Contacts of moving meshes in Bevy as messages, without a missed contact, and cloth whose bodies follow entities.
//!
//! **Start with [`SelvedgePlugin`]**: entities with a [`CollisionBody`] and a mesh take part, and each [`CollisionContact`] is a
//! message. A [`ClothSimulation`] moves the mesh of its entity. The readme explains the schedule.
//!
//! ```text
//! Transforms, meshes ──▶ place, shape ──▶ collisions: bodies of a World ──▶ CollisionContact └─▶ cloth: bodies of a Simulation
//! ──▶ meshes; ropes as tubes; Transforms of free bodies, and of bodies of an engine
//! ```

#[cfg(feature = "avian")]
mod avian;
mod body;
mod cloth;
mod collisions;
mod engine_body;
mod error;
mod free;
mod place;
#[cfg(feature = "rapier")]
mod rapier;
mod ropes;
mod seen;
mod shape;

#[cfg(feature = "avian")]
pub use avian::AvianBridge;
pub use body::{CollisionBody, CollisionGroups, CollisionMesh};
pub use cloth::{ClothMeshError, ClothSimulation, body_of_mesh, cloth_of_mesh, mesh_of, mesh_of_cloths};
pub use collisions::{CollisionContact, CollisionSettings};
pub use engine_body::EngineBody;
pub use error::{SelvedgeError, SelvedgeProblem};
#[cfg(feature = "rapier")]
pub use rapier::RapierBridge;
pub use ropes::RopesOf;
pub use selvedge;
pub use selvedge::core::elementary::Limits;
pub use selvedge::{Criterion, Geometry, Groups, PairKind, Threads};
pub use selvedge_cloth;
pub use shape::RenderMeshError;

use bevy_app::{App, FixedPostUpdate, Plugin};
use bevy_asset::{AssetEvent, Assets};
use bevy_ecs::schedule::{IntoScheduleConfigs, SystemSet};
use bevy_mesh::Mesh;
use bevy_time::{Fixed, Time};

/// The system sets of the plugin in each fixed step, in `FixedPostUpdate`, in this order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SelvedgeSystems {
    /// Cloths run their steps, write their meshes, and move the entities that follow free bodies.
    Cloth,
    /// The contacts of the step are found and written.
    Contacts,
}

/// Finds the contacts of all [`CollisionBody`]s, and moves all [`ClothSimulation`]s, in each fixed step.
///
/// The plugin needs `TransformPlugin`, `TimePlugin`, `AssetPlugin` and `MeshPlugin`, which are among Bevy's default plugins.
#[derive(Clone, Copy, Debug, Default)]
pub struct SelvedgePlugin;

impl Plugin for SelvedgePlugin {
    fn build(&self, app: &mut App) {
        // Without `MeshPlugin` there are no meshes, but nothing breaks.
        app.init_resource::<Assets<Mesh>>()
            .add_message::<AssetEvent<Mesh>>()
            .init_resource::<CollisionSettings>()
            .init_resource::<collisions::Collisions>()
            .add_message::<CollisionContact>()
            .add_message::<SelvedgeProblem>()
            .init_resource::<Time<Fixed>>()
            .configure_sets(FixedPostUpdate, (SelvedgeSystems::Cloth, SelvedgeSystems::Contacts).chain())
            .add_systems(
                FixedPostUpdate,
                (cloth::step_cloths, free::show_bodies, ropes::show_ropes)
                    .chain()
                    .in_set(SelvedgeSystems::Cloth),
            )
            .add_systems(FixedPostUpdate, collisions::find_contacts.in_set(SelvedgeSystems::Contacts));
    }
}

/// Runs the examples of the readme as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
