//! Springs between vertices and anchors, which carry attachments and soft pins: ½k|x − a|², with the anchor a where it is at the
//! end of the step.

use super::loads::{Pull, SpringGroup};
use super::matrix::Matrix;
use super::term::{Prediction, Term};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Memory, TimeStep};
use selvedge_core::glam::{DVec3, Mat3A, Vec3};
use std::fmt::Debug;

/// A spring that holds a vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring {
    pub(crate) vertex: u32,
    /// The place of the anchor at the end of the step.
    pub(crate) anchor: DVec3,
    /// The stiffness, in N/m.
    pub(crate) stiffness: f64,
    pub(crate) group: SpringGroup,
    /// A vertex of the body that holds it; `None` for something else.
    pub(crate) body: Option<u32>,
}

impl Spring {
    /// Returns the way from the anchor to the vertex, in m, and the stored energy, in J.
    fn stretched(&self, x: &[DVec3]) -> (DVec3, f64) {
        let offset = x[self.vertex as usize] - self.anchor;
        (offset, 0.5 * self.stiffness * offset.length_squared())
    }
}

/// Springs that an effect holds.
pub(crate) trait Springs: Debug + Send + Sync + Memory {
    /// Adds each spring that holds. `x` has the bodies where they are at the end of the step.
    fn springs(&self, step: &TimeStep<'_>, x: &[DVec3], springs: &mut Vec<Spring>);

    /// Returns each spring that holds, with its anchor where the last step has left it.
    fn settled(&self) -> Vec<Spring>;
}

/// The springs in this step.
#[derive(Debug)]
pub(crate) struct Held<S> {
    effect: S,
    springs: Vec<Spring>,
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
        for spring in &self.springs {
            let (offset, stored) = spring.stretched(x);
            gradient[spring.vertex as usize] += offset * spring.stiffness;
            energy += stored;
        }
        energy
    }

    fn curvature(&mut self, _: &[DVec3], matrix: &mut Matrix) {
        for spring in &self.springs {
            matrix.add_own(spring.vertex, Mat3A::from_diagonal(Vec3::splat(spring.stiffness as f32)));
        }
    }

    fn energy(&self, now: &Configuration<'_>, own: usize) -> Vec<(usize, StoredEnergy)> {
        let settled = self.effect.settled();
        let stored = settled.iter().map(|spring| spring.stretched(now.positions).1).sum();
        vec![(own, StoredEnergy::Elastic(stored))]
    }

    fn visit_pulls(&self, x: &[DVec3], visit: &mut dyn FnMut(Pull)) {
        for spring in &self.springs {
            visit(Pull {
                group: spring.group,
                body: spring.body,
                anchor: spring.anchor,
                force: spring.stretched(x).0 * spring.stiffness,
            });
        }
    }

    fn memory(&self) -> Option<&dyn Memory> {
        Some(&self.effect)
    }

    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        Some(&mut self.effect)
    }
}
