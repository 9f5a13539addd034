//! Body contact: the cloth keeps a thickness from bodies, and every step is certified not to pass through their triangles.
//!
//! Capsules and balls push vertices by their exact distance, so that cloth [slides on a smooth
//! surface](crate::contact::smooth_body). Edges and faces of the cloth are kept off by the pairs with the body's mesh.

use super::registration::{Effect, Registration, Scope};
use super::thickness;
use crate::contact::Thickness;
use crate::contact::smooth_body::SmoothBody;
use crate::effects::plan::Plan;
use crate::input::ValueError;
use crate::world::SceneParts;

pub(super) const REGISTRATION: Registration = Registration::new(&["thickness", "separation"], |table, _| {
    Ok(Box::new(BodyContact(thickness::read(table)?)))
});

/// The cloth keeps a thickness from bodies, and every step is certified not to pass through their triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyContact(pub Thickness);

crate::identify!(BodyContact { 0 });

impl Effect for BodyContact {
    fn name(&self) -> &'static str {
        "body_contact"
    }

    fn scope(&self) -> Scope {
        Scope::AllCloths
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if world.bodies.is_empty() {
            let message = "body contact has nothing to act on: the scene has no [[body]]";
            return Err(ValueError::new("", message));
        }
        thickness::check(&self.0)
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        thickness::settings(&self.0)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.contact.keep_from_bodies(self.0);
        let first = plan.first_vertex() as usize;
        let vertices = first..first + plan.scene.cloth.mesh.positions.len();
        let bodies = plan.scene.bodies.iter().enumerate();
        let smooth = bodies.filter_map(|(carrier, body)| {
            let (ends, radius) = body.capsule?;
            Some(SmoothBody {
                carrier,
                ends,
                radius,
                thickness: self.0.thickness,
                vertices: vertices.clone(),
            })
        });
        plan.smooth_bodies.extend(smooth);
    }
}
