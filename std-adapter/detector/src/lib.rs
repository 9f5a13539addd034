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
//! | `timing` | a clock for the seconds of each stage, which `verification` shows. Without it no clock is read |
//! | `verification` | the module of that name: parts of a step, for the project's own crates, which measure them, check them, or are built of them. Nothing is promised of it |
//!
//! Without any of them the crate needs neither threads nor a clock, as on `wasm32-unknown-unknown` (where nobody has run it yet).

// Some of these are public in `verification` alone.
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod broad_phase;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod buffer;
mod clock;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod coherent;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod collision_filter;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod dispatch;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod frame;
mod mesh;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod pair_counts;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod parallel;
#[cfg_attr(not(feature = "verification"), allow(dead_code, unreachable_pub, unused_imports))]
mod step;
#[cfg(feature = "verification")]
pub mod verification;
mod world;

pub use collision_filter::{CollisionFilter, Groups};
pub use frame::{Frame, StepError};
pub use mesh::{FeaturePair, Mesh, Topology, TopologyError, TopologyStatistics};
#[cfg(feature = "parallel")]
pub use parallel::{ThreadError, Threads};
pub use selvedge_core as core;
pub use selvedge_core::glam;
pub use selvedge_core::separation::geometry::Geometry;
pub use selvedge_core::{PairKind, ParsePairKindError, Position, Scalar};
pub use step::{Cancellation, CandidateBoxes, CollisionDetector, Contact, ContactGeometry, Criterion, Intersection, Truncation};
pub use world::{MeshHandle, MeshMotion, World, WorldContact, WorldContactGeometry, WorldError};

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
