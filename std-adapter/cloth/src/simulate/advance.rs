//! A step: whole, or in as many [substeps](super::substep) as it needs.

use super::assembly::Assembly;
use super::checkpoint::CHECKPOINT_STEPS;
use super::errors::Blocked;
use super::frame::{FrameProgress, FrameSteps, MOST_STEPS};
use super::simulation::Simulation;
use super::state::FASTEST;
use super::substep::Overstretched;
use super::waiting::Waits;
use crate::contact::Blocker;
use crate::model::step::Carrier;
use crate::scene::OnBlocked;
use crate::world::Kinematic;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::carried::LARGEST_TURN;
use std::ops::ControlFlow;

/// The shortest part of a step that is tried, so that a step has an end. It is in steps, or in parts of one in which nothing
/// turns too far.
const SHORTEST: f64 = 1.0 / 64.0;

/// The longest part of a step that may end with overstretched edges, in shortest parts: a quarter of a step.
const LONGEST_OVERSTRETCHED: f64 = 0.25 / SHORTEST;

/// The shortest rest of a step that is another part, over the last part. A shorter one is rounding, which is about 1e-15.
const SHORTEST_REST: f64 = 1e-9;

/// A step that ends with an edge longer than this, over its limit, is counted.
const OVERSTRETCHED: f64 = 1.05;

/// The progress of the clock of bodies and pins in a step.
enum BodyClock {
    Went,
    Waited,
}

/// Returns what is left of a step after a part of `h` seconds. A rest as short as rounding is none: its speed would be infinite.
fn rest_of(left: f64, h: f64) -> f64 {
    let rest = left - h;
    if rest > SHORTEST_REST * h { rest } else { 0.0 }
}

impl Simulation {
    /// Makes one step.
    ///
    /// # Errors
    /// Returns an error if bodies or pins force the cloth where it cannot go without intersecting, and the scene stops then. The
    /// part of the step that was made remains.
    pub fn step(&mut self) -> Result<(), Blocked> {
        let h = self.time_step;
        self.drive(h, |simulation| {
            simulation.leave_proxies(1);
            let clock = simulation.whole_step(h)?;
            simulation.state.since += 1;
            Ok(clock)
        })
    }

    /// Makes one step, or in a scene [by frames](crate::Scene::by_frames) one [frame](Self::advance).
    /// [`Scene::steps`](crate::Scene::steps) is their number in the scene's duration.
    ///
    /// # Errors
    /// Returns the errors of [`step`](Self::step).
    pub fn run(&mut self) -> Result<(), Blocked> {
        match self.frame {
            None => self.step(),
            Some(seconds) => self
                .run_frame(seconds, MOST_STEPS, &mut |_| ControlFlow::Continue(()))
                .map(drop),
        }
    }

    /// Makes the steps of one frame of so many seconds, at most `most` of them, until `tell` stops it.
    ///
    /// # Errors
    /// Returns the errors of [`step`](Self::step).
    pub(super) fn run_frame(
        &mut self,
        seconds: f64,
        most: u32,
        tell: &mut (dyn FnMut(FrameProgress) -> ControlFlow<()> + Send),
    ) -> Result<FrameSteps, Blocked> {
        let end = self.time() + seconds;
        let (mut done, mut needed) = (0, 0);
        self.drive(seconds, |simulation| {
            needed = simulation.steps_needed(seconds);
            let steps = needed.min(most).max(1);
            let h = seconds / f64::from(steps);
            simulation.leave_proxies(steps);
            let mut of_frame = BodyClock::Went;
            while done < steps {
                if matches!(simulation.whole_step(h)?, BodyClock::Waited) {
                    of_frame = BodyClock::Waited;
                }
                done += 1;
                (simulation.state.before, simulation.state.since) = (end - f64::from(steps - done) * h, 0);
                let progress = FrameProgress {
                    steps: done,
                    of: steps,
                    time: simulation.time(),
                    steps_done: simulation.state.step,
                };
                if tell(progress).is_break() && done < steps {
                    // Bodies have not arrived.
                    return Ok(BodyClock::Waited);
                }
            }
            Ok(of_frame)
        })?;
        Ok(FrameSteps { steps: done, needed })
    }

