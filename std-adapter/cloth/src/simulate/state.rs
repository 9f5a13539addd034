//! The part of a simulation that changes from step to step.

use crate::contact::ContactSolver;
use selvedge_core::glam::DVec3;
use serde::{Deserialize, Serialize};

/// The largest speed, in m/s: more than twice the speed of sound. Faster vertices are slowed down to it.
pub const FASTEST: f64 = 1000.0;

/// The state that the rest of a simulation depends on, besides the scene and the bodies that are let pass.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    pub(crate) step: u64,
    /// The number of steps in which bodies or pins had to wait, or to be let pass.
    pub(crate) blocked_steps: u64,
    /// The number of steps at whose end an edge was longer than its limit by more than the tolerance.
    pub(crate) overstretched_steps: u64,
    /// The time before the last steps of the scene's length, in seconds.
    pub(crate) before: f64,
    /// The number of these steps.
    pub(crate) since: u64,
    /// The time of bodies and pins, in seconds; behind the time of the simulation if they had to wait.
    pub(crate) clock: f64,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) velocities: Vec<DVec3>,
}

impl State {
    /// Returns the time in seconds, if the scene's steps take `h` seconds each.
    pub(super) fn time(&self, h: f64) -> f64 {
        self.before + self.since as f64 * h
    }

    /// Makes contact discard all data but the state; steps of `h` seconds are expected to follow, straight ahead. So a simulation
    /// that continues from here, and one that is resumed here, are alike.
    pub(super) fn begin_anew(&self, contact: &mut ContactSolver, h: f64) {
        let moves = self.positions.iter().zip(&self.velocities);
        let end: Vec<_> = moves
            .map(|(&position, &velocity)| position + limited(velocity, FASTEST) * h)
            .collect();
        contact.refresh(&self.positions, &end, h);
    }
}

/// The vector, shortened to `longest`; zero if it is not finite.
pub(super) fn limited(vector: DVec3, longest: f64) -> DVec3 {
    let squared = vector.length_squared();
    if squared <= longest * longest {
        vector
    } else if squared.is_finite() {
        vector * (longest / squared.sqrt())
    } else {
        DVec3::ZERO
    }
}
