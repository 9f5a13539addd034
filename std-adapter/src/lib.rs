//! Finds which vertex-face and edge-edge pairs of a deforming mesh can collide during a time step.

pub mod mesh;
pub mod scene;

pub use selvedge_core as core;
