//! Cuts a step short: by another thread, by too many pairs, or by too much memory.

use crate::step::{Cancellation, StepError};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// The default limit on the memory of a step's pairs and contacts, in bytes: 2 GiB.
pub const DEFAULT_MEMORY_LIMIT: u64 = 1 << 31;

/// Decides whether a step may continue. All threads call it every few thousand pairs.
#[derive(Debug)]
pub(crate) struct Stop {
    pub(crate) cancellation: Cancellation,
    /// The largest number of pairs to look at.
    pair_limit: u64,
    /// The largest number of bytes of pairs and contacts to store.
    memory_limit: u64,
    looked_at: AtomicU64,
    stored: AtomicU64,
    is_cancelled: AtomicBool,
}

impl Stop {
    pub(crate) fn new() -> Self {
        Self {
            cancellation: Cancellation::default(),
            pair_limit: u64::MAX,
            memory_limit: DEFAULT_MEMORY_LIMIT,
            looked_at: AtomicU64::new(0),
            stored: AtomicU64::new(0),
            is_cancelled: AtomicBool::new(false),
        }
    }

    /// Begins a question, with nothing looked at or stored.
    pub(crate) fn begin(&mut self) {
        *self.looked_at.get_mut() = 0;
        *self.stored.get_mut() = 0;
        *self.is_cancelled.get_mut() = false;
    }

    /// Counts pairs that are about to be looked at. Returns whether to continue.
    pub(crate) fn continues(&self, pairs: usize) -> bool {
        if self.cancellation.is_cancelled() {
            self.is_cancelled.store(true, Ordering::Relaxed);
        }
        self.looked_at.fetch_add(pairs as u64, Ordering::Relaxed);
        !self.has_stopped()
    }

    pub(crate) fn stores(&self, bytes: usize) {
        self.stored.fetch_add(bytes as u64, Ordering::Relaxed);
    }

    pub(crate) const fn memory_limit(&self) -> u64 {
        self.memory_limit
    }

    /// Notes that the question needs more memory than allowed.
    pub(crate) fn exceed_memory(&mut self) {
        *self.stored.get_mut() = u64::MAX;
    }

    /// Returns whether the question was cut short.
    pub(crate) fn has_stopped(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed) || self.has_too_many_pairs() || self.has_stored_too_much()
    }

    fn has_too_many_pairs(&self) -> bool {
        self.looked_at.load(Ordering::Relaxed) > self.pair_limit
    }

    pub(crate) fn has_stored_too_much(&self) -> bool {
        self.stored.load(Ordering::Relaxed) > self.memory_limit
    }

    /// Sets the largest number of pairs to look at from the next question on; `None` is no limit.
    pub(crate) fn set_pair_limit(&mut self, limit: Option<u64>) {
        self.pair_limit = limit.unwrap_or(u64::MAX);
    }

    /// Sets the largest number of bytes to store from the next question on; `None` is no limit.
    pub(crate) fn set_memory_limit(&mut self, limit: Option<u64>) {
        self.memory_limit = limit.unwrap_or(u64::MAX);
    }

    /// Returns the reason for cutting the question short, if it was.
    pub(crate) fn result(&self) -> Result<(), StepError> {
        if self.is_cancelled.load(Ordering::Relaxed) {
            Err(StepError::Cancelled)
        } else if self.has_too_many_pairs() {
            Err(StepError::TooManyPairs { limit: self.pair_limit })
        } else if self.has_stored_too_much() {
            Err(StepError::TooMuchMemory {
                limit: self.memory_limit,
            })
        } else {
            Ok(())
        }
    }

    /// Returns an error if no question may begin.
    pub(crate) fn admits(&self) -> Result<(), StepError> {
        if self.cancellation.is_cancelled() {
            Err(StepError::Cancelled)
        } else {
            Ok(())
        }
    }
}
