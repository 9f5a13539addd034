//! Self-collision: the cloth keeps a thickness from itself, and every step is certified to be free of contact.
//!
//! The effect only says so; the work is that of [`contact`](crate::contact), shared with body contact.

use super::registration::{Effect, Registration};
use super::thickness;
use crate::contact::Thickness;
use crate::input::ValueError;
use crate::plan::Plan;
use crate::world::SceneParts;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["thickness", "separation"],
    needs: &[],
    read: |table, _| Ok(Box::new(SelfCollision(thickness::read(table)?))),
};

/// The cloth keeps a thickness from itself, and every step is certified to be free of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfCollision(pub Thickness);

impl Effect for SelfCollision {
    fn name(&self) -> &'static str {
        "self_collision"
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        thickness::check(&self.0)
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        thickness::settings(&self.0)
    }

    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        plan.contact.cloth = Some((plan.effect, self.0));
    }
}
