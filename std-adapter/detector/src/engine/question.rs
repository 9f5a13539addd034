//! What a step is asked for, and how late a contact may be to matter.

use selvedge_core::elementary::Limits;
use std::sync::atomic::{AtomicU64, Ordering};

/// What of a step is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Every contact.
    All,
    /// The earliest; of several at the same time, all are found.
    Earliest,
    /// Whether there is one.
    Any,
}

/// What is asked of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Question {
    pub(crate) limits: Limits<f64>,
    pub(crate) wanted: Wanted,
    /// Whether pairs that the filter keeps are wanted as well.
    pub(crate) keeps_filtered: bool,
    /// Whether only pairs that truly touch are contacts, by the exact verdict.
    pub(crate) is_exact: bool,
}

/// How late a contact may be to be of interest: shared by all threads, lowered by each contact where only the earliest is wanted.
///
/// A time is as its bits, which are in the same order, times being no less than zero. In which order threads lower it changes
/// no answer: a pair is dropped only if it is proven to be apart until *after* the bound, which never is before the earliest
/// contact.
#[derive(Debug)]
pub(crate) struct Bound(AtomicU64);

impl Bound {
    pub(super) fn new(time: f64) -> Self {
        Self(AtomicU64::new(time.to_bits()))
    }

    pub(super) fn get(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }

    /// There is a contact at `time`.
    pub(super) fn lower(&self, wanted: Wanted, time: f64) {
        match wanted {
            Wanted::All => {}
            Wanted::Earliest => {
                // Adding zero makes a negative zero positive.
                let bits = (time + 0.0).to_bits();
                self.0.fetch_min(bits, Ordering::Relaxed);
            }
            Wanted::Any => self.0.store(0, Ordering::Relaxed),
        }
    }

    /// Whether any contact was found, of which the caller wants one.
    pub(super) fn is_lowered(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}
