//! Cuts a step short from another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Cuts steps short, from any thread. [`CollisionDetector::cancellation`](crate::CollisionDetector::cancellation) returns it. All
/// clones act on the same detector.
///
/// ```
/// use selvedge::{CollisionDetector, StepError, Topology};
///
/// let mut detector = CollisionDetector::<f32>::new(Topology::new(3, vec![[0, 1, 2]])?);
/// let positions = [[0.0; 3]; 3];
/// let cancellation = detector.cancellation();
/// std::thread::spawn(move || cancellation.cancel()).join().unwrap();
/// assert_eq!(detector.is_free(&positions, &positions), Err(StepError::Cancelled));
/// // All steps fail until the reset.
/// detector.cancellation().reset();
/// assert_eq!(detector.is_free(&positions, &positions), Ok(true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cancellation(Arc<AtomicBool>);

impl Cancellation {
    /// Ends the present step and all later ones with [`StepError::Cancelled`](crate::StepError::Cancelled). A step that is nearly
    /// complete may still succeed.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Lets steps run again.
    pub fn reset(&self) {
        self.0.store(false, Ordering::Relaxed);
    }

    /// Returns whether steps are cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
