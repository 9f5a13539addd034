//! Cuts the steps of a detector short: by another thread, by too many pairs, or by too much memory.

use super::detector::CollisionDetector;
use crate::step::Cancellation;
use selvedge_core::Scalar;

impl<S: Scalar> CollisionDetector<S> {
    /// Returns the handle that cuts this detector's steps short from another thread. The detector remains usable, and its next
    /// answers do not depend on the cancelled step.
    ///
    /// A step checks the handle every few thousand pairs. It first finishes hierarchies that are being refitted or built.
    #[must_use]
    pub fn cancellation(&self) -> Cancellation {
        self.engine.pairs.stop.cancellation.clone()
    }

    /// Sets the largest number of pairs that a step may look at, counted after the test of boxes. `None`, the default, is no
    /// limit.
    ///
    /// A step with more pairs ends with [`StepError::TooManyPairs`](crate::StepError::TooManyPairs), on any number of threads.
    /// This saves hours of work after a simulation has collapsed. [`is_free`](Self::is_free) and
    /// [`has_intersections`](Self::has_intersections) may find their answer before the limit; on several threads, in one run and
    /// not in the next. With [coherent](Self::set_coherent) steps the limit counts the followed pairs that are still open.
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
    pub fn set_pair_limit(&mut self, limit: Option<u64>) {
        self.engine.pairs.stop.set_pair_limit(limit);
    }

    /// Sets the largest memory that the pairs and contacts of a step may take, in bytes. `None` is no limit; the default is
    /// [`DEFAULT_MEMORY_LIMIT`](crate::DEFAULT_MEMORY_LIMIT).
    ///
    /// A step that needs more ends with [`StepError::TooMuchMemory`](crate::StepError::TooMuchMemory), on any number of threads.
    /// Many triangles through one point have contacts in the square of their number: without a limit, a few thousand of them
    /// exhaust the memory.
    ///
    /// The limit counts 48 bytes for each contact and 8 for each pair in a list of [`candidates`](Self::candidates). Buffers may
    /// be up to twice as long while they grow. Hierarchies, positions and the caller's own lists are not counted. With
    /// [coherent](Self::set_coherent) steps the search for near pairs and their list have to stay within the limit too. The
    /// [earliest](Self::earliest) contact and [`is_free`](Self::is_free) store next to nothing.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, StepError, Topology};
    ///
    /// // Two triangles in one place: all their 15 pairs are in contact.
    /// let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let mut contacts = Vec::new();
    /// detector.set_memory_limit(Some(14 * 48));
    /// let refused = detector.contacts(&positions, &positions, &mut contacts);
    /// assert_eq!(refused, Err(StepError::TooMuchMemory { limit: 672 }));
    /// detector.set_memory_limit(None);
    /// detector.contacts(&positions, &positions, &mut contacts)?;
    /// assert_eq!(contacts.len(), 15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_memory_limit(&mut self, limit: Option<u64>) {
        self.engine.pairs.stop.set_memory_limit(limit);
    }
}
