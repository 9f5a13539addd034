//! Finds which vertex-face and edge-edge pairs of a deforming mesh can collide during a time step.
pub use selvedge_core as core;

#[cfg(feature = "files")]
pub mod queries;
