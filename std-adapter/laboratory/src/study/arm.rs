//! The built-in arm scene in any number of steps.

use super::Frames;
use crate::scene::ArmScene;
use selvedge::Topology;
use selvedge::glam::DVec3;
use selvedge_cloth::sleeve::RefinementError;

/// The whole bend of an [`ArmScene`] in equal steps.
///
/// ```
/// use selvedge_laboratory::study::{ArmFrames, Frames};
/// let arm = ArmFrames::new(1, 30)?;
/// assert_eq!((arm.step_count(), arm.topology().triangles().len()), (30, 1345));
/// # Ok::<(), selvedge_cloth::sleeve::RefinementError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ArmFrames {
    scene: ArmScene,
    refinement: u32,
    steps: usize,
}

impl ArmFrames {
    /// Makes a sleeve of 1,345 triangles times `refinement`, bent in `steps` steps (at least one).
    ///
    /// # Errors
    /// Returns the errors of [`ArmScene::new`].
    pub fn new(refinement: u32, steps: usize) -> Result<Self, RefinementError> {
        Ok(Self {
            scene: ArmScene::new(refinement)?,
            refinement,
            steps: steps.max(1),
        })
    }
}

impl Frames for ArmFrames {
    fn name(&self) -> String {
        match self.refinement {
            1 => "Arm scene".to_owned(),
            refinement => format!("Arm scene, refined {refinement} times"),
        }
    }

    fn topology(&self) -> &Topology {
        self.scene.topology()
    }

    fn step_count(&self) -> usize {
        self.steps
    }

    fn step(&self, step: usize, start: &mut Vec<DVec3>, end: &mut Vec<DVec3>) {
        for (frame, positions) in [(step, start), (step + 1, end)] {
            positions.resize(self.topology().vertex_count(), DVec3::ZERO);
            let time = frame as f64 / self.steps as f64;
            self.scene.write_positions(time.min(1.0), positions);
        }
    }
}
