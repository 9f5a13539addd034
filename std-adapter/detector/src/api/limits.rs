//! What cuts a detector's steps short: another thread, or too many pairs.

use super::detector::CollisionDetector;
use crate::step::Cancellation;
use selvedge_core::Scalar;

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
