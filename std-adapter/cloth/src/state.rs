//! What changes from step to step.

use selvedge_core::glam::DVec3;

/// All that the rest of a simulation depends on, but for the scene and the bodies that are let pass.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct State {
    /// Steps done.
    pub(crate) step: u64,
    /// Steps in which bodies or pins had to wait, or to be let pass.
    pub(crate) blocked_steps: u64,
    /// Of bodies and pins, in seconds; behind the time when they had to wait.
    pub(crate) clock: f64,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) velocities: Vec<DVec3>,
}
