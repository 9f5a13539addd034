//! Errors that prevent a simulation from starting, or a step from being made.

use super::tangled::Tangled;
use crate::input::ValueError;
use selvedge::{StepError, ThreadError, TopologyError};

/// A step that was not made because it would have caused an intersection.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "blocked at {time:.6} s: no motion was found that leaves {what} free{}",
    .body.as_ref().map_or(String::new(), |body| format!(" of the body '{body}'"))
)]
pub struct Blocked {
    /// The time in the simulation, in seconds.
    pub time: f64,
    /// A description of the pair that is in the way.
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
    /// The scene is not valid.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// Surfaces pass through each other at the start of the scene, so that no certificate is possible.
    #[error(transparent)]
    Tangled(Box<Tangled>),
    /// A position is not finite.
    #[error(transparent)]
    Positions(#[from] StepError),
    /// The operating system refused the threads.
    #[error(transparent)]
    Threads(#[from] ThreadError),
}
