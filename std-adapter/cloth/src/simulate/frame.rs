//! Frames: the cloth makes as many steps as a frame of the caller needs.
//!
//! A step is good if little happens in it. Two measures are known before it is made:
//!
//! * **Length.** Steps of first order damp motion, and what begins to slide lags, the more, the longer the steps are: with 4
//!   ms the path on a slope is wrong by 0.9 %, with 8 ms by twice that (law of the inclined plane). So no step is longer than
//!   [`LONGEST_STEP_OF_FRAME`].
//! * **Speed.** Cloth that passes a face in one step meets it too late. So nothing near the cloth moves more than [`FARTHEST`] of
//!   the cloth's mean edge in a step, relative to the mean of the cloth. Bodies and pins are followed on the way that lies before
//!   them in the frame: to what the caller leads them to, from key to key, from pose to pose. What starts with a jerk has short
//!   steps from the first one on.
//!
//! The number of steps follows from the state and the scene alone. So it is the same for any number of threads, and after a
//! resume.

use super::errors::Blocked;
use super::simulation::Simulation;
use crate::input::{Field, TIME, ValueError};
#[cfg(doc)]
use crate::scene::LONGEST_STEP_OF_FRAME;
use crate::scene::steps_of_frame;
use selvedge_core::glam::DVec3;
use std::ops::ControlFlow;

/// The largest way near the cloth in a step, in mean edges.
const FARTHEST: f64 = 0.5;
/// The largest number of steps of a frame, unless the caller gives another one.
pub(super) const MOST_STEPS: u32 = 64;
const SECONDS: Field = Field::new("seconds", TIME, 1e-6, 1.0);

/// How many steps a frame took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameSteps {
    /// The number of steps that were done.
    pub steps: u32,
    /// The number of steps that the cloth needs. If that is more than were allowed, edges may be longer than their limit, and
    /// contacts act late.
    pub needed: u32,
}

/// The progress of a frame, after one of its steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameProgress {
    /// The number of steps of the frame that are done.
    pub steps: u32,
    /// The number of steps that the frame takes.
    pub of: u32,
    /// The time simulated so far, in seconds.
    pub time: f64,
    /// The number of steps since the start of the simulation.
    pub steps_done: u64,
}

/// A frame could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// A frame cannot take this time. Nothing has changed.
    #[error(transparent)]
    Seconds(#[from] ValueError),
    /// A step could not be made. The steps before it stay.
    #[error(transparent)]
    Blocked(#[from] Blocked),
}

impl Simulation {
    /// Advances by a frame of a game or a film, a microsecond to a second, in as many steps as the cloth needs (at most 64).
    ///
    /// The scene's own time step has no part in it. Bodies and pins that the caller moves do so evenly throughout the frame. A
    /// [checkpoint](Self::checkpoint) can be taken after the frame in which a multiple of
    /// [`CHECKPOINT_STEPS`](crate::CHECKPOINT_STEPS) was reached.
    ///
    /// ```
    /// use selvedge_cloth::effects::{Gravity, Stretch};
    /// use selvedge_cloth::glam::DVec3;
    /// use selvedge_cloth::{Cloth, Scene, Simulation};
    ///
    /// let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [10, 10], 0.15)?;
    /// let mut scene = Scene::new(sheet, 1e-3);
    /// scene.add(Gravity::default()).add(Stretch::isotropic(400.0));
    /// let mut simulation = Simulation::new(scene, 1)?;
    /// let frame = simulation.advance(1.0 / 60.0)?;
    /// assert_eq!((frame.steps, frame.needed), (4, 4));
    /// assert!((simulation.time() - 1.0 / 60.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the time is out of range, or a [step](Self::step) fails.
    pub fn advance(&mut self, seconds: f64) -> Result<FrameSteps, FrameError> {
        self.advance_within(seconds, MOST_STEPS)
    }

    /// Advances like [`advance`](Self::advance), in at most `most` steps, but at least one.
    ///
    /// # Errors
    /// Returns the errors of [`advance`](Self::advance).
    pub fn advance_within(&mut self, seconds: f64, most: u32) -> Result<FrameSteps, FrameError> {
        self.advance_while(seconds, most, &mut |_| ControlFlow::Continue(()))
    }

    /// Advances like [`advance_within`](Self::advance_within), and calls `tell` after each step. If that returns `Break`, the
    /// frame stops there, with fewer steps than it takes; bodies and pins that the caller moves are then on their way.
    ///
    /// # Errors
    /// Returns the errors of [`advance`](Self::advance).
    pub fn advance_while(
        &mut self,
        seconds: f64,
        most: u32,
        tell: &mut (dyn FnMut(FrameProgress) -> ControlFlow<()> + Send),
    ) -> Result<FrameSteps, FrameError> {
        SECONDS.check(seconds)?;
        Ok(self.run_frame(seconds, most, tell)?)
    }

    /// Returns how many steps a frame of so many seconds needs: see the [module](self).
    pub(super) fn steps_needed(&mut self, seconds: f64) -> u32 {
        let cloth = self.made.cloth_vertices;
        let mean = self.state.velocities[..cloth].iter().sum::<DVec3>() / cloth as f64;
        let Self {
            state,
            made,
            work,
            carried,
            ..
        } = self;
        let speeds = work.ahead.speeds(state, made, carried, seconds, mean);
        let positions = &state.positions;
        let of_cloth = speeds[..cloth].iter().copied().fold(0.0, f64::max);
        let low = positions[..cloth].iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = positions[..cloth].iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let of_bodies = positions[cloth..].iter().zip(&speeds[cloth..]).filter(|(position, speed)| {
            let reach = DVec3::splat((*speed + of_cloth) * seconds);
            position.cmpge(low - reach).all() && position.cmple(high + reach).all()
        });
        let fastest = of_bodies.map(|(_, speed)| *speed).fold(of_cloth, f64::max);
        let by_speed = fastest * seconds / (FARTHEST * made.mean_edge);
        // A number out of range becomes the nearest in it.
        steps_of_frame(seconds).max(by_speed.ceil()) as u32
    }
}
