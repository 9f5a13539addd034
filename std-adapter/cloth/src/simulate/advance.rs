//! A step, whole or in parts: forces, prediction, constraints, contact, and the certified end.

use super::assembly::Assembly;
use super::checkpoint::CHECKPOINT_STEPS;
use super::errors::Blocked;
use super::measures::EffectTime;
use super::simulation::Simulation;
use super::state::{FASTEST, limited};
use crate::contact::{Blocker, LARGEST_TURN};
use crate::effects::plan::Entry;
use crate::model::step::{FREE, TimeStep};
use crate::scene::OnBlocked;
use crate::world::Kinematic;
use selvedge::clock::Clock;

/// The shortest part of a step that is tried, in steps, or in parts of one in which nothing turns too far: so a step has an end.
const SHORTEST: f64 = 1.0 / 64.0;

/// What the clock of bodies and pins did in a step.
enum BodyClock {
    Went,
    Waited,
}

impl Simulation {
    /// Does one step.
    ///
    /// # Errors
    /// If bodies or pins force the cloth where it cannot go without intersecting, and the scene wants to stop then. What is
    /// done of the step stays.
    pub fn step(&mut self) -> Result<(), Blocked> {
        // Taken out so that they can run what borrows the rest.
        let threads = std::mem::take(&mut self.threads);
        let clock = self.state.clock;
        for driven in self.made.motions.iter_mut().filter_map(Kinematic::driven_mut) {
            driven.begin(clock, self.time_step, &self.state.positions, &self.carried);
        }
        let result = threads.run(|| self.whole_step());
        let clock = self.state.clock;
        let has_arrived = matches!(result, Ok(BodyClock::Went));
        for driven in self.made.motions.iter_mut().filter_map(Kinematic::driven_mut) {
            driven.end(clock, has_arrived);
        }
        self.threads = threads;
        result.map(drop)
    }

    fn whole_step(&mut self) -> Result<BodyClock, Blocked> {
        let mut left = self.time_step;
        let mut of_the_step = BodyClock::Went;
        let mut was_blocked = false;
        let mut longest = left;
        let shortest = SHORTEST * self.without_large_turn(left);
        while left > 0.0 {
            let blocker = match self.part(left.min(longest), shortest) {
                Ok(h) => {
                    left = if h < left { left - h } else { 0.0 };
                    // What follows is likely to need as short a part: tried with twice that, at most.
                    longest = 2.0 * h;
                    continue;
                }
                Err(blocker) => blocker,
            };
            was_blocked = true;
            match (self.on_blocked, blocker.body, &mut self.made.contact) {
                (OnBlocked::Yield, Some(body), Some(contact)) => contact.let_pass(body),
                (OnBlocked::Yield | OnBlocked::Hold, ..) => {
                    // Without anything that is forced to move a step can always be made.
                    self.attempt(left, 0.0).map_err(|blocker| self.described(blocker))?;
                    left = 0.0;
                    of_the_step = BodyClock::Waited;
                }
                (OnBlocked::Stop, ..) => return Err(self.described(blocker)),
            }
        }
        self.state.step += 1;
        self.state.blocked_steps += u64::from(was_blocked);
        if let Some(contact) = &mut self.made.contact {
            contact.take_back(&self.state.positions);
        }
        self.tear();
        if let Some(contact) = &mut self.made.contact
            && self.state.step.is_multiple_of(CHECKPOINT_STEPS)
        {
            self.state.begin_anew(contact, self.time_step);
        }
        Ok(of_the_step)
    }

