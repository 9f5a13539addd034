//! The public interface: detector and world, with settings and results.

#[cfg(test)]
mod ageing;
mod criterion;
mod detector;
mod geometry;
mod intersections;
mod limits;

mod statistics;
mod world;
mod world_contacts;
mod world_error;
mod world_geometry;

pub use criterion::{CandidateBoxes, Criterion};
pub use detector::CollisionDetector;
pub use geometry::ContactGeometry;
pub use world::{MeshMotion, World};
pub use world_contacts::{WorldContact, WorldContactGeometry};
pub use world_error::WorldError;
