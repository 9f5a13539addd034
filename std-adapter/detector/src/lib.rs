//! Finds which vertex–face and edge–edge pairs of a deforming triangle mesh can collide during a time step.
//!
//! The tests themselves, one pair at a time and without `std`, are [`selvedge_core`](crate::core). This crate adds what a mesh
//! needs: topology, hierarchies and threads.
//!
//! | module | what it is |
//! |---|---|
//! | [`mesh`] | triangle meshes in memory, and their topology |
//! | [`step`] | **start here**: [`CollisionDetector`], positions at the start and at the end of a step in, contacts with their times out |
//! | [`dispatch`] | the instruction set of the batched kernels |
//!
//! Mesh files are in the crate `selvedge-files`, cloth simulation in `selvedge-cloth`, the published methods and what compares them in
//! `selvedge-laboratory`.
//!
//! The feature `verification` shows parts of a step to those who measure and check it; users have no need of it.

// What the project's other crates use besides; nothing is promised of it.
#[doc(hidden)]
pub mod broad_phase;
pub mod dispatch;
#[doc(hidden)]
pub mod frame;
pub mod mesh;
mod pair_counts;
#[doc(hidden)]
pub mod parallel;
pub mod step;

pub use mesh::{Mesh, Topology};
pub use pair_counts::PairCounts;
pub use selvedge_core as core;
pub use selvedge_core::glam;
pub use selvedge_core::{PairKind, ParsePairKindError};
pub use step::{CollisionDetector, Contact};

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
