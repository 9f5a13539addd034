//! A substep: a whole step, or a part of one after a cut.
//!
//! Forces, prediction, constraints, contact, friction, and the certificate have a method each.

use super::assembly::Assembly;
use super::measures::EffectTime;
use super::momentum::Pieces;
use super::simulation::{Simulation, Work};
use super::state::{FASTEST, limited};
use crate::contact::{Blocker, ContactSolver};
use crate::effects::plan::Entry;
use crate::model::step::{Carrier, Constraint, FREE, Force, TimeStep, Touches};
use crate::world::Kinematic;
use selvedge::clock::Clock;
use selvedge_core::glam::DVec3;

/// The smallest and the largest number of sweeps over the contacts that were found, and over their friction.
const SWEEPS: [usize; 2] = [4, 64];
/// The largest number of sweeps if contacts remember no pushes, as after a checkpoint.
const MOST_WITHOUT_MEMORY: usize = 256;
/// The change by a sweep that needs no other one, as a share of the largest move in the substep.
const SMALL_CHANGE: f64 = 0.05;
/// The sweeps over which a change falls by [`STALLED`] if stitches and contacts can hold together.
const STALL: usize = 4;
/// The share of the change of [`STALL`] sweeps before that shows that stitches and contacts only undo each other. It is fitted: where
/// they do, the share is 0.95 and more.
const STALLED: f64 = 0.9;
/// The largest length of an edge, over its limit, that needs no other round.
const TOLERANCE: f64 = 1.01;
/// The largest number of rounds of limits and contacts.
const ROUNDS: usize = 8;
/// The first limits of a round move vertices by this multiple of what they need (over-relaxation), since contacts and friction take
/// some of it back. The last limits of a round do not. It is fitted: 1.5 needs no fewer rounds by frames.
const OVER_RELAXATION: f64 = 1.25;

/// A substep in progress. It changes no state before it is accepted.
pub(super) struct Substep<'a> {
    step: TimeStep<'a>,
    /// The clock of bodies and pins at the end, in seconds.
    clock: f64,
    /// The inverse masses apart from the springs that [hold](crate::model::step::Memory::hold) vertices.
    inverse_masses: &'a [f64],
    effects: &'a mut [EffectTime],
    carriers: &'a [Carrier],
    carried: &'a [DVec3],
    motions: &'a mut [Kinematic],
    forces: &'a mut [Entry<dyn Force>],
    constraints: &'a mut [Entry<dyn Constraint>],
    among_contacts: &'a [usize],
    bounding: &'a [usize],
    lasting: &'a [usize],
    pushes: &'a mut [Entry<dyn Constraint>],
    friction: &'a mut [Entry<dyn Constraint>],
    remembering: &'a [usize],
    pieces: &'a mut Pieces,
    contact: Option<&'a mut ContactSolver>,
    velocities: &'a mut Vec<DVec3>,
    positions: &'a mut Vec<DVec3>,
    touches: &'a mut Touches,
    /// The shifted positions at the start of the step; the field exists to use its memory again.
    shifted: &'a mut Vec<DVec3>,
    /// The positions before limits act; the field exists to use its memory again.
    unlimited: &'a mut Vec<DVec3>,
}

impl Simulation {
    /// Advances the cloth by `h` seconds, and bodies and pins by `ticks` seconds of their clock.
    ///
    /// # Errors
    /// Returns an error if no motion is found that is certainly free. Then nothing has changed.
    pub(super) fn attempt(&mut self, h: f64, ticks: f64) -> Result<(), Blocker> {
        if self.made.solve.is_some() {
            return self.solve_step(h, ticks);
        }
        let mut substep = Substep::begin(self, h, ticks);
        substep.apply_forces();
        substep.predict();
        substep.constrain();
        substep.separate();
        substep.slow_down();
        substep.certify()?;
        substep.settle();
        let Self { state, work, .. } = self;
        let ways = work.predicted.iter().zip(&state.positions).map(|(end, start)| *end - *start);
        state.velocities.clear();
        state.velocities.extend(ways.map(|way| way / h));
        work.leave_out_shift(&mut state.velocities, h);
        std::mem::swap(&mut state.positions, &mut work.predicted);
        state.clock += ticks;
        Ok(())
    }
}

