//! Moving air, which pushes triangles and loose edges.

mod drag;
mod sources;
pub(super) mod wind;
pub(super) mod wind_field;

pub(crate) use drag::Drag;
pub use sources::{Air, AirSource, Fan, Vortex};
pub use wind::Wind;
pub use wind_field::WindField;
