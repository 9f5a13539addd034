//! Friction: Coulomb's law for every contact, as a part of its [row](crate::solve).

use super::registration::{Effect, Registration, Scope};
use crate::effects::plan::Plan;
use crate::input::{Field, RATIO, ValueError};
use crate::world::SceneParts;

const COEFFICIENT: Field = Field::new("coefficient", RATIO, 0.0, 10.0);

pub(super) const REGISTRATION: Registration = Registration::new(&["coefficient"], |table, _| {
    let coefficient = table.required_number(&COEFFICIENT)?;
    Ok(Box::new(Friction { coefficient }))
})
.needing(&["self_collision", "body_contact"]);

/// Friction in contacts. It needs [`SelfCollision`](super::SelfCollision) or [`BodyContact`](super::BodyContact).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// The coefficient of Coulomb's law.
    pub coefficient: f64,
}

crate::identify!(Friction { coefficient });

impl Effect for Friction {
    fn name(&self) -> &'static str {
        "friction"
    }

    fn scope(&self) -> Scope {
        Scope::Scene
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        COEFFICIENT.check(self.coefficient)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("coefficient of friction", RATIO.written_short(self.coefficient))]
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.friction_coefficient = self.coefficient;
    }
}