impl Work {
    /// Removes the shift from velocities: all of it, so that momentum is kept even where certification has held vertices back.
    fn leave_out_shift(&self, velocities: &mut [DVec3], h: f64) {
        for (velocity, shift) in velocities.iter_mut().zip(self.touches.shift()) {
            *velocity -= *shift / h;
        }
    }
}

impl<'a> Substep<'a> {
    /// Finds the poses of bodies and pins, and the masses that constraints see.
    fn begin(simulation: &'a mut Simulation, h: f64, ticks: f64) -> Self {
        let Simulation {
            state,
            work,
            carried,
            effects,
            made,
            ..
        } = simulation;
        let Assembly {
            inverse_masses,
            carriers,
            contact,
            motions,
            forces,
            constraints,
            among_contacts,
            bounding,
            lasting,
            pushes,
            friction,
            remembering,
            pieces,
            ..
        } = made;
        let clock = state.clock;
        work.poses.clear();
        let poses = |motion: &Kinematic| [clock, clock + ticks].map(|time| motion.pose(time));
        work.poses.extend(motions.iter().map(poses));
        work.touches.clear();
        work.held.clear();
        for &index in &*remembering {
            let Entry { effect, action } = &constraints[index];
            if let Some(memory) = action.memory() {
                timed(effects, *effect, || memory.hold(h, &mut work.held));
            }
        }
        let weighed = if work.held.is_empty() {
            &*inverse_masses
        } else {
            let own = &mut work.inverse_masses;
            own.clone_from(inverse_masses);
            for &(vertex, mass) in &work.held {
                let inverse_mass = &mut own[vertex as usize];
                *inverse_mass /= 1.0 + *inverse_mass * mass;
            }
            own
        };
        work.velocities.clone_from(&state.velocities);
        Self {
            step: TimeStep {
                time: state.time(simulation.time_step),
                h,
                start: &state.positions,
                inverse_masses: weighed,
                held: &work.held,
                poses: &work.poses,
            },
            clock: clock + ticks,
            inverse_masses,
            effects,
            carriers,
            carried,
            motions,
            forces,
            constraints,
            among_contacts,
            bounding,
            lasting,
            pushes,
            friction,
            remembering,
            pieces,
            contact: contact.as_mut(),
            velocities: &mut work.velocities,
            positions: &mut work.predicted,
            touches: &mut work.touches,
            shifted: &mut work.shifted,
            unlimited: &mut work.unlimited,
        }
    }

    /// Lets forces change velocities. They see the masses apart from the springs that hold vertices.
    fn apply_forces(&mut self) {
        let step = TimeStep {
            inverse_masses: self.inverse_masses,
            held: &[],
            ..self.step
        };
        for Entry { effect, action } in &mut *self.forces {
            timed(self.effects, *effect, || action.apply(&step, self.velocities));
        }
    }

    /// Predicts positions by inertia, and moves bodies and pins to the end of the substep.
    fn predict(&mut self) {
        let Self {
            step,
            carriers,
            carried,
            velocities,
            positions,
            ..
        } = self;
        let predicted = |vertex: usize| match step.poses.get(carriers[vertex] as usize) {
            Some([_, pose]) if pose.is_rigid() => pose.apply(carried[vertex]),
            Some(_) => step.start[vertex],
            None => step.start[vertex] + limited(velocities[vertex], FASTEST) * step.h,
        };
        positions.clear();
        positions.extend((0..step.start.len()).map(predicted));
        for motion in &mut *self.motions {
            motion.put(self.clock, positions);
        }
    }

    /// Lets constraints correct the positions, one after the other. Inner forces among them keep the [momentum](super::momentum).
    fn constrain(&mut self) {
        let mut is_inner = false;
        for index in 0..self.constraints.len() {
            let is_next_inner = self.constraints[index].action.is_inner();
            match (is_inner, is_next_inner) {
                (false, true) => self.pieces.begin(&self.step, self.positions),
                (true, false) => self.pieces.project(&self.step, self.positions),
                _ => (),
            }
            is_inner = is_next_inner;
            self.correct(index);
        }
        if is_inner {
            self.pieces.project(&self.step, self.positions);
        }
    }

