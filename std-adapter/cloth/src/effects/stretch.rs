//! Stretch along warp and weft: ½k·A·(|w| − 1)² for each (Baraff and Witkin 1998), a part of the cloth's
//! [membranes](crate::solve::membranes).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::{Fabric, Plan};
use crate::input::{Field, MEMBRANE_STIFFNESS, ValueError};
use crate::world::{Material, SceneParts};

const WARP: Field = Field::new("stiffness", MEMBRANE_STIFFNESS, 1e-3, 1e9);
const WEFT: Field = Field::new("weft_stiffness", MEMBRANE_STIFFNESS, 1e-3, 1e9);

pub(super) const REGISTRATION: Registration = Registration::new(&["stiffness", "weft_stiffness"], |table, world| {
    let of_material = world.cloth.material.as_ref().map(Stretch::of_material);
    let stretch = table.number_or(&WARP, Stretch::isotropic, of_material)?;
    Ok(Box::new(Stretch {
        weft_stiffness: table.number(&WEFT)?.unwrap_or(stretch.weft_stiffness),
        ..stretch
    }))
});

/// Resistance to stretch and compression along warp and weft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The stiffness along the warp, in N/m.
    pub stiffness: f64,
    /// The stiffness along the weft, in N/m.
    pub weft_stiffness: f64,
}

impl Stretch {
    pub(super) const fn of_material(material: &Material) -> Self {
        Self {
            weft_stiffness: material.stretch[1],
            ..Self::isotropic(material.stretch[0])
        }
    }

    /// Sets the same stiffness along warp and weft, in N/m.
    #[must_use]
    pub const fn isotropic(stiffness: f64) -> Self {
        Self {
            stiffness,
            weft_stiffness: stiffness,
        }
    }
}

crate::identify!(Stretch {
    stiffness,
    weft_stiffness
});

impl Effect for Stretch {
    fn name(&self) -> &'static str {
        "stretch"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        WARP.check(self.stiffness)?;
        WEFT.check(self.weft_stiffness)
    }

    fn announce(&self, fabric: &mut Fabric) {
        fabric.stretch = Some([self.stiffness, self.weft_stiffness]);
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        let [warp, weft] = [self.stiffness, self.weft_stiffness].map(|k| MEMBRANE_STIFFNESS.written_short(k));
        if warp == weft {
            vec![("stiffness along warp and weft", warp)]
        } else {
            vec![("stiffness along the warp", warp), ("stiffness along the weft", weft)]
        }
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let effect = plan.effect;
        plan.membranes().stretch(effect, [self.stiffness, self.weft_stiffness]);
    }
}
