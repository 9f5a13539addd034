//! What changes from step to step.

use crate::contact::ContactSolver;
use selvedge_core::glam::DVec3;

/// In m/s: twice the speed of sound and more. What would move faster is slowed down to this.
pub const FASTEST: f64 = 1000.0;

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

impl State {
    /// Has contact forget all but the state, which everything is expected to go on from straight ahead in steps of `h` seconds: so a
    /// simulation that goes on from here, and one that is resumed here, are alike.
    pub(super) fn begin_anew(&self, contact: &mut ContactSolver, h: f64) {
        let ways = self.positions.iter().zip(&self.velocities);
        let end: Vec<_> = ways
            .map(|(&position, &velocity)| position + limited(velocity, FASTEST) * h)
            .collect();
        contact.refresh(&self.positions, &end, h);
    }
}

/// The vector, no longer than `longest`; zero if it is not finite.
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
