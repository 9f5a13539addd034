//! Finds which vertex–face and edge–edge pairs of a deforming triangle mesh can collide during a time step.
//!
//! **Start at [`CollisionDetector`]**: positions at the start and at the end of a step in, contacts with their times out.
//! [`Topology`] is what it needs to know of the mesh, once.
//!
//! The tests themselves, one pair at a time and without `std`, are [`selvedge_core`](crate::core). This crate adds what a mesh
//! needs: topology, hierarchies and threads. Mesh files are in the crate `selvedge-files`, cloth simulation in `selvedge-cloth`, the
//! published methods and what compares them in `selvedge-laboratory`.
//!
//! # Features
//! They only add.
//!
//! | feature | what it adds |
//! |---|---|
//! | `parallel` (on by default) | [`Threads`]: steps on several threads, by rayon. Without it the calling thread does all |
//! | `timing` | a clock for the seconds of each stage in [`StepStatistics`]. Without it no clock is read |
//!
//! Without any of them the crate needs neither threads nor a clock, as on `wasm32-unknown-unknown` (where nobody has run it yet).

#![forbid(unsafe_code)]

mod api;
pub mod broad_phase;
mod buffer;
pub mod clock;
pub mod coherent;
mod engine;
mod mesh;
mod pair_counts;
pub mod parallel;
pub mod simd;
mod step;

pub use api::{
    CandidateBoxes, CollisionDetector, ContactGeometry, Criterion, MeshMotion, World, WorldContact, WorldContactGeometry,
    WorldError,
};
pub use engine::world::MeshHandle;
pub use engine::{DEFAULT_MEMORY_LIMIT, StepStatistics};
pub use mesh::{FeaturePair, Mesh, Topology, TopologyError, TopologyStatistics, WeldedMesh, first_coincident};
pub use pair_counts::PairCounts;
#[cfg(feature = "parallel")]
pub use parallel::{ThreadError, Threads};
pub use selvedge_core as core;
pub use selvedge_core::glam;
pub use selvedge_core::separation::geometry::Geometry;
pub use selvedge_core::{PairKind, ParsePairKindError, Position, Scalar};
pub use step::{
    Cancellation, CollisionFilter, Contact, Frame, Groups, Intersection, StepError, Truncation, check_frames, check_length,
};

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
