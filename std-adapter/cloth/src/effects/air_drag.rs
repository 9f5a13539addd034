//! Air drag: still air slows all vertices at the same rate, v′ = −r·v. It adds to the [weight](crate::solve::prediction) of each
//! vertex in the solve, so that a step is stable for any rate.

use super::registration::{Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{FREQUENCY, Field, ValueError};
use crate::world::SceneParts;

const RATE: Field = Field::new("rate", FREQUENCY, 0.0, 1e6);

pub(super) const REGISTRATION: Registration = Registration::new(&["rate"], |table, _| {
    let rate = table.required_number(&RATE)?;
    Ok(Box::new(AirDrag { rate }))
});

/// The drag of still air on all vertices. [`Wind`](super::Wind) is moving air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirDrag {
    /// The rate at which a vertex loses velocity, in 1/s.
    pub rate: f64,
}

crate::identify!(AirDrag { rate });

impl Effect for AirDrag {
    fn name(&self) -> &'static str {
        "air_drag"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        RATE.check(self.rate)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_drag(self.rate);
    }
}
