//! Plastic folds: cloth that is bent too far keeps some of the bend ([`bending`](crate::model::bending)).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::{Fabric, Plan};
use crate::input::{CURVATURE, Field, LARGEST_TIME, TIME, ValueError};
use crate::model::bending::Yield;
use crate::world::SceneParts;

const LIMIT: Field = Field::new("yield_curvature", CURVATURE, 1e-3, 1e6);
const CREEP: Field = Field::new("creep", TIME, 0.0, LARGEST_TIME);

pub(super) const REGISTRATION: Registration = Registration::new(&["yield_curvature", "creep"], |table, _| {
    let mut folds = PlasticFolds::beyond(table.required_number(&LIMIT)?);
    folds.creep = table.number(&CREEP)?.unwrap_or(folds.creep);
    Ok(Box::new(folds))
})
.needing(&["bend"]);

/// Folds that stay after cloth is bent too far. They act through [`Bend`](super::Bend).
///
/// The edge length h of a mesh limits its curvature to about 2/h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticFolds {
    /// The largest elastic curvature, in 1/m: one over the radius. A fold springs back by this curvature.
    pub yield_curvature: f64,
    /// The time in s in which the excess falls by a factor of e. At 0 it vanishes at once.
    pub creep: f64,
}

impl PlasticFolds {
    /// Makes folds stay at once beyond a curvature in 1/m.
    #[must_use]
    pub const fn beyond(yield_curvature: f64) -> Self {
        Self {
            yield_curvature,
            creep: 0.0,
        }
    }
}

crate::identify!(PlasticFolds { yield_curvature, creep });

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
