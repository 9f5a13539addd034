//! What a detector shows to those who measure and check it.

use super::engine::{Probe, StepTally};
use super::{CollisionDetector, Contact, Question, Wanted};
use crate::dispatch::Level;
use crate::frame::StepError;
use selvedge_core::{Position, Scalar};

/// With the feature `verification`.
impl<S: Scalar> CollisionDetector<S> {
    /// Forces the instruction set; the best that the machine has is the default. Changes no result.
    pub const fn set_level(&mut self, level: Level) {
        self.engine.set_level(level);
    }

    /// As [`contacts`](Self::contacts), and replaces `vertex_face` and `edge_edge` by the pairs that the filter leaves.
    ///
    /// # Errors
    /// As [`contacts`](Self::contacts).
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
        self.engine.run(&self.workers, &step, &question, Probe::WHOLE);
        self.engine.collect_contacts(contacts);
        self.engine.collect_kept(vertex_face, edge_edge);
        self.engine.stop.result()
    }

    /// How often near pairs were searched for.
    #[must_use]
    pub fn near_statistics(&self) -> crate::coherent::NearStatistics {
        self.engine.near_statistics()
    }

    /// What the last step counted and how long its stages took.
    #[must_use]
    pub const fn tally(&self) -> &StepTally {
        self.engine.tally()
    }
}
