//! Cloth simulation that pays only for the effects that its scene calls for.
//!
//! A [`Scene`] is read from a TOML file; a [`Simulation`] runs it, step by step. An effect that the scene does not name is not
//! constructed, allocates nothing, runs nothing and is in no report.
//!
//! ```text
//! scene file ──▶ Scene ──▶ effects register into a plan ──▶ Simulation
//!                                                             │ each step
//!                          forces ▸ prediction ▸ constraints ▸ contacts ▸ friction ▸ certified pass ▸ velocities
//!
//! what is asked      input ▸ world ▸ scene
//! what is simulated  effects ▸ plan, step
//! how                membrane, hierarchy, schedule, contact, simulator
//! what changes       state ▸ checkpoint
//! ```
//!
//! | item | what it is |
//! |---|---|
//! | [`Scene`] | **start here**: what a scene file says, checked |
//! | [`Simulation`] | runs a scene: positions after each step, what each effect took, checkpoints |
//! | [`effect_names`] | every effect that a scene may name |
//! | [`sleeve`] | the paper's sleeve at any size, of which scenes can be made |

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that does nothing"
)]

mod checkpoint;
mod contact;
mod effects;
mod hierarchy;
mod input;
mod membrane;
mod plan;
mod scene;
mod schedule;
mod simulator;
pub mod sleeve;
mod state;
mod step;
mod world;

pub use checkpoint::CheckpointError;
pub use contact::{Blocker, ContactCounts, ContactSeconds};
pub use effects::effect_names;
pub use input::SceneError;
pub use scene::{OnBlocked, Scene};
pub use simulator::{Blocked, CHECKPOINT_STEPS, EdgeStretch, EffectTime, FASTEST, SetupError, Simulation};
pub use world::{Body, Cloth, RigidMotion};

/// The scene of the paper's sleeve on a bending arm, as text for [`Scene::parse`].
pub const ARM_SLEEVE: &str = include_str!("../scenes/arm-sleeve.toml");

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
