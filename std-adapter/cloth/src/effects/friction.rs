//! Friction: Coulomb's law on positions (Macklin et al. 2014), for every contact that pushed in this step.
//!
//! A contact that moved its two sides apart by p may undo up to μ·p of their sliding since the start of the step. It stores how
//! much it has undone. So friction may act again when other constraints have moved the cloth or contacts have pushed further.
//! Each time the sum of its corrections is projected into the cone (projected Gauss-Seidel).

use super::registration::{Effect, Registration, Scope};
use crate::effects::plan::Plan;
use crate::input::{Field, RATIO, ValueError};
use crate::model::length::shortened;
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::world::SceneParts;
use selvedge_core::glam::DVec3;

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
        if plan.solves_at_once() {
            plan.friction_coefficient = self.coefficient;
        } else {
            plan.add_friction(*self);
        }
    }
}

impl Constraint for Friction {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        let mut largest = 0.0_f64;
        for touch in &mut touches.list {
            if !(touch.mobility > 0.0) || touch.push == 0.0 && touch.rubbed == DVec3::ZERO {
                continue;
            }
            let mut sliding = -touch.drift;
            // A vertex alone, an end of an edge and a corner of a face are frequent.
            for k in 0..4 {
                if touch.weights[k] != 0.0 {
                    let vertex = touch.vertices[k] as usize;
                    sliding += (positions[vertex] - step.start[vertex]) * touch.weights[k];
                }
            }
            sliding -= touch.normal * sliding.dot(touch.normal);
            // The sum is the sliding without friction.
            let rubbed = shortened(touch.rubbed + sliding, self.coefficient * touch.push);
            let back: DVec3 = (touch.rubbed - rubbed) / touch.mobility;
            if !back.is_finite() {
                continue;
            }
            let change = rubbed.distance_squared(touch.rubbed);
            if change > largest {
                largest = change;
            }
            touch.rubbed = rubbed;
            for k in 0..4 {
                if touch.weights[k] != 0.0 {
                    let vertex = touch.vertices[k] as usize;
                    positions[vertex] += back * (step.inverse_masses[vertex] * touch.weights[k]);
                }
            }
        }
        touches.rubbed = largest.sqrt();
    }
}
