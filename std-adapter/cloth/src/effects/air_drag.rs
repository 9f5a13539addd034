//! Air drag: still air slows every vertex down at the same rate, v′ = −r·v. Solved exactly, so stable for any rate.

use super::registration::{Effect, Registration};
use crate::input::FREQUENCY;
use crate::plan::Plan;
use crate::step::{Force, TimeStep};
use libm::exp;
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["rate"],
    needs: &[],
    read: |table, _| {
        let rate = table.required_number("rate", FREQUENCY, 0.0..=1e6)?;
        Ok(Box::new(AirDrag { rate }))
    },
};

#[derive(Debug)]
struct AirDrag {
    /// Per second.
    rate: f64,
}

impl Effect for AirDrag {
    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        plan.add_force(*self);
    }
}

impl Force for AirDrag {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let factor = exp(-self.rate * step.h);
        for velocity in velocities {
            *velocity *= factor;
        }
    }
}
