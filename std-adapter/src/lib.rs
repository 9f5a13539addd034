//! Finds which vertex–face and edge–edge pairs of a deforming triangle mesh can collide during a time step.

pub mod broad_phase;
pub mod dispatch;
#[cfg(feature = "files")]
mod excerpt;
pub mod mesh;
mod pair_kind;
mod parallel;
pub mod pipeline;
#[cfg(feature = "files")]
pub mod queries;
#[cfg(feature = "report")]
pub mod report;
pub mod scene;
pub mod study;

pub use pair_kind::{PairKind, ParsePairKindError};
pub use selvedge_core as core;
pub use selvedge_core::glam;
