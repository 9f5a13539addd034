//! Stretch resistance of loose edges: ropes, laces and fringes ([`ropes`](crate::solve::ropes)).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{FORCE, Field, ValueError};
use crate::world::SceneParts;

const STIFFNESS: Field = Field::new("stiffness", FORCE, 1e-3, 1e9);

pub(super) const REGISTRATION: Registration = Registration::new(&["stiffness"], |table, _| {
    Ok(Box::new(RopeStretch::new(table.required_number(&STIFFNESS)?)))
});

/// Resistance of loose edges to stretch and compression.
///
/// ```
/// use selvedge_cloth::effects::RopeStretch;
///
/// // A polyester cord of 6 mm stretches by a hundredth under 900 N.
/// assert_eq!(RopeStretch::new(90e3).stiffness * 0.01, 900.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeStretch {
    /// The axial stiffness in N: the force that doubles the length. For a solid rod it is Young's modulus times the
    /// cross-section.
    pub stiffness: f64,
}

impl RopeStretch {
    /// Sets an axial stiffness in N.
    #[must_use]
    pub const fn new(stiffness: f64) -> Self {
        Self { stiffness }
    }
}

crate::identify!(RopeStretch { stiffness });

impl Effect for RopeStretch {
    fn name(&self) -> &'static str {
        "rope_stretch"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::LooseEdges
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        STIFFNESS.check(self.stiffness)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("axial stiffness of loose edges", FORCE.written_short(self.stiffness))]
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let effect = plan.effect;
        plan.ropes().stretch(effect, self.stiffness);
    }
}
