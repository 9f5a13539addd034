//! Self-collision: cloth keeps a thickness from itself and from other cloths, and every step is certified to be free of contact.
//!
//! [`contact`](crate::contact) does the work, for this effect and for body contact.

use super::registration::{Effect, Registration, Scope};
use super::thickness;
use crate::contact::Thickness;
use crate::effects::plan::{Fabric, Plan};
use crate::input::ValueError;
use crate::world::SceneParts;

pub(super) const REGISTRATION: Registration = Registration::new(&["thickness", "separation"], |table, _| {
    Ok(Box::new(SelfCollision(thickness::read(table)?)))
});

/// Cloth keeps a thickness from itself and from other cloths, and every step is certified to be free of contact.
///
/// Two cloths keep the mean of their thicknesses from each other, and every step keeps the mean of their separations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfCollision(pub Thickness);

crate::identify!(SelfCollision { 0 });

impl Effect for SelfCollision {
    fn name(&self) -> &'static str {
        "self_collision"
    }

    fn scope(&self) -> Scope {
        Scope::AllCloths
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        thickness::check(&self.0)
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        thickness::settings(&self.0)
    }

    fn announce(&self, fabric: &mut Fabric) {
        fabric.thickness = Some(self.0.thickness);
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.contact.keep_from_cloth(self.0);
    }
}
