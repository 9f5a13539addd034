//! Decides the pairs of a step: candidates of hierarchies, lists or the coherent search, through filter and elementary test.
//!
//! A [`PairEngine`] decides the candidates of [sources](Source), one after the other. A [`MeshEngine`] has the two sources of one
//! mesh, and a [world](world) those of many.

mod chunk;
mod findings;
mod hinge_chunk;
mod intersections;
mod listed_pairs;
mod mesh_engine;
mod numbering;
mod pair_engine;
mod question;
mod rest;
mod source;
mod statistics;
mod stop;
mod sweep;
mod truncation;
pub(crate) mod world;

pub(crate) use mesh_engine::MeshEngine;
pub(crate) use pair_engine::{PairEngine, Refine, in_format_of_positions};
pub(crate) use question::{Question, Wanted};
pub(crate) use source::Source;
pub use statistics::StepStatistics;
pub use stop::DEFAULT_MEMORY_LIMIT;
