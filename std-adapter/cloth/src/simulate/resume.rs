//! Checkpoints: out of a simulation, and back into one.

use super::checkpoint::{Checkpoint, CheckpointError};
use super::simulation::Simulation;
use crate::model::step::Memory;
use crate::world::{Driven, Free, KEPT, Kinematic};

impl Simulation {
    /// Returns all that the rest of the simulation depends on, and what has been measured so far, every
    /// [`CHECKPOINT_STEPS`](crate::CHECKPOINT_STEPS) steps; `None` in between. Motions that the caller has set for the next step,
    /// and the wind, are not in it. Other versions of this crate may not read it.
    #[must_use]
    pub fn checkpoint(&self) -> Option<Vec<u8>> {
        if !self.is_fresh {
            return None;
        }
        let mut checkpoint = Checkpoint {
            state: self.state.clone(),
            seconds: self.seconds(),
            placements: self.driven().map(|driven| driven.placement).collect(),
            free_bodies: self.free_bodies().flat_map(|(_, free)| free.numbers()).collect(),
            torn: self.torn_cloths(),
            memories: self.memory_numbers(),
            kept: self.made.solve.kept(&self.work.substep.history),
            ..Checkpoint::default()
        };
        if let Some(contact) = &self.made.contact {
            checkpoint.yielding = contact.exempt().yielding.clone();
            checkpoint.parting = contact.exempt().parting().map(<[_]>::to_vec);
            (checkpoint.counts, checkpoint.stages) = (contact.counts, contact.stages);
        }
        Some(checkpoint.write(self.fingerprint))
    }

    /// Continues from a checkpoint of the same scene, with the same bits as an uninterrupted simulation. Counters and times
    /// continue as well.
    ///
    /// # Errors
    /// Returns an error if the bytes are no checkpoint, damaged, or of another scene or version; then nothing has changed.
    pub fn resume(&mut self, checkpoint: &[u8]) -> Result<(), CheckpointError> {
        let damaged = CheckpointError::Damaged;
        let mut checkpoint = Checkpoint::read(checkpoint, self.fingerprint)?;
        let mut torn = match checkpoint.torn.take() {
            Some((cloths, edges)) => Some((self.torn_as(cloths)?, edges)),
            None if self.tearing.is_none() => None,
            None => return Err(damaged),
        };
        let made = torn.as_ref().map_or(&self.made, |(retorn, _)| &retorn.made);
        let vertices = made.rest.len();
        let yielding = made.contact.as_ref().map_or(0, |contact| contact.exempt().yielding.len());
        let lengths = [
            (checkpoint.state.positions.len(), vertices),
            (checkpoint.state.velocities.len(), vertices),
            (checkpoint.yielding.len(), yielding),
            (checkpoint.seconds.len(), self.seconds().len()),
            (checkpoint.placements.len(), self.driven().count()),
            (checkpoint.free_bodies.len(), self.free_bodies().count() * KEPT),
            (checkpoint.memories.len(), made.memories().flat_map(Memory::numbers).count()),
        ];
        let fits = lengths.iter().all(|(found, own)| found == own);
        if !(fits && made.solve.can_keep(&checkpoint.kept, [vertices, made.cloth_vertices])) {
            return Err(damaged);
        }
        let contact = match &mut torn {
            Some((retorn, _)) => &mut retorn.made.contact,
            None => &mut self.made.contact,
        };
        if let Some(contact) = contact
            && !contact.set_parting(checkpoint.parting.as_deref(), &checkpoint.state.positions)
        {
            return Err(damaged);
        }
        if let Some((retorn, edges)) = torn {
            self.adopt_torn(retorn, edges);
        }
        if let Some(contact) = &mut self.made.contact {
            contact.set_yielding(&checkpoint.yielding);
            checkpoint.state.begin_anew(contact, self.time_step);
            (contact.counts, contact.stages) = (checkpoint.counts, checkpoint.stages);
        }
        let effects = self.effects.iter_mut().map(|effect| &mut effect.seconds);
        for (own, seconds) in effects.chain([&mut self.made.solve.seconds]).zip(checkpoint.seconds) {
            *own = seconds;
        }
        let driven = self.made.motions.iter_mut().filter_map(Kinematic::driven_mut);
        for (driven, placement) in driven.zip(checkpoint.placements) {
            driven.placement = placement;
        }
        let free = self.made.motions.iter_mut().filter_map(Kinematic::free_mut);
        free.zip(checkpoint.free_bodies.as_chunks().0)
            .for_each(|(free, numbers)| free.recall(numbers));
        self.recall(&checkpoint.memories);
        self.made.solve.keep(checkpoint.kept, &mut self.work.substep.history);
        self.state = checkpoint.state;
        self.loads.forget();
        self.added_forces.0.clear();
        self.waiting = None;
        self.is_fresh = true;
        Ok(())
    }

    /// Forgets the multipliers and the motion before the present state, which a checkpoint does not have.
    pub(super) fn forget_motion(&mut self) {
        self.work.substep.history.forget();
        self.made.solve.forget();
    }

    /// Returns the seconds of each effect, and of the solve.
    fn seconds(&self) -> Vec<f64> {
        let effects = self.effects.iter().map(|effect| effect.seconds);
        effects.chain([self.made.solve.seconds]).collect()
    }

    /// Returns the memories of all terms, one after the other.
    pub(super) fn memory_numbers(&self) -> Vec<f64> {
        self.made.memories().flat_map(Memory::numbers).collect()
    }

    /// Restores memories that [`memory_numbers`](Self::memory_numbers) returned.
    pub(super) fn recall(&mut self, mut numbers: &[f64]) {
        for entry in &mut self.made.solve.terms {
            if let Some(memory) = entry.action.memory_mut() {
                let own;
                (own, numbers) = numbers.split_at(memory.numbers().len());
                memory.recall(own);
            }
        }
        self.forget_motion();
    }

    pub(super) fn driven(&self) -> impl Iterator<Item = &Driven> {
        self.made.motions.iter().filter_map(Kinematic::driven)
    }

    /// Returns the free bodies with their numbers.
    pub(super) fn free_bodies(&self) -> impl Iterator<Item = (usize, &Free)> {
        let motions = self.made.motions.iter().enumerate();
        motions.filter_map(|(body, motion)| Some((body, motion.free()?)))
    }
}
