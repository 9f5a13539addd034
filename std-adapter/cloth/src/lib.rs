//! Cloth simulation in which every accepted state is free of intersections, and in which you pay only for the effects that you
//! use.
//!
//! You make a [`Scene`] in code or read it from a TOML file. A [`Simulation`] runs it step by step. If the scene does not name an
//! effect, the effect is not constructed, allocates nothing and runs nothing.
//!
//! ```text
//! code or scene file ──▶ Scene ──▶ effects register into a plan ──▶ Simulation ◀── per step: bodies, pins, wind
//!                                                              │ each step
//!                           forces ▸ prediction ▸ constraints ▸ contacts ▸ friction ▸ certified pass ▸ velocities
//!
//! identity, input ▸ world ▸ model ▸ contact ▸ effects ▸ scene ▸ display, simulate      each folder imports only from those before it
//! ```
//!
//! | item | meaning |
//! |---|---|
//! | [`Scene`] | **start here**: cloths, bodies and effects, from code or from a file |
//! | [`Cloth`], [`Body`], [`effects`] | the parts of a scene |
//! | [`Material`] | cotton, denim, silk, wool, leather, latex: density and stiffness |
//! | [`BodyMotion`], [`Animation`] | how bodies move: along keyframes, by a file's frames or skeleton, or as the caller says |
//! | [`Simulation`] | runs a scene; gives positions, loads, energy, statistics and checkpoints |
//! | [`vertex_normals`], [`Tubes`] | cloth and ropes as triangles for display |
//! | [`effect_names`] | all effects that a scene file may name |
//! | [`sleeve`] | the sleeve of the paper at any resolution |
//!
//! Units are SI throughout: metres, kilograms, seconds, newtons, radians.
//!
//! | feature | adds |
//! |---|---|
//! | `gltf` | bodies from glTF files |
//! | `timing` | a clock, so that [`Simulation::effects`] and [`Simulation::contact_seconds`] count seconds; without it they are zero |

#![forbid(unsafe_code)]
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that does nothing"
)]

mod contact;
mod display;
pub mod effects;
mod identity;
mod input;
mod model;
mod scene;
mod simulate;
mod solve;
mod world;

pub use contact::{ContactCounts, ContactSeconds, Crossing, ProximityPair};
pub use display::{Tubes, vertex_normals};
pub use effects::effect_names;
pub use identity::{Identify, Identity};
pub use input::{NamedMesh, SceneContext, SceneError, ValueError};
pub use model::energy::{Energy, StoredEnergy};
pub use model::tearing::TornEdge;
pub use scene::{OnBlocked, Scene, TangledStart};
pub use selvedge::Mesh;
pub use selvedge_core::glam;
/// Readers of meshes, numbered frames and figures, from which [`Animation`]s are made.
pub use selvedge_files as files;
pub use simulate::{
    Blocked, BodyLoad, CHECKPOINT_STEPS, CheckpointError, ContactLoad, DriveError, EdgeStretch, EffectTime, FASTEST, FrameError,
    FrameProgress, FrameSteps, FreeBodyState, SetupError, Simulation, Tangled, TeleportError, Untangled, UntanglingEnd,
    UntanglingProgress, Wrench,
};
pub use solve::{Accuracy, SolveCounts};
pub use world::{
    Animation, Body, BodyMass, BodyMotion, BroughtBody, Cloth, FreeMotion, Interpolation, Keyframe, KeyframeMotion, LockedAxes,
    Material, MeshInFiles, Placement, sleeve,
};

/// The scene of the paper's sleeve on a bending arm, as text for [`Scene::parse`].
pub const ARM_SLEEVE: &str = include_str!("../scenes/arm-sleeve.toml");

/// The files of a scene in which a skinned figure walks in a shirt, by name. The scene file refers to the other two.
pub const WALKER: [(&str, &[u8]); 3] = [
    ("walker.toml", include_bytes!("../scenes/walker.toml")),
    ("walker.glb", include_bytes!("../scenes/walker.glb")),
    ("walker-shirt.ply", include_bytes!("../scenes/walker-shirt.ply")),
];

/// Runs the readme's examples as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