    /// Runs steps of so many seconds in all, during which the caller's bodies and pins move evenly.
    fn drive(&mut self, seconds: f64, steps: impl FnOnce(&mut Self) -> Result<BodyClock, Blocked> + Send) -> Result<(), Blocked> {
        // The threads are taken out so that they can run code that borrows the rest.
        let threads = std::mem::take(&mut self.threads);
        let clock = self.state.clock;
        let anchors = self.made.anchors();
        for (carrier, motion) in (0..).zip(&mut self.made.motions) {
            let own = anchors.iter().filter(|anchor| anchor.carrier == carrier);
            let own = own.filter_map(|anchor| Some((anchor.index?, anchor.place)));
            if let Some(driven) = motion.driven_mut() {
                driven.begin(clock, seconds, [&self.state.positions, &self.carried], own);
            }
        }
        if let Some(too_fast) = self.first_too_fast().or_else(|| self.begin_proxies(seconds)) {
            self.drop_goals();
            self.threads = threads;
            return Err(too_fast);
        }
        let done = self.state.step;
        self.loads.begin_run();
        self.is_fresh = false;
        let result = threads.run(|| {
            let result = steps(self);
            // A multiple may be in the middle of a frame.
            if done / CHECKPOINT_STEPS < self.state.step / CHECKPOINT_STEPS {
                if let Some(contact) = &mut self.made.contact {
                    self.state.begin_anew(contact, self.time_step);
                }
                if let Some(tearing) = &mut self.tearing {
                    tearing.waiting.clear();
                }
                self.waiting = None;
                self.is_fresh = true;
            }
            result
        });
        self.added_forces.0.clear();
        let clock = self.state.clock;
        let has_arrived = matches!(result, Ok(BodyClock::Went));
        for driven in self.made.motions.iter_mut().filter_map(Kinematic::driven_mut) {
            driven.end(clock, has_arrived);
        }
        self.end_proxies();
        self.threads = threads;
        result.map(drop)
    }

    fn whole_step(&mut self, h: f64) -> Result<BodyClock, Blocked> {
        let mut left = h;
        let mut of_the_step = BodyClock::Went;
        let mut was_blocked = false;
        let shortest = SHORTEST * self.without_large_turn(left);
        let waited = self.waits_again(h);
        // The same motion failed a moment ago, so that not even a short part of it is likely to be possible.
        let mut longest = if waited == Waits::Tries { shortest } else { left };
        if waited == Waits::Stays {
            self.attempt(left, 0.0, Overstretched::Accepted)
                .map_err(|blocker| self.described(blocker))?;
            left = 0.0;
            (of_the_step, was_blocked) = (BodyClock::Waited, true);
        }
        while left > 0.0 {
            let blocker = match self.part(left.min(longest), shortest) {
                Ok(h) => {
                    left = rest_of(left, h);
                    // The next parts are likely to need to be as short; they are tried with twice that at most.
                    longest = 2.0 * h;
                    continue;
                }
                Err(blocker) => blocker,
            };
            was_blocked = true;
            match (self.on_blocked, blocker.body, &mut self.made.contact) {
                (OnBlocked::Yield, Some(body), Some(contact)) => contact.let_pass(body),
                (OnBlocked::Yield | OnBlocked::Hold, ..) => {
                    self.has_waited(left);
                    // If nothing is forced to move, a step can always be made.
                    self.attempt(left, 0.0, Overstretched::Accepted)
                        .map_err(|blocker| self.described(blocker))?;
                    left = 0.0;
                    of_the_step = BodyClock::Waited;
                }
                (OnBlocked::Stop, ..) => return Err(self.described(blocker)),
            }
        }
        self.state.step += 1;
        self.state.blocked_steps += u64::from(was_blocked);
        self.state.overstretched_steps += u64::from(self.longest_over_limit().is_some_and(|over| over > OVERSTRETCHED));
        if let Some(contact) = &mut self.made.contact {
            contact.take_back(&self.state.positions);
        }
        self.tear();
        Ok(of_the_step)
    }

    /// Returns the length of the longest edge over its [limit](crate::effects::StrainLimit); `None` without a limit. If it is
    /// more than 1.05 after a step, use shorter steps, or [frames](Self::advance).
    #[must_use]
    pub fn longest_over_limit(&self) -> Option<f64> {
        self.made.solve.longest_over_limit(&self.state.positions)
    }

