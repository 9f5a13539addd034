//! Cloth simulation that pays only for the effects that its scene calls for.
//!
//! A [`Scene`] is made in code or read from a TOML file; a [`Simulation`] runs it, step by step. An effect that the scene does not name
//! is not constructed, allocates nothing, runs nothing and is in no report.
//!
//! ```text
//! code, or a scene file ──▶ Scene ──▶ effects register into a plan ──▶ Simulation ◀── each step: bodies, pins, wind
//!                                                             │ each step
//!                          forces ▸ prediction ▸ constraints ▸ contacts ▸ friction ▸ certified pass ▸ velocities
//!
//! input ▸ world ▸ model ▸ contact ▸ effects ▸ scene ▸ display, simulate      each imports only what stands before it
//! ```
//!
//! | item | what it is |
//! |---|---|
//! | [`Scene`] | **start here**: what is to be simulated, from code or from a file |
//! | [`Cloth`], [`Body`], [`effects`] | what a scene consists of |
//! | [`Material`] | cotton, denim, silk, wool, leather, latex: what they weigh and resist |
//! | [`BodyMotion`], [`Animation`] | where bodies go: on keyframes, as frames or a skinned figure of a glTF file say, or as the caller does |
//! | [`Simulation`] | runs a scene: positions after each step, what each effect took, checkpoints |
//! | [`vertex_normals`], [`Tubes`] | to show cloth, and ropes, as triangles |
//! | [`effect_names`] | every effect that a scene may name |
//! | [`sleeve`] | the paper's sleeve at any size, of which scenes can be made |

#![forbid(unsafe_code)]
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that does nothing"
)]

mod contact;
mod display;
pub mod effects;
mod input;
mod model;
mod scene;
mod simulate;
mod world;

pub use contact::{ContactCounts, ContactSeconds, Crossing, ProximityPair};
pub use display::{Tubes, vertex_normals};
pub use effects::effect_names;
pub use input::{SceneError, ValueError};
pub use model::energy::{Energy, StoredEnergy};
pub use model::tearing::TornEdge;
pub use scene::{OnBlocked, Scene, TangledStart};
pub use selvedge::Mesh;
pub use selvedge_core::glam;
/// Readers of meshes, numbered frames and figures: what [`Animation`]s are made of.
pub use selvedge_files as files;
pub use simulate::{
    Blocked, CHECKPOINT_STEPS, CheckpointError, DriveError, EdgeStretch, EffectTime, FASTEST, SetupError, Simulation, Tangled,
    Untangled, UntanglingProgress,
};
pub use world::{Animation, Body, BodyMotion, Cloth, Keyframe, KeyframeMotion, Material, Placement, sleeve};

/// The scene of the paper's sleeve on a bending arm, as text for [`Scene::parse`].
pub const ARM_SLEEVE: &str = include_str!("../scenes/arm-sleeve.toml");

/// The scene of a skinned figure that walks in a shirt, as text: its files are `walker.glb` and `walker-shirt.ply` beside it.
pub const WALKER: &str = include_str!("../scenes/walker.toml");

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
