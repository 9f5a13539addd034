//! Strain limit: no triangle is stretched beyond a given ratio along any direction. It is a part of the cloth's
//! [membranes](crate::solve::membranes).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, RATIO, ValueError};
use crate::world::SceneParts;

const LIMIT: Field = Field::new("limit", RATIO, 1.0, 10.0);

pub(super) const REGISTRATION: Registration = Registration::new(&["limit"], |table, _| {
    Ok(Box::new(StrainLimit {
        limit: table.required_number(&LIMIT)?,
    }))
});

/// No triangle is stretched beyond a ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainLimit {
    /// The largest ratio of a length to its length at rest, along any direction.
    pub limit: f64,
}

impl StrainLimit {
    /// Sets a limit.
    #[must_use]
    pub const fn at(limit: f64) -> Self {
        Self { limit }
    }
}

crate::identify!(StrainLimit { limit });

impl Effect for StrainLimit {
    fn name(&self) -> &'static str {
        "strain_limit"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        LIMIT.check(self.limit)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("longest over rest", RATIO.written_short(self.limit))]
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        plan.membranes().limit(self.limit, cloth);
    }
}
