//! Errors that prevent a simulation from starting, or a step from being made.

use super::tangled::Tangled;
use crate::input::ValueError;
use crate::world::FASTEST_VERTEX;
use selvedge::{StepError, ThreadError, TopologyError};
use std::fmt;

/// A step that was not made: it would have caused an intersection, or the caller moves a body or pins too fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocked {
    /// The time in the simulation, in seconds.
    pub time: f64,
    /// A description of the pair that is in the way, or of what is too fast.
    pub what: String,
    /// The body that is in the way or too fast; `None` if it is a pin.
    pub body: Option<String>,
    /// The speed in m/s of what the caller moves too fast; `None` if something is in the way. Then nothing has moved, and the
    /// motions that the caller has set for this step are dropped.
    pub speed: Option<f64>,
}

impl fmt::Display for Blocked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { time, what, .. } = self;
        if let Some(speed) = self.speed {
            return write!(
                f,
                "{what} is to move at {speed:.0} m/s at {time:.6} s, but must not be faster than {FASTEST_VERTEX} m/s; `teleport` moves it, and \
                 the cloth that hangs on it, without a step"
            );
        }
        write!(f, "blocked at {time:.6} s: no motion was found that leaves {what} free")?;
        match &self.body {
            Some(body) => write!(f, " of the body '{body}'"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Blocked {}

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
