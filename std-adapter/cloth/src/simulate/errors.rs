//! Why a simulation cannot begin, or cannot make a step.

use super::tangled::Tangled;
use crate::input::ValueError;
use selvedge::{StepError, ThreadError, TopologyError};

/// A step that could not be made without an intersection, and was not.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "blocked at {time:.6} s: no motion was found that leaves {what} free{}",
    .body.as_ref().map_or(String::new(), |body| format!(" of the body '{body}'"))
)]
pub struct Blocked {
    /// In seconds.
    pub time: f64,
    /// The pair that is in the way, in words.
    pub what: String,
    /// The body that is in the way; `None` if it is a pin.
    pub body: Option<String>,
}

/// A simulation could not be set up.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// Cloth and bodies together have too many triangles.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// Something in the scene cannot be.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The scene starts with surfaces that pass through each other, which no certificate can end.
    #[error(transparent)]
    Tangled(Box<Tangled>),
    /// A position is not finite.
    #[error(transparent)]
    Positions(#[from] StepError),
    /// The operating system refused the threads.
    #[error(transparent)]
    Threads(#[from] ThreadError),
}
