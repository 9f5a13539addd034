//! Steps of bodies and pins that wait (`hold`) because the motion that they want is not possible.
//!
//! To find that out takes many times as long as a free step, and after a step that waited the same motion is most often
//! impossible again. So it is tried again only after 1, 4, 16, 64, 64 … steps, and then its shortest part first. In the steps
//! between, bodies and pins stay where they are. A motion that becomes possible is noticed within 64 steps, and sooner if it was
//! impossible for less time. Any other motion, such as one that the caller sets, is tried at once.

use super::simulation::Simulation;
use crate::scene::OnBlocked;
use crate::world::{Kinematic, Pose};

/// The pause between two trials grows by this factor, up to the largest pause, in steps.
const GROWTH: u64 = 4;
const LARGEST_PAUSE: u64 = 64;

/// A motion that was not possible.
#[derive(Clone, Debug)]
pub(super) struct Waiting {
    /// The poses that bodies and pins were to reach.
    wanted: Vec<Pose>,
    /// The number of the step in which it is tried again.
    again: u64,
    pause: u64,
}

/// What a step does with a motion that was not possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Waits {
    /// The motion is another one.
    No,
    /// It tries the motion again, in short parts.
    Tries,
    /// Bodies and pins stay where they are.
    Stays,
}

impl Simulation {
    /// Decides about a step of `h` seconds.
    pub(super) fn waits_again(&self, h: f64) -> Waits {
        match &self.waiting {
            Some(waiting) if self.wanted(h).as_ref() == Some(&waiting.wanted) => {
                if self.state.step < waiting.again {
                    Waits::Stays
                } else {
                    Waits::Tries
                }
            }
            _ => Waits::No,
        }
    }

    /// Notes that bodies and pins have to wait for the rest of the step, of `left` seconds.
    pub(super) fn has_waited(&mut self, left: f64) {
        let wanted = self.wanted(left).filter(|_| self.on_blocked == OnBlocked::Hold);
        let before = self.waiting.take();
        self.waiting = wanted.map(|wanted| {
            let is_same = |waiting: &&Waiting| waiting.wanted == wanted;
            let pause = before.as_ref().filter(is_same).map_or(1, |waiting| waiting.pause * GROWTH);
            let pause = pause.min(LARGEST_PAUSE);
            let again = self.state.step + 1 + pause;
            Waiting { wanted, again, pause }
        });
    }

    /// Returns the poses at the end of `h` seconds; `None` if points move on paths of their own, which poses do not tell.
    fn wanted(&self, h: f64) -> Option<Vec<Pose>> {
        let motions = &self.made.motions;
        let deforms = |motion: &Kinematic| motion.driven().is_some_and(|driven| driven.deforms());
        let clock = self.state.clock;
        (!motions.iter().any(deforms)).then(|| motions.iter().map(|motion| motion.pose(clock + h)).collect())
    }
}
