//! Primitives of a mesh at rest that meet.

use super::detector::CollisionDetector;
use crate::engine::Wanted;
use crate::step::{Intersection, StepError};
use selvedge_core::{Position, Scalar};

impl<S: Scalar> CollisionDetector<S> {
    /// Replaces `intersections` by all edges and faces that meet, with the mesh at `positions`.
    ///
    /// Where neighbours are folded flat onto each other, the vertices and faces, and the edges, that touch are listed too. Each
    /// intersection comes once, in ascending order. The list is the same on any number of threads and does not depend on earlier
    /// calls.
    ///
    /// **The result is exact.** Touching counts; primitives that are apart by the smallest number do not. Faces without area and
    /// edges without length are segments and points. The list is empty exactly if no two triangles have a point in common besides
    /// the vertices and the edge that they share. Steps can be certified from such a state.
    ///
    /// Primitives with a common vertex always meet there, which is no intersection. A second triangle with the same vertices is
    /// none either. But a face without area whose corner lies on its own edge touches its neighbour at that edge, and this
    /// counts. Vertices that [rest](Self::set_moving) are treated as in a step. The [criterion](Self::set_criterion) and the
    /// [collision filter](Self::set_collision_filter) have no effect.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Intersection, Topology};
    ///
    /// // The edges from vertex 3 pass through the large triangle.
    /// let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// let large = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]];
    /// let small = [[0.0, 0.0, -1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
    /// let mut positions = [large, small].concat();
    /// assert_eq!(detector.topology().edges()[3..5], [[3, 4], [3, 5]]);
    /// let mut found = Vec::new();
    /// detector.intersections(&positions, &mut found)?;
    /// assert_eq!(found, [3, 4].map(|edge| Intersection::EdgeFace { edge, face: 0 }));
    ///
    /// // Now only the vertex touches; then nothing does.
    /// positions[3][2] = 0.0;
    /// assert!(detector.has_intersections(&positions)?);
    /// positions[3][2] = f32::MIN_POSITIVE;
    /// assert!(!detector.has_intersections(&positions)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`contacts`](Self::contacts). Errors name the frame of the positions as the
    /// [start](crate::Frame::Start).
    pub fn intersections<P: Position<Scalar = S>>(
        &mut self,
        positions: &[P],
        intersections: &mut Vec<Intersection>,
    ) -> Result<(), StepError> {
        let step = self.step(positions, positions)?;
        self.engine.intersections(&self.workers, &step, Wanted::All, intersections);
        self.engine.result()
    }

    /// Returns whether there are any [`intersections`](Self::intersections). The search ends at the first.
    ///
    /// # Errors
    /// Returns the errors of [`intersections`](Self::intersections).
    pub fn has_intersections<P: Position<Scalar = S>>(&mut self, positions: &[P]) -> Result<bool, StepError> {
        let step = self.step(positions, positions)?;
        let mut found = Vec::new();
        self.engine.intersections(&self.workers, &step, Wanted::Any, &mut found);
        if !found.is_empty() {
            return Ok(true);
        }
        self.engine.result()?;
        Ok(false)
    }
}
