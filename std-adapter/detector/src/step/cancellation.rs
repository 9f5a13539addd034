//! What cuts a step short from another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

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
