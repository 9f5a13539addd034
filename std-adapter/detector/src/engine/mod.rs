//! Decides the pairs of a step: candidates from the hierarchies, the caller or the coherent search, through filter and elementary test.

mod between;
mod chunk;
mod engine;
mod given;
mod question;
mod rest;
mod stop;
mod sweep;
mod truncation;
pub(crate) mod world;

pub(crate) use between::{Source, SourceEngine};
pub use engine::StepStatistics;
pub(crate) use engine::{Engine, Probe, in_format_of_positions};
pub(crate) use question::{Question, Wanted};
