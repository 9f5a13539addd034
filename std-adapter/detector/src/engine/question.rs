//! Questions about a step.

use selvedge_core::elementary::Limits;
use std::sync::atomic::{AtomicU64, Ordering};

/// The contacts that the caller wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Every contact.
    All,
    /// The earliest contact.
    Earliest,
    /// Any contact.
    Any,
}

/// A question about a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Question {
    pub(crate) limits: Limits<f64>,
    pub(crate) wanted: Wanted,
    /// True if the caller also wants the pairs that the filter keeps.
    pub(crate) keeps_filtered: bool,
    /// True if the exact verdict decides on contact.
    pub(crate) is_exact: bool,
}

/// The latest time at which a contact is of interest. All threads share it, and each contact lowers it if only the earliest is
/// wanted.
///
/// A time is stored as its bits, which have the same order since times are not negative. The order in which threads lower it
/// changes no result. A pair is dropped only if it is proven apart until *after* the bound, which is never before the earliest
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

    /// Lowers the bound to `time`.
    pub(super) fn lower(&self, wanted: Wanted, time: f64) {
        match wanted {
            Wanted::All => {}
            Wanted::Earliest => {
                // The sum makes a negative zero positive.
                let bits = (time + 0.0).to_bits();
                self.0.fetch_min(bits, Ordering::Relaxed);
            }
            Wanted::Any => self.0.store(0, Ordering::Relaxed),
        }
    }

    /// Returns whether a contact was found, if any will do.
    pub(super) fn is_lowered(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}
