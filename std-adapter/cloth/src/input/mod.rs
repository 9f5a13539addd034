//! Input: ranges of numbers ([`Field`]), and the tables and quantities of a scene file. Every error names its place.

mod context;
mod error;
mod field;
mod quantity;
mod table;

pub use context::{NamedMesh, SceneContext};
pub use error::SceneError;
pub(crate) use error::suggestion;
pub use field::ValueError;
pub(crate) use field::{Count, Field};
pub(crate) use quantity::{
    ACCELERATION, AIR_DENSITY, ANGLE, ANGULAR_SPEED, AREA_DENSITY, BENDING_STIFFNESS, CURVATURE, FORCE, FREQUENCY,
    LARGEST_COORDINATE, LARGEST_TIME, LENGTH, LINEAR_DENSITY, MASS, MEMBRANE_STIFFNESS, PRESSURE, RATIO, ROPE_BENDING_STIFFNESS,
    SPEED, TIME,
};
pub(crate) use table::{Source, Table};
