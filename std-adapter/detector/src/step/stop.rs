//! What cuts a step short: another thread, or too many pairs.

use super::CollisionDetector;
use crate::frame::StepError;
use selvedge_core::Scalar;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Cuts a detector's steps short, from any thread: [`CollisionDetector::cancellation`] hands it out. Clones are one and the same.
///
/// ```
/// use selvedge::{CollisionDetector, StepError, Topology};
///
/// let mut detector = CollisionDetector::<f32>::new(Topology::new(3, vec![[0, 1, 2]])?);
/// let positions = [[0.0; 3]; 3];
/// let cancellation = detector.cancellation();
/// std::thread::spawn(move || cancellation.cancel()).join().unwrap();
/// assert_eq!(detector.is_free(&positions, &positions), Err(StepError::Cancelled));
/// // Until it is taken back.
/// detector.cancellation().reset();
/// assert_eq!(detector.is_free(&positions, &positions), Ok(true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cancellation(Arc<AtomicBool>);

impl Cancellation {
    /// The question that is being answered, and each one from now on, ends with [`StepError::Cancelled`]. (One that is nearly answered may
    /// still be.)
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Questions are answered again.
    pub fn reset(&self) {
        self.0.store(false, Ordering::Relaxed);
    }

    /// Whether questions are cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

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
    pub(super) fn new() -> Self {
        Self {
            cancellation: Cancellation::default(),
            limit: u64::MAX,
            looked_at: AtomicU64::new(0),
            is_cancelled: AtomicBool::new(false),
        }
    }

    /// A traversal begins.
    pub(super) fn begin(&mut self) {
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
    pub(super) fn has_stopped(&self) -> bool {
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

impl<S: Scalar> CollisionDetector<S> {
    /// What cuts this detector's steps short from another thread. The detector can be used again afterwards, and answers as if nothing
    /// had been.
    ///
    /// It is looked at every some thousand pairs; hierarchies that are being refitted or built are finished first.
    #[must_use]
    pub fn cancellation(&self) -> Cancellation {
        self.engine.stop.cancellation.clone()
    }

    /// Most pairs that a step may look at, of those that boxes leave; `None`, as at first: as many as there are.
    ///
    /// A step with more ends with [`StepError::TooManyPairs`], on any number of threads: so nobody waits for hours, or runs out of memory,
    /// because a simulation has collapsed into one point. ([`is_free`](Self::is_free) and [`has_intersections`](Self::has_intersections) may
    /// find what ends them before, on several threads in one run and not in the next. With [coherent](Self::set_coherent) steps
    /// it is the pairs that are left of those followed.)
    ///
    /// ```
    /// use selvedge::{CollisionDetector, StepError, Topology};
    ///
    /// // Two triangles in one place: six vertices and faces, nine pairs of edges.
    /// let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let mut contacts = Vec::new();
    /// detector.set_pair_limit(Some(14));
    /// let refused = detector.contacts(&positions, &positions, &mut contacts);
    /// assert_eq!(refused, Err(StepError::TooManyPairs { limit: 14 }));
    /// detector.set_pair_limit(Some(15));
    /// detector.contacts(&positions, &positions, &mut contacts)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn set_pair_limit(&mut self, limit: Option<u64>) {
        self.engine.stop.set_limit(limit);
    }
}
