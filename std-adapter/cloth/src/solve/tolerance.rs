//! The error that a solve may leave, and how the solve has ended.

use super::constants::{Accuracy, BESIDE_MOTION, QUIET, STILL};
use super::term::Prediction;

/// The tolerances of a solve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// The square of the accuracy.
    squared: f64,
    /// An energy that does not matter, in J.
    still: f64,
    /// Twice the energy of motion that is hardly visible, in J.
    quiet: f64,
    /// Twice the energy that the solve has mended so far, in J.
    pub(super) mended: f64,
    /// Twice the energy that may remain beside the motion, in J; infinite until [`bound_by`](Self::bound_by) knows the motion.
    beside_motion: f64,
}

impl Tolerance {
    /// `of_bodies` is the mass of free bodies, in kg.
    pub(super) fn new(accuracy: Accuracy, prediction: &Prediction, of_bodies: f64) -> Self {
        let masses = prediction.masses.iter().zip(&prediction.rate);
        let mass: f64 = masses.map(|(mass, rate)| mass * rate * rate).sum::<f64>() + of_bodies;
        Self {
            squared: accuracy.share().powi(2),
            still: mass * STILL * STILL,
            quiet: mass * QUIET * QUIET,
            mended: 0.0,
            beside_motion: f64::INFINITY,
        }
    }

    /// Returns twice the energy that may remain.
    pub(super) fn rest(&self) -> f64 {
        self.rest_of(self.mended).min(self.beside_motion)
    }

    /// Bounds what may remain by the motion since the first guess, whose square in the norm of the masses is `moved`.
    pub(super) fn bound_by(&mut self, moved: f64) {
        self.beside_motion = self.still.max(BESIDE_MOTION * self.squared * self.visible(moved));
    }

    /// Returns the square of a motion in the norm of the masses, or that of motion that is hardly visible if it is less.
    pub(super) const fn visible(&self, moved: f64) -> f64 {
        moved.max(self.quiet)
    }

    /// Returns whether the motion bounds what may remain.
    pub(super) const fn is_bounded(&self) -> bool {
        self.beside_motion < f64::INFINITY
    }

    /// Returns how much of twice an energy may remain.
    pub(super) fn rest_of(&self, changed: f64) -> f64 {
        // Below the quiet energy the error fades faster than what causes it, so that layers come to rest.
        let fading = if changed < self.quiet { changed / self.quiet } else { 1.0 };
        self.still.max(self.squared * changed * fading)
    }
}

/// How a solve ended.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    pub(crate) is_finished: bool,
    pub(crate) newton_steps: u32,
    pub(crate) iterations: u32,
}