    fn correct(&mut self, index: usize) {
        let Entry { effect, action } = &mut self.constraints[index];
        timed(self.effects, *effect, || {
            action.project(&self.step, self.positions, self.touches);
        });
    }

    /// Pushes near pairs apart, applies friction to contacts that push, and shortens edges that this stretches beyond their
    /// limit.
    ///
    /// Stitches, pushes and friction stretch the cloth, and limits pull it into touching surfaces: each acts in rounds until all
    /// limits hold. Limits act last: stitches may gape, and contacts have room between thickness and separation. Cloth without a
    /// limit needs rounds only where contacts [undo](Constraint::is_undone) what its elasticity did.
    fn separate(&mut self) {
        if let Some(contact) = &mut self.contact {
            contact.prepare(self.step.start, self.positions);
            contact.begin(&self.step, self.positions);
        }
        self.recover();
        self.push();
        self.sweep();
        for _ in 0..ROUNDS {
            if !self.is_undone() {
                break;
            }
            self.act_again(self.lasting);
            self.act_again(self.among_contacts);
            self.push();
            self.rub();
        }
        for _ in 0..ROUNDS {
            if self.holds() {
                break;
            }
            self.act_again(self.among_contacts);
            self.limit_beyond();
            self.push();
            self.rub();
            self.act_again(self.bounding);
        }
    }

    /// Lets limits act, and moves vertices [further](OVER_RELAXATION). A multiple of inner corrections has no momentum either. Stitches
    /// act just before, and what is too much would open their seams.
    fn limit_beyond(&mut self) {
        if !self.among_contacts.is_empty() {
            return self.act_again(self.bounding);
        }
        self.unlimited.clone_from(self.positions);
        self.act_again(self.bounding);
        for (position, before) in self.positions.iter_mut().zip(&*self.unlimited) {
            *position += (*position - *before) * (OVER_RELAXATION - 1.0);
        }
    }

    fn push_off_smooth_bodies(&mut self) {
        for Entry { effect, action } in &mut *self.pushes {
            timed(self.effects, *effect, || {
                action.project(&self.step, self.positions, self.touches);
            });
        }
    }

    /// Pushes cloth off bodies, then cloth off cloth.
    fn push(&mut self) {
        self.push_off_smooth_bodies();
        let Some(contact) = &mut self.contact else { return };
        for with_body in [true, false] {
            if let Some(effect) = contact.settings.effect(with_body) {
                timed(self.effects, effect, || {
                    contact.push(with_body, &self.step, self.positions);
                });
            }
        }
    }

    /// Shifts pairs that have been too near since the start of the step.
    fn recover(&mut self) {
        self.push_off_smooth_bodies();
        if let Some(contact) = &mut self.contact {
            contact.find_missing(&self.step, self.positions, self.touches);
        }
        self.touches.find_shift(self.step.inverse_masses, self.step.h);
        if self.touches.shift().is_empty() {
            return;
        }
        for (position, shift) in self.positions.iter_mut().zip(self.touches.shift()) {
            *position += *shift;
        }
        if let Some(contact) = &mut self.contact {
            contact.follow_shift(&self.step, self.positions, self.touches);
        }
        self.shifted.clear();
        let shifted = self.step.start.iter().zip(self.touches.shift());
        self.shifted.extend(shifted.map(|(start, shift)| *start + *shift));
    }

    /// Lets contacts push, or take back, and rub until a sweep changes little.
    ///
    /// A sweep passes a push on by one layer, and multiplies the slowest error of n layers by cos²(π/(n + 1)): 0.92 for ten.
    /// Friction is part of the sweeps, as what it leaves becomes a velocity. What is little follows the motion, so that moving
    /// cloth costs few sweeps, and cloth that comes to rest does so down to what is [negligible](ContactSolver::negligible).
    ///
    /// Stitches take no part in the accumulated pushes. Where a seam draws together what contacts keep apart, no positions satisfy
    /// both, and sweeps go back and forth between two states. So with stitches they end when the change no longer falls.
    fn sweep(&mut self) {
        let [fewest, mut most] = SWEEPS;
        if self.contact.as_ref().is_some_and(|contact| !contact.has_memory()) {
            most = MOST_WITHOUT_MEMORY;
        }
        let mut before = [f64::INFINITY; STALL];
        for sweep in 1..most {
            self.act_again(self.among_contacts);
            let mut change = 0.0_f64;
            if let Some(contact) = &mut self.contact
                && let Some(effect) = contact.settings.effect(false).or(contact.settings.effect(true))
            {
                timed(self.effects, effect, || change = contact.sweep(&self.step, self.positions));
            }
            self.rub();
            change = change.max(self.touches.rubbed);
            let has_stalled = !self.among_contacts.is_empty() && change > STALLED * before[sweep % STALL];
            before[sweep % STALL] = change;
            if sweep + 1 >= fewest && (has_stalled || self.is_small(change)) {
                break;
            }
        }
    }

