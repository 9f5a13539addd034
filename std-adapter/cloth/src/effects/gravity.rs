//! Gravity: a uniform acceleration.

use super::registration::{Effect, Registration, Scope};
use crate::effects::plan::Plan;
use crate::input::{ACCELERATION, Field, SceneError, Table, ValueError};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Force, TimeStep};
use crate::world::SceneParts;
use selvedge_core::glam::DVec3;

const ACCELERATING: Field = Field::vector("acceleration", ACCELERATION, 1e4);

pub(super) const REGISTRATION: Registration = Registration::new(&["acceleration"], |table, _| {
    let acceleration = table.vector(&ACCELERATING)?;
    Ok(Box::new(
        acceleration.map_or_else(Gravity::default, |acceleration| Gravity { acceleration }),
    ))
});

/// A uniform acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    /// The acceleration, in m/s².
    pub acceleration: DVec3,
}

impl Default for Gravity {
    /// Returns the Earth's gravity, against z.
    fn default() -> Self {
        Self {
            acceleration: DVec3::new(0.0, 0.0, -9.81),
        }
    }
}

impl Gravity {
    /// Reads the acceleration from the table of a scene's effects, if it has gravity.
    pub(crate) fn read_acceleration(effects: &Table<'_>) -> Result<Option<DVec3>, SceneError> {
        let table = effects.table("gravity")?;
        table.map_or(Ok(None), |table| table.vector(&ACCELERATING))
    }
}

crate::identify!(Gravity { acceleration });

/// The name of the effect.
pub(crate) const NAME: &str = "gravity";

impl Effect for Gravity {
    fn name(&self) -> &'static str {
        NAME
    }

    fn scope(&self) -> Scope {
        Scope::Scene
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        ACCELERATING.check_vector(self.acceleration)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.gravity += self.acceleration;
        plan.add_force(*self);
    }
}

impl Force for Gravity {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let change = self.acceleration * step.h;
        for (velocity, &inverse_mass) in velocities.iter_mut().zip(step.inverse_masses) {
            if inverse_mass > 0.0 {
                *velocity += change;
            }
        }
    }

    /// Returns −Σm·g·x over free vertices.
    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let free = now
            .inverse_masses
            .iter()
            .zip(now.positions)
            .filter(|(inverse, _)| **inverse > 0.0);
        let weights = free.map(|(inverse, &position)| -self.acceleration.dot(position) / inverse);
        Some(StoredEnergy::Gravitational(weights.sum()))
    }
}
