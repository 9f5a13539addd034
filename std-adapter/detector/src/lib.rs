//! Finds the vertex–face and edge–edge contacts of a deforming triangle mesh during a time step, and never misses one.
//!
//! **Start at [`CollisionDetector`]**: it takes positions at the start and at the end of a step, and returns contacts with their
//! times. [`Topology`] holds the mesh's vertices, edges and faces and is made once. [`World`] is a detector for several meshes
//! that come and go.
//!
//! | module | contents |
//! |---|---|
//! | this one | detector, world, topology, collision filters, errors |
//! | [`coherent`] | near pairs that are followed from step to step, for solvers with contact handling of their own |
//! | [`broad_phase`] | hierarchies of moving boxes, for stages of your own |
//! | [`parallel`] | threads, and loops that are split between them |
//! | [`simd`] | instruction sets |
//!
//! Tests of single pairs, without `std`, are in [`selvedge_core`](crate::core). Mesh files are in the crate `selvedge-files`,
//! cloth simulation in `selvedge-cloth`, and the published methods with their comparison in `selvedge-laboratory`.
//!
//! # Features
//! | feature | effect |
//! |---|---|
//! | `parallel` (on by default) | [`Threads`]: steps on several threads, by rayon. Without it, the calling thread does everything |
//! | `timing` | a clock for the seconds in [`StepStatistics`]. Without it, no clock is read |
//!
//! Without features the crate needs neither threads nor a clock. On `wasm32-unknown-unknown`, `timing` reads JavaScript's clock.

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
pub use mesh::{
    Adjacency, Components, FeaturePair, Mesh, Topology, TopologyError, TopologyStatistics, WeldedMesh, first_coincident,
};
pub use pair_counts::PairCounts;
#[cfg(feature = "parallel")]
pub use parallel::{ThreadError, Threads};
pub use selvedge_core as core;
pub use selvedge_core::glam;
pub use selvedge_core::separation::geometry::Geometry;
pub use selvedge_core::{PairKind, ParsePairKindError, Position, Scalar};
pub use step::{Cancellation, CollisionFilter, Contact, Frame, Groups, Intersection, StepError, Truncation, check_frames};

/// Runs the examples of the readme as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