    /// Returns whether another sweep is not worth its time after one with this largest change.
    fn is_small(&self, change: f64) -> bool {
        let Some(contact) = &self.contact else { return true };
        let ends = self.positions.iter().zip(self.step.start).zip(self.step.inverse_masses);
        let mut free = ends.filter(|(_, inverse_mass)| **inverse_mass > 0.0);
        let mut is_small_beside_a_move =
            || free.any(|((end, start), _)| change * change <= SMALL_CHANGE.powi(2) * end.distance_squared(*start));
        change <= contact.negligible() || change == 0.0 || is_small_beside_a_move()
    }

    /// Applies friction to contacts that have pushed. Sliding does not include the shift.
    fn rub(&mut self) {
        if self.friction.is_empty() {
            return;
        }
        if let Some(contact) = &mut self.contact {
            contact.record(self.touches);
        }
        let mut step = self.step;
        if !self.touches.shift().is_empty() {
            step.start = self.shifted;
        }
        for Entry { effect, action } in &mut *self.friction {
            timed(self.effects, *effect, || action.project(&step, self.positions, self.touches));
        }
    }

    /// Returns whether contacts have undone what a constraint did.
    fn is_undone(&self) -> bool {
        let mut lasting = self.lasting.iter().filter(|_| self.contact.is_some());
        lasting.any(|&index| self.constraints[index].action.is_undone(self.positions) == Some(true))
    }

    /// Returns whether all lengths that constraints limit are within their limits and the tolerance.
    fn holds(&mut self) -> bool {
        self.bounding.iter().all(|&index| {
            let Entry { effect, action } = &self.constraints[index];
            let mut over = None;
            timed(self.effects, *effect, || over = action.over_limit(self.positions));
            over.is_none_or(|over| over <= TOLERANCE)
        })
    }

    /// Lets inner constraints correct the positions once more.
    fn act_again(&mut self, constraints: &[usize]) {
        if constraints.is_empty() {
            return;
        }
        self.pieces.begin(&self.step, self.positions);
        for &index in constraints {
            self.correct(index);
        }
        self.pieces.project(&self.step, self.positions);
    }

    /// Keeps free vertices below the [fastest](FASTEST) speed.
    fn slow_down(&mut self) {
        let farthest = FASTEST * self.step.h;
        for (vertex, position) in self.positions.iter_mut().enumerate() {
            if self.carriers[vertex] == FREE {
                let start = self.step.start[vertex];
                *position = start + limited(*position - start, farthest);
            }
        }
    }

    /// Turns the motion into one that is certainly free.
    fn certify(&mut self) -> Result<(), Blocker> {
        if let Some(contact) = &mut self.contact {
            contact.certify(&self.step, self.positions)?;
            contact.remember(self.touches, self.step.h);
        }
        Ok(())
    }

    /// Tells constraints of a substep that is accepted.
    fn settle(&mut self) {
        for &index in self.remembering {
            let Entry { effect, action } = &mut self.constraints[index];
            if let Some(memory) = action.memory_mut() {
                timed(self.effects, *effect, || memory.settle(&self.step, self.positions));
            }
        }
    }
}

/// Runs an action of an effect, and adds the time that it takes.
fn timed(effects: &mut [EffectTime], effect: usize, action: impl FnOnce()) {
    let begin = Clock::now();
    action();
    effects[effect].seconds += begin.elapsed().as_secs_f64();
}
