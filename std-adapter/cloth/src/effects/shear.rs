//! Shear: ½k·A·(w_u·w_v)² (Baraff and Witkin 1998), a part of the cloth's [membranes](crate::solve::membranes).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, MEMBRANE_STIFFNESS, ValueError};
use crate::world::{Material, SceneParts};

const STIFFNESS: Field = Field::new("stiffness", MEMBRANE_STIFFNESS, 1e-3, 1e9);

pub(super) const REGISTRATION: Registration = Registration::new(&["stiffness"], |table, world| {
    let of_material = world.cloth.material.as_ref().map(Shear::of_material);
    Ok(Box::new(table.number_or(&STIFFNESS, Shear::new, of_material)?))
});

/// Resistance to changes of the angle between warp and weft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// The stiffness, in N/m.
    pub stiffness: f64,
}

impl Shear {
    pub(super) const fn of_material(material: &Material) -> Self {
        Self::new(material.shear)
    }

    /// Sets a stiffness in N/m.
    #[must_use]
    pub const fn new(stiffness: f64) -> Self {
        Self { stiffness }
    }
}

crate::identify!(Shear { stiffness });

impl Effect for Shear {
    fn name(&self) -> &'static str {
        "shear"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        STIFFNESS.check(self.stiffness)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("shear stiffness", MEMBRANE_STIFFNESS.written_short(self.stiffness))]
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let effect = plan.effect;
        plan.membranes().shear(effect, self.stiffness);
    }
}
