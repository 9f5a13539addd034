//! Gravity: the same acceleration everywhere.

use super::registration::{Effect, Registration};
use crate::input::ACCELERATION;
use crate::plan::Plan;
use crate::step::{Force, TimeStep};
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["acceleration"],
    needs: &[],
    read: |table, _| {
        let acceleration = table.vector("acceleration", ACCELERATION, 1e4)?;
        Ok(Box::new(Gravity(acceleration.unwrap_or(DVec3::new(0.0, 0.0, -9.81)))))
    },
};

/// In m/s².
#[derive(Debug)]
struct Gravity(DVec3);

impl Effect for Gravity {
    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        plan.add_force(*self);
    }
}

impl Force for Gravity {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let change = self.0 * step.h;
        for (velocity, &inverse_mass) in velocities.iter_mut().zip(step.inverse_masses) {
            if inverse_mass > 0.0 {
                *velocity += change;
            }
        }
    }
}
