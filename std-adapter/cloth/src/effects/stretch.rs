//! Stretch along warp and weft: C = |w| − 1 for each of the two (Baraff and Witkin 1998), compliance 1/(k·A).
//!
//! Extended position-based dynamics (Macklin et al. 2016) with one iteration a step: Δx = −C·W∇C / (∇C·W∇C + α/h²). Where w
//! vanishes it has no direction, and nothing is done.

use super::membrane::{Membrane, all, image, of_triangles};
use super::registration::{Effect, Registration};
use crate::input::MEMBRANE_STIFFNESS;
use crate::plan::Plan;
use crate::schedule::{Local, Schedule};
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["stiffness", "weft_stiffness"],
    needs: &[],
    read: |table, _| {
        let range = 1e-3..=1e9;
        let warp = table.required_number("stiffness", MEMBRANE_STIFFNESS, range.clone())?;
        let weft = table.number("weft_stiffness", MEMBRANE_STIFFNESS, range)?;
        Ok(Box::new(Stretch {
            stiffness: [warp, weft.unwrap_or(warp)],
        }))
    },
};

#[derive(Debug)]
struct Stretch {
    /// Along warp and weft, in N/m.
    stiffness: [f64; 2],
}

impl Effect for Stretch {
    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        let cloth = plan.world.cloth;
        let springs = of_triangles(cloth, |membrane, area| Spring {
            membrane,
            compliance: self.stiffness.map(|k| 1.0 / (k * area)),
        });
        plan.add_constraint(Schedule::once(springs, cloth.mesh.positions.len()));
    }
}

#[derive(Debug)]
struct Spring {
    membrane: Membrane,
    /// Along warp and weft, in 1/J (C has no unit).
    compliance: [f64; 2],
}

impl Local<3> for Spring {
    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], stiffening: f64) -> [DVec3; 3] {
        let mut moves = [DVec3::ZERO; 3];
        let [warp, weft] = self.compliance;
        for (c, compliance) in [(self.membrane.a, warp), (self.membrane.b, weft)] {
            let stretched = image(c, [x[0] + moves[0], x[1] + moves[1], x[2] + moves[2]]);
            let length = stretched.length();
            let c = all(c);
            let weight = w[0] * c[0] * c[0] + w[1] * c[1] * c[1] + w[2] * c[2] * c[2];
            // Shorter than a millionth there is no direction to speak of.
            if length > 1e-6 && weight > 0.0 {
                let multiplier = (1.0 - length) / (weight + compliance * stiffening);
                let along = stretched * (multiplier / length);
                for k in 0..3 {
                    moves[k] += along * (w[k] * c[k]);
                }
            }
        }
        moves
    }
}
