//! Plasticity of folds: what is bent too far keeps some of it ([`bending`](crate::model::bending)). Bending does it; this says when.

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::{Fabric, Plan};
use crate::input::{CURVATURE, Field, LARGEST_TIME, TIME, ValueError};
use crate::model::bending::Yield;
use crate::world::SceneParts;

const LIMIT: Field = Field::new("yield_curvature", CURVATURE, 1e-3, 1e6);
const CREEP: Field = Field::new("creep", TIME, 0.0, LARGEST_TIME);

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["yield_curvature", "creep"],
    needs: &["bend"],
    read: |table, _| {
        let mut folds = PlasticFolds::beyond(table.required_number(&LIMIT)?);
        folds.creep = table.number(&CREEP)?.unwrap_or(folds.creep);
        Ok(Box::new(folds))
    },
};

/// Folds that stay when cloth is bent too far. Acts through [`Bend`](super::Bend), whose part that is too stiff for its stages is left out then.
///
/// A mesh whose edges are h long cannot be bent by more than some 2/h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticFolds {
    /// How far cloth may be bent and still go back, in 1/m: one over the radius. A fold gives back so much.
    pub yield_curvature: f64,
    /// In what time what is beyond that comes down to 1/e of it, in s; 0: at once.
    pub creep: f64,
}

impl PlasticFolds {
    /// At once, beyond a curvature in 1/m.
    #[must_use]
    pub const fn beyond(yield_curvature: f64) -> Self {
        Self {
            yield_curvature,
            creep: 0.0,
        }
    }
}

impl Effect for PlasticFolds {
    fn name(&self) -> &'static str {
        "plastic_folds"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        LIMIT.check(self.yield_curvature)?;
        CREEP.check(self.creep)
    }

    fn announce(&self, fabric: &mut Fabric) {
        fabric.folds = Some(Yield {
            curvature: self.yield_curvature,
            creep: self.creep,
        });
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("folds stay beyond", CURVATURE.written_short(self.yield_curvature))]
    }

    fn register(&self, _: &mut Plan<'_>) {}
}