    /// Goes on by as much of `left` seconds as possible: returns how much. Half of it if that fails, and so on, but not by less than
    /// `shortest`.
    fn part(&mut self, left: f64, shortest: f64) -> Result<f64, Blocker> {
        let mut h = self.without_large_turn(left);
        loop {
            match self.attempt(h, h) {
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

    /// `h`, halved until no body or pin turns by more in that time than contact can certify.
    fn without_large_turn(&self, mut h: f64) -> f64 {
        let clock = self.state.clock;
        let turns_too_far =
            |motion: &Kinematic, h: f64| (motion.pose(clock + h).angle - motion.pose(clock).angle).abs() > LARGEST_TURN;
        if self.made.contact.is_some() {
            while self.made.motions.iter().any(|motion| turns_too_far(motion, h)) {
                h *= 0.5;
            }
        }
        h
    }

    fn described(&self, blocker: Blocker) -> Blocked {
        Blocked {
            time: blocker.time,
            what: blocker.pair(),
            body: blocker.body.map(|body| self.body_names[body].clone()),
        }
    }

    /// Goes on by `h` seconds, bodies and pins by `ticks` seconds of their clock. If that is not possible nothing changes.
    pub(super) fn attempt(&mut self, h: f64, ticks: f64) -> Result<(), Blocker> {
        let Self {
            state,
            work,
            carried,
            effects,
            made,
            ..
        } = self;
        let Assembly {
            inverse_masses,
            carriers,
            contact,
            motions,
            forces,
            constraints,
            friction,
            remembering,
            ..
        } = made;
        let clock = state.clock;
        work.poses.clear();
        let poses = |motion: &Kinematic| [clock, clock + ticks].map(|time| motion.pose(time));
        work.poses.extend(motions.iter().map(poses));
        work.touches.list.clear();
        let step = TimeStep {
            time: state.step as f64 * self.time_step,
            h,
            start: &state.positions,
            inverse_masses,
            held: &[],
            poses: &work.poses,
        };
        let velocities = &mut work.velocities;
        velocities.clone_from(&state.velocities);
        for Entry { effect, action } in &mut *forces {
            timed(effects, *effect, || action.apply(&step, velocities));
        }
        // Where inertia leads, and bodies and pins go.
        let predicted = |vertex: usize| match step.poses.get(carriers[vertex] as usize) {
            Some([_, pose]) if pose.is_rigid() => pose.apply(carried[vertex]),
            Some(_) => step.start[vertex],
            None => step.start[vertex] + limited(velocities[vertex], FASTEST) * h,
        };
        let (positions, touches) = (&mut work.predicted, &mut work.touches);
        positions.clear();
        positions.extend((0..step.start.len()).map(predicted));
        motions.iter_mut().for_each(|motion| motion.put(clock + ticks, positions));
        work.held.clear();
        for &index in &*remembering {
            let Entry { effect, action } = &constraints[index];
            if let Some(memory) = action.memory() {
                timed(effects, *effect, || memory.hold(h, &mut work.held));
            }
        }
        let step = if work.held.is_empty() {
            step
        } else {
            let own = &mut work.inverse_masses;
            own.clone_from(inverse_masses);
            for &(vertex, mass) in &work.held {
                let inverse_mass = &mut own[vertex as usize];
                *inverse_mass /= 1.0 + *inverse_mass * mass;
            }
            TimeStep {
                inverse_masses: own,
                held: &work.held,
                ..step
            }
        };
        for Entry { effect, action } in &mut *constraints {
            timed(effects, *effect, || action.project(&step, positions, touches));
        }
        if let Some(contact) = contact {
            contact.prepare(step.start, positions);
            for with_body in [true, false] {
                if let Some(effect) = contact.settings.effect(with_body) {
                    timed(effects, effect, || contact.push(with_body, &step, positions, touches));
                }
            }
        }
        for Entry { effect, action } in &mut *friction {
            timed(effects, *effect, || action.project(&step, positions, touches));
        }
        for (vertex, position) in positions.iter_mut().enumerate() {
            if carriers[vertex] == FREE {
                let start = step.start[vertex];
                *position = start + limited(*position - start, FASTEST * h);
            }
        }
        if let Some(contact) = contact {
            contact.certify(&step, positions)?;
        }
        for &index in &*remembering {
            let Entry { effect, action } = &mut constraints[index];
            if let Some(memory) = action.memory_mut() {
                timed(effects, *effect, || memory.settle(&step, positions));
            }
        }
        for (vertex, &position) in positions.iter().enumerate() {
            state.velocities[vertex] = (position - state.positions[vertex]) / h;
        }
        std::mem::swap(&mut state.positions, positions);
        state.clock += ticks;
        Ok(())
    }
}

/// Runs what an effect does, and adds the time to it.
fn timed(effects: &mut [EffectTime], effect: usize, action: impl FnOnce()) {
    let begin = Clock::now();
    action();
    effects[effect].seconds += begin.elapsed().as_secs_f64();
}
