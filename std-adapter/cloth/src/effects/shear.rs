//! Shear: C = w_u·w_v (Baraff and Witkin 1998) with the compliance 1/(k·A). Like [`stretch`](super::stretch) it runs in one or
//! several sweeps per step, or is solved together with it.

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::{Fabric, Plan};
use crate::input::{Count, Field, MEMBRANE_STIFFNESS, ValueError};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::membrane::{Membrane, all, image, of_triangles};
use crate::model::schedule::{Local, Schedule};
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::world::{Material, SceneParts};
use selvedge_core::glam::DVec3;

const STIFFNESS: Field = Field::new("stiffness", MEMBRANE_STIFFNESS, 1e-3, 1e9);
const SWEEPS: Count = Count::new("sweeps", 1, 100);

pub(super) const REGISTRATION: Registration = Registration::new(&["stiffness", "sweeps"], |table, world| {
    let of_material = world.cloth.material.as_ref().map(Shear::of_material);
    let shear = table.number_or(&STIFFNESS, Shear::new, of_material)?;
    Ok(Box::new(Shear {
        sweeps: table.count(&SWEEPS)?.unwrap_or(shear.sweeps),
        ..shear
    }))
});

/// Resistance to changes of the angle between warp and weft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// The stiffness, in N/m.
    pub stiffness: f64,
    /// The number of sweeps over all triangles in a step, unless the stretch of the cloth is solved until little
    /// changes ([`Stretch::sweeps`](super::Stretch::sweeps)). Then shear is solved with it.
    pub sweeps: u32,
}

impl Shear {
    pub(super) const fn of_material(material: &Material) -> Self {
        Self::new(material.shear)
    }

    /// Sets a stiffness in N/m, in one sweep.
    #[must_use]
    pub const fn new(stiffness: f64) -> Self {
        Self { stiffness, sweeps: 1 }
    }
}

impl Effect for Shear {
    fn name(&self) -> &'static str {
        "shear"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        STIFFNESS.check(self.stiffness)?;
        SWEEPS.check(self.sweeps)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("shear stiffness", MEMBRANE_STIFFNESS.written_short(self.stiffness))]
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        (self.sweeps > 1)
            .then(|| ("sweeps", self.sweeps.to_string()))
            .into_iter()
            .collect()
    }

    fn announce(&self, fabric: &mut Fabric) {
        fabric.shear = Some(self.stiffness);
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        if plan.solves_at_once() {
            let effect = plan.effect;
            return plan.membranes().shear(effect, self.stiffness);
        }
        let angles = of_triangles(cloth, |membrane, area| Angle {
            membrane,
            compliance: 1.0 / (self.stiffness * area),
        });
        let angles = Schedule::times(angles, &cloth.mesh.positions, self.sweeps);
        if plan.fabric().is_solved_together {
            plan.add_constraint(WithStretch(angles));
        } else {
            plan.add_constraint(angles);
        }
    }
}

/// Angles that the effect of stretch [moves](crate::model::elasticity).
#[derive(Debug)]
struct WithStretch(Schedule<Angle, 3>);

impl Constraint for WithStretch {
    fn project(&mut self, _: &TimeStep<'_>, _: &mut [DVec3], _: &mut Touches) {}

    fn is_inner(&self) -> bool {
        true
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        self.0.energy(now)
    }
}

#[derive(Debug)]
struct Angle {
    membrane: Membrane,
    compliance: f64,
}

impl Local<3> for Angle {
    type Multipliers = f64;

    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], stiffening: f64, so_far: &mut f64) -> [DVec3; 3] {
        let Membrane { a, b, .. } = self.membrane;
        let (warp, weft) = (image(a, x), image(b, x));
        let (a, b) = (all(a), all(b));
        let mut gradients = [DVec3::ZERO; 3];
        let compliance = self.compliance * stiffening;
        let mut weight = compliance;
        for k in 0..3 {
            gradients[k] = weft * a[k] + warp * b[k];
            weight += w[k] * gradients[k].length_squared();
        }
        let multiplier = (-warp.dot(weft) - compliance * *so_far) / weight;
        *so_far += multiplier;
        for k in 0..3 {
            gradients[k] *= multiplier * w[k];
        }
        gradients
    }

    /// Returns ½k·A·C².
    fn energy(&self, x: [DVec3; 3]) -> Option<f64> {
        let c = image(self.membrane.a, x).dot(image(self.membrane.b, x));
        Some(0.5 * c * c / self.compliance)
    }
}
