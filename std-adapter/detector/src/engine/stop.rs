//! What cuts a step short: another thread, or too many pairs.

use crate::step::{Cancellation, StepError};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Whether to go on with a step: all threads ask, some thousand pairs at a time.
#[derive(Debug)]
pub(crate) struct Stop {
    pub(crate) cancellation: Cancellation,
    /// Most pairs to look at.
    limit: u64,
    looked_at: AtomicU64,
    is_cancelled: AtomicBool,
}

impl Stop {
    pub(crate) fn new() -> Self {
        Self {
            cancellation: Cancellation::default(),
            limit: u64::MAX,
            looked_at: AtomicU64::new(0),
            is_cancelled: AtomicBool::new(false),
        }
    }

    /// A traversal begins.
    pub(crate) fn begin(&mut self) {
        *self.looked_at.get_mut() = 0;
        *self.is_cancelled.get_mut() = false;
    }

    /// So many more pairs are to be looked at. Returns whether to go on.
    pub(crate) fn goes_on(&self, pairs: usize) -> bool {
        if self.cancellation.is_cancelled() {
            self.is_cancelled.store(true, Ordering::Relaxed);
        }
        self.looked_at.fetch_add(pairs as u64, Ordering::Relaxed);
        !self.has_stopped()
    }

    /// Whether the traversal was cut short.
    pub(crate) fn has_stopped(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed) || self.looked_at.load(Ordering::Relaxed) > self.limit
    }

    /// Most pairs to look at from the next question on; `None`: as many as there are.
    pub(crate) const fn set_limit(&mut self, limit: Option<u64>) {
        self.limit = match limit {
            Some(limit) => limit,
            None => u64::MAX,
        };
    }

    /// Why it was, if it was.
    pub(crate) fn result(&self) -> Result<(), StepError> {
        if self.is_cancelled.load(Ordering::Relaxed) {
            Err(StepError::Cancelled)
        } else if self.has_stopped() {
            Err(StepError::TooManyPairs { limit: self.limit })
        } else {
            Ok(())
        }
    }

    /// Whether a question may begin.
    pub(crate) fn admits(&self) -> Result<(), StepError> {
        if self.cancellation.is_cancelled() {
            Err(StepError::Cancelled)
        } else {
            Ok(())
        }
    }
}
