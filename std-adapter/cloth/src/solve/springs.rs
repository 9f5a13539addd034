//! Springs between vertices and anchors, which carry attachments: ½k|x − a|², with the anchor a where it is at the end of the
//! step.

use super::matrix::Matrix;
use super::term::{Prediction, Term};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Memory, TimeStep};
use selvedge_core::glam::{DVec3, Mat3A, Vec3};
use std::fmt::Debug;

/// Springs that an effect holds.
pub(crate) trait Springs: Debug + Send + Sync + Memory {
    /// Adds the vertex, the anchor at the end of the step, and the stiffness in N/m of each spring that holds. `x` has the bodies
    /// where they are then.
    fn springs(&self, step: &TimeStep<'_>, x: &[DVec3], springs: &mut Vec<(u32, DVec3, f64)>);

    /// Returns the stored energy, in J.
    fn energy(&self, positions: &[DVec3]) -> f64;
}

/// The springs in this step.
#[derive(Debug)]
pub(crate) struct Held<S> {
    effect: S,
    springs: Vec<(u32, DVec3, f64)>,
}

impl<S> Held<S> {
    pub(crate) const fn new(effect: S) -> Self {
        Self {
            effect,
            springs: Vec::new(),
        }
    }
}

impl<S: Springs> Term for Held<S> {
    fn begin(&mut self, step: &TimeStep<'_>, _: &Prediction, x: &[DVec3]) {
        self.springs.clear();
        self.effect.springs(step, x, &mut self.springs);
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for &(vertex, anchor, stiffness) in &self.springs {
            let way = x[vertex as usize] - anchor;
            gradient[vertex as usize] += way * stiffness;
            energy += 0.5 * stiffness * way.length_squared();
        }
        energy
    }

    fn curvature(&mut self, _: &[DVec3], matrix: &mut Matrix) {
        for &(vertex, _, stiffness) in &self.springs {
            matrix.add_own(vertex, Mat3A::from_diagonal(Vec3::splat(stiffness as f32)));
        }
    }

    fn energy(&self, now: &Configuration<'_>, own: usize) -> Vec<(usize, StoredEnergy)> {
        vec![(own, StoredEnergy::Elastic(self.effect.energy(now.positions)))]
    }

    fn memory(&self) -> Option<&dyn Memory> {
        Some(&self.effect)
    }

    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        Some(&mut self.effect)
    }
}
