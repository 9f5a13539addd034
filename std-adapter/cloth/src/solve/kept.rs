//! The data that one step leaves to the solve of the next: the forces of contacts by their keys, the multipliers of terms, and
//! the motion before the step. Checkpoints store them, so that a resumed simulation goes on with the same bits.

use super::Solve;
use super::contact_row::{Remembered, RowKey};
use super::prediction::MotionHistory;
use serde::{Deserialize, Serialize};

/// The data that one step leaves to the solve of the next.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Kept {
    /// In the order of the keys.
    pub(crate) pushes: Vec<(RowKey, Remembered)>,
    /// The multipliers of all terms, one after the other.
    pub(crate) multipliers: Vec<f64>,
    pub(crate) history: MotionHistory,
}

impl Kept {
    /// Returns whether all numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let MotionHistory {
            positions,
            velocities,
            h,
            ..
        } = &self.history;
        let mut pushes = self.pushes.iter();
        pushes.all(|(_, remembered)| remembered.is_finite())
            && self.multipliers.iter().chain([h]).all(|number| number.is_finite())
            && positions.iter().chain(velocities).all(|vector| vector.is_finite())
    }
}

impl Solve {
    fn multipliers(&self) -> Vec<f64> {
        self.terms.iter().flat_map(|entry| entry.action.multipliers()).collect()
    }

    /// Returns what the solve keeps.
    pub(crate) fn kept(&self, history: &MotionHistory) -> Kept {
        let mut pushes: Vec<_> = self.pushes.iter().map(|(key, remembered)| (*key, *remembered)).collect();
        pushes.sort_unstable_by_key(|(key, _)| *key);
        Kept {
            pushes,
            multipliers: self.multipliers(),
            history: history.clone(),
        }
    }

    /// Returns whether a solve of so many vertices, in all and of cloth, can [continue](Self::keep) with what is kept.
    pub(crate) fn can_keep(&self, kept: &Kept, [vertices, of_cloth]: [usize; 2]) -> bool {
        let history = &kept.history;
        let [known, velocities] = [&history.positions, &history.velocities].map(Vec::len);
        let of_order = history.is_first_order.len();
        self.multipliers().len() == kept.multipliers.len()
            && velocities == known
            && [0, of_cloth].contains(&of_order)
            && (known == 0 || known == vertices && of_order != 0)
    }

    /// Continues with what another solve has kept.
    pub(crate) fn keep(&mut self, kept: Kept, history: &mut MotionHistory) {
        self.pushes = kept.pushes.into_iter().collect();
        let mut numbers = &kept.multipliers[..];
        for entry in &mut self.terms {
            let own;
            (own, numbers) = numbers.split_at(entry.action.multipliers().len());
            entry.action.set_multipliers(own);
        }
        *history = kept.history;
    }
}
