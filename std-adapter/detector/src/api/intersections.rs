//! Which primitives of a mesh at rest meet.

use super::detector::CollisionDetector;
use crate::engine::Wanted;
use crate::step::{Intersection, StepError};
use selvedge_core::{Position, Scalar};

impl<S: Scalar> CollisionDetector<S> {
    /// Replaces `intersections` by all edges and faces that meet where the mesh is at `positions`, and by vertices and faces, and edges, that
    /// touch where neighbours are folded flat onto each other. Each once, in ascending order: the same list on any number of threads,
    /// whatever was asked before.
    ///
    /// **Exact**: touching counts, however little; what is apart by the smallest number does not. Faces without area and edges without
    /// length are what they are, segments and points. The list is empty exactly if no two triangles have a point in common besides
    /// the vertices, and the edge, that they share; then the mesh is a state from which steps can be certified.
    ///
    /// Primitives with a common vertex always meet there, and are no intersection. (Nor is a triangle that is there twice with the same
    /// vertices. A face without area, whose corner lies on its edge, touches its neighbour at that edge with its corner: that is one.)
    /// Vertices named by [`set_moving`](Self::set_moving) are looked at as in a step; [criterion](Self::set_criterion), separation and
    /// [collision filter](Self::set_collision_filter) are not asked.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Intersection, Topology};
    ///
    /// // The edges from vertex 3 pass through the large triangle.
    /// let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    /// let mut positions = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
    /// assert_eq!(detector.topology().edges()[3..5], [[3, 4], [3, 5]]);
    /// let mut found = Vec::new();
    /// detector.intersections(&positions, &mut found)?;
    /// assert_eq!(found, [3, 4].map(|edge| Intersection::EdgeFace { edge, face: 0 }));
    ///
    /// // Only the vertex touches; and now not even that.
    /// positions[3][2] = 0.0;
    /// assert!(detector.has_intersections(&positions)?);
    /// positions[3][2] = f32::MIN_POSITIVE;
    /// assert!(!detector.has_intersections(&positions)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If there is not one position for each of the mesh's vertices, a coordinate is NaN or infinite (named as of the
    /// [start](crate::Frame::Start)), or the question is cut short, as [`contacts`](Self::contacts).
    pub fn intersections<P: Position<Scalar = S>>(
        &mut self,
        positions: &[P],
        intersections: &mut Vec<Intersection>,
    ) -> Result<(), StepError> {
        let step = self.step(positions, positions)?;
        self.engine.intersections(&self.workers, &step, Wanted::All, intersections);
        self.engine.pairs.stop.result()
    }

    /// Whether there is any of the [`intersections`](Self::intersections). Ends at the first.
    ///
    /// # Errors
    /// As [`intersections`](Self::intersections).
    pub fn has_intersections<P: Position<Scalar = S>>(&mut self, positions: &[P]) -> Result<bool, StepError> {
        let step = self.step(positions, positions)?;
        let mut found = Vec::new();
        self.engine.intersections(&self.workers, &step, Wanted::Any, &mut found);
        if !found.is_empty() {
            return Ok(true);
        }
        self.engine.pairs.stop.result()?;
        Ok(false)
    }
}
