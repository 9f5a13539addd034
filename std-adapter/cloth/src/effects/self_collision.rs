//! Self-collision: the cloth keeps a thickness from itself, and every step is certified to be free of contact.
//!
//! The effect only says so; the work is that of [`contact`](crate::contact), shared with body contact.

use super::{Effect, Registration};
use crate::contact::Thickness;
use crate::plan::Plan;

pub(super) const REGISTRATION: Registration = Registration {
    name: "self_collision",
    keys: &["thickness", "separation"],
    needs: &[],
    read: |table, _| Ok(Box::new(SelfCollision(Thickness::read(table)?))),
};

#[derive(Debug)]
struct SelfCollision(Thickness);

impl Effect for SelfCollision {
    fn settings(&self) -> Vec<(&'static str, String)> {
        self.0.settings()
    }

    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        plan.contact.cloth = Some((plan.effect, self.0));
    }
}