    /// Advances by as much of `left` seconds as possible, and returns how much. It tries half of it if that fails, and so on, but
    /// not less than `shortest`.
    fn part(&mut self, left: f64, shortest: f64) -> Result<f64, Blocker> {
        let mut h = self.without_large_turn(left);
        loop {
            let overstretched = if h > LONGEST_OVERSTRETCHED * shortest {
                Overstretched::Refused
            } else {
                Overstretched::Accepted
            };
            match self.attempt(h, h, overstretched) {
                Err(_) if 0.5 * h >= shortest => {
                    h *= 0.5;
                    if let Some(contact) = &mut self.made.contact {
                        contact.counts.cuts += 1;
                    }
                }
                result => return result.map(|()| h),
            }
        }
    }

    /// Returns `h`, halved until no body or pin turns by more in that time than contact can certify. A body that is
    /// [far](Self::is_far) from all cloth may turn by any angle.
    fn without_large_turn(&self, mut h: f64) -> f64 {
        if self.made.contact.is_none() {
            return h;
        }
        let clock = self.state.clock;
        let turns_too_far = |carrier: usize, h: f64| {
            let motion = &self.made.motions[carrier];
            (motion.pose(clock + h).angle - motion.pose(clock).angle).abs() > LARGEST_TURN
        };
        for carrier in 0..self.made.motions.len() {
            if turns_too_far(carrier, h) && !self.is_far(carrier, h) {
                while turns_too_far(carrier, h) {
                    h *= 0.5;
                }
            }
        }
        self.without_large_turn_of_free(h)
    }

    /// Returns `h`, halved until the vertices of free bodies leave their straight ways by less than the separation at their
    /// present spin.
    fn without_large_turn_of_free(&self, mut h: f64) -> f64 {
        let Some(separation) = self
            .made
            .contact
            .as_ref()
            .and_then(|contact| contact.separation_from_bodies())
        else {
            return h;
        };
        for free in self.made.motions.iter().filter_map(Kinematic::free) {
            let turn = free.spin_of(&free.state).length();
            // The arc of a turn θ at the distance r is up to r·(1 − cos(θ/2)) ≤ r·θ²/8 from its chord.
            let most = (8.0 * separation / free.radius()).sqrt();
            while turn * h > most {
                h *= 0.5;
            }
        }
        h
    }

    /// Returns whether a body that carries no cloth cannot meet any within `h` seconds, however it turns. The ball about its
    /// centre of rotation that contains it must be farther from the box of the cloth than the two can move.
    fn is_far(&self, carrier: usize, h: f64) -> bool {
        let Assembly {
            body_vertices,
            carriers,
            cloth_vertices,
            motions,
            ..
        } = &self.made;
        let (cloth, carriers) = (&self.state.positions[..*cloth_vertices], &carriers[..*cloth_vertices]);
        let Some(own) = body_vertices.get(carrier) else { return false };
        let [now, then] = [0.0, h].map(|later| motions[carrier].pose(self.state.clock + later));
        if !(now.is_rigid() && then.is_rigid()) || carriers.contains(&(carrier as Carrier)) {
            return false;
        }
        let low = cloth.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = cloth.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = now.centre();
        let own = self.state.positions[own.clone()].iter();
        let radius = own.map(|point| point.distance(centre)).fold(0.0, f64::max);
        let moved = centre.distance(then.centre()) + 2.0 * FASTEST * h;
        (low - centre).max(centre - high).max(DVec3::ZERO).length() > radius + moved
    }

    fn described(&self, blocker: Blocker) -> Blocked {
        Blocked {
            time: blocker.time,
            what: blocker.pair(),
            body: blocker.body.map(|body| self.body_names[body].clone()),
            speed: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_thirds_leave_by_rounding_is_none() {
        let step = 0.1;
        let third = step / 3.0;
        let left = rest_of(rest_of(step, third), third);
        assert_eq!((rest_of(left, third), rest_of(left + 1e-17, left)), (0.0, 0.0));
        assert_eq!(rest_of(step, 0.75 * step), step - 0.75 * step);
    }
}
