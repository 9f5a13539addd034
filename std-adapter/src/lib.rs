//! Finds which vertex–face and edge–edge pairs of a deforming triangle mesh can collide during a time step.
//!
//! The tests themselves, one pair at a time and without `std`, are [`selvedge_core`](crate::core). This crate adds all that
//! needs memory, files, threads or a clock:
//!
//! | module | what it is |
//! |---|---|
//! | [`mesh`] | triangle meshes and their topology, OBJ and PLY files, the paper's sleeve at any size |
//! | [`step`] | **start here**: positions at the start and at the end of a step in, contacts with their times out |
//! | [`broad_phase`] | candidate pairs: from hierarchies of moving boxes, or triangle pairs whose swept boxes overlap |
//! | [`pipeline`] | every published method, and ours, as a choice of stages, counted and timed |
//! | [`dispatch`] | the instruction set of the batched kernels |
//! | [`scene`] | the built-in motion: a sleeve on a bending arm |
//! | [`study`] | experiments: methods compared, cost against size, benchmark queries, accuracy against time (feature `accuracy`); data only |
//! | `hard_cases` | hard cases of the literature by name, with exact answers (feature `files`) |
//! | `simulation` | cloth in motion: scenes from TOML files, effects, contact with a certified pass (feature `simulation`) |
//! | `queries` | primitive-pair queries of the public benchmark, read exactly (feature `files`) |
//! | `report` | tables, CSV, JSON, plots, pictures (feature `report`) |
//!
//! `default-features = false` leaves a small library for a game engine: meshes in memory, broad phase, pipelines.
//! The feature `cli` (default) brings the `selvedge` command, and with it `accuracy`, `files`, `report` and
//! `simulation`.

pub mod broad_phase;
#[cfg(any(feature = "report", feature = "simulation"))]
mod bytes;
pub mod dispatch;
#[cfg(feature = "files")]
mod excerpt;
mod frame;
#[cfg(feature = "files")]
pub mod hard_cases;
pub mod mesh;
mod pair_counts;
mod parallel;
pub mod pipeline;
#[cfg(feature = "files")]
pub mod queries;
#[cfg(feature = "report")]
pub mod report;
pub mod scene;
#[cfg(feature = "simulation")]
pub mod simulation;
pub mod step;
pub mod study;
// For the command.
#[cfg(feature = "files")]
#[doc(hidden)]
pub mod temporary_file;

pub use pair_counts::PairCounts;
pub use selvedge_core as core;
pub use selvedge_core::glam;
pub use selvedge_core::{PairKind, ParsePairKindError};
