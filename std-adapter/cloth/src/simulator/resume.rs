//! Checkpoints: out of a simulation, and back into one.

use super::advance::begin_anew;
use super::{CHECKPOINT_STEPS, Simulation};
use crate::checkpoint::{Checkpoint, CheckpointError, Sizes};
use crate::step::Memory;
use crate::world::{Driven, Kinematic};

impl Simulation {
    /// All that the rest of the simulation depends on, and what has been measured so far, every [`CHECKPOINT_STEPS`] steps;
    /// `None` in between. What the caller has said of the next step, and of the wind, is not in it.
    #[must_use]
    pub fn checkpoint(&self) -> Option<Vec<u8>> {
        if !self.state.step.is_multiple_of(CHECKPOINT_STEPS) {
            return None;
        }
        let mut checkpoint = Checkpoint {
            state: self.state.clone(),
            effects: self.effects.iter().map(|effect| effect.seconds).collect(),
            placements: self.driven().map(|driven| driven.placement).collect(),
            memories: self.remembered(),
            ..Checkpoint::default()
        };
        if let Some(contact) = &self.contact {
            checkpoint.yielding = contact.exempt().yielding.clone();
            checkpoint.parting = contact.exempt().parting().map(<[_]>::to_vec);
            (checkpoint.counts, checkpoint.stages) = (contact.counts, contact.stages);
        }
        Some(checkpoint.write(self.fingerprint))
    }

    /// Goes on from a checkpoint of the same scene: with the same bits as if it had never ended. Counters and times go on as well.
    ///
    /// # Errors
    /// If it is not a checkpoint, is damaged, or is one of another scene; then nothing has changed.
    pub fn resume(&mut self, checkpoint: &[u8]) -> Result<(), CheckpointError> {
        let sizes = Sizes {
            vertices: self.state.positions.len(),
            yielding: self.contact.as_ref().map_or(0, |c| c.exempt().yielding.len()),
            effects: self.effects.len(),
            placements: self.driven().count(),
            memories: self.remembered().len(),
        };
        let checkpoint = Checkpoint::read(checkpoint, self.fingerprint, sizes)?;
        if let Some(contact) = &mut self.contact {
            let positions = &checkpoint.state.positions;
            if !contact.set_parting(checkpoint.parting.as_deref(), positions) {
                return Err(CheckpointError::Damaged);
            }
            contact.set_yielding(&checkpoint.yielding);
            begin_anew(contact, &checkpoint.state, self.time_step);
            (contact.counts, contact.stages) = (checkpoint.counts, checkpoint.stages);
        }
        for (effect, seconds) in self.effects.iter_mut().zip(checkpoint.effects) {
            effect.seconds = seconds;
        }
        let driven = self.motions.iter_mut().filter_map(Kinematic::driven_mut);
        for (driven, placement) in driven.zip(checkpoint.placements) {
            driven.placement = placement;
        }
        self.recall(&checkpoint.memories);
        self.state = checkpoint.state;
        Ok(())
    }

    /// What all constraints remember, one after the other.
    pub(super) fn remembered(&self) -> Vec<f64> {
        self.memories().flat_map(Memory::numbers).collect()
    }

    /// Takes back what was [`remembered`](Self::remembered) once.
    pub(super) fn recall(&mut self, mut numbers: &[f64]) {
        for &index in &self.remembering {
            if let Some(memory) = self.constraints[index].action.memory_mut() {
                let own;
                (own, numbers) = numbers.split_at(memory.numbers().len());
                memory.recall(own);
            }
        }
    }

    pub(super) fn memories(&self) -> impl Iterator<Item = &dyn Memory> {
        let all = self.remembering.iter();
        all.filter_map(|&index| self.constraints[index].action.memory())
    }

    pub(super) fn driven(&self) -> impl Iterator<Item = &Driven> {
        self.motions.iter().filter_map(Kinematic::driven)
    }
}
