//! Counts and times of a step, its intermediate pairs, and the instruction set.

use super::detector::CollisionDetector;
use crate::engine::{Question, StepStatistics, Wanted};
use crate::simd::Level;
use crate::step::{Contact, StepError};
use selvedge_core::{Position, Scalar};

impl<S: Scalar> CollisionDetector<S> {
    /// Forces the instruction set. The default is the best that the machine has. The results are the same.
    pub const fn set_level(&mut self, level: Level) {
        self.engine.set_level(level);
    }

    /// Finds [`contacts`](Self::contacts), and replaces `vertex_face` and `edge_edge` by the pairs that the non-coplanarity
    /// filter leaves.
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts).
    pub fn contacts_and_filtered<P: Position<Scalar = S>>(
        &mut self,
        start: &[P],
        end: &[P],
        contacts: &mut Vec<Contact<S>>,
        vertex_face: &mut Vec<[u32; 2]>,
        edge_edge: &mut Vec<[u32; 2]>,
    ) -> Result<(), StepError> {
        let step = self.step(start, end)?;
        let question = Question {
            keeps_filtered: true,
            ..self.question(Wanted::All)
        };
        self.engine.run(&self.workers, &step, &question);
        self.engine.collect_contacts(contacts);
        self.engine.collect_kept([vertex_face, edge_edge]);
        self.engine.result()
    }

    /// Returns how often near pairs were searched for since the steps became [coherent](Self::set_coherent).
    #[must_use]
    pub fn near_statistics(&self) -> crate::coherent::NearStatistics {
        self.engine.near_statistics()
    }

    /// Returns the counts and times of the stages of the last step.
    #[must_use]
    pub const fn statistics(&self) -> &StepStatistics {
        self.engine.statistics()
    }
}
