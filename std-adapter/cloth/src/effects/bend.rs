//! Bending: the energy of a flexural rigidity ([`bending`](crate::model::bending)). The cloth is flat at rest.

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{BENDING_STIFFNESS, Field, ValueError};
use crate::model::bending::hinges;
use crate::world::{Material, SceneParts};

const WARP: Field = Field::new("stiffness", BENDING_STIFFNESS, 1e-12, 10.0);
const WEFT: Field = Field::new("weft_stiffness", BENDING_STIFFNESS, 1e-12, 10.0);

pub(super) const REGISTRATION: Registration = Registration::new(&["stiffness", "weft_stiffness"], |table, world| {
    let of_material = world.cloth.material.as_ref().map(Bend::of_material);
    let mut bend = table.number_or(&WARP, Bend::isotropic, of_material)?;
    bend.weft_stiffness = table.number(&WEFT)?.unwrap_or(bend.weft_stiffness);
    Ok(Box::new(bend))
});

/// Resistance to bending. The cloth is flat at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The flexural rigidity of the warp, in N·m: the moment per metre of width that bends it by one radian per metre.
    pub stiffness: f64,
    /// The flexural rigidity of the weft, in N·m. At an angle of φ to the warp it is (√u·cos²φ + √v·sin²φ)² (Huber 1914).
    pub weft_stiffness: f64,
}

impl Bend {
    pub(super) const fn of_material(material: &Material) -> Self {
        Self {
            weft_stiffness: material.bend[1],
            ..Self::isotropic(material.bend[0])
        }
    }

    /// Sets the same rigidity along warp and weft, in N·m.
    #[must_use]
    pub const fn isotropic(stiffness: f64) -> Self {
        Self {
            stiffness,
            weft_stiffness: stiffness,
        }
    }

    /// Returns the rigidity in a direction, given the square of its cosine to the warp.
    fn along(&self, of_warp: f64) -> f64 {
        let root = self.stiffness.sqrt() * of_warp + self.weft_stiffness.sqrt() * (1.0 - of_warp);
        root * root
    }
}

crate::identify!(Bend {
    stiffness,
    weft_stiffness
});

impl Effect for Bend {
    fn name(&self) -> &'static str {
        "bend"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        WARP.check(self.stiffness)?;
        WEFT.check(self.weft_stiffness)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        let [warp, weft] = [self.stiffness, self.weft_stiffness].map(|k| BENDING_STIFFNESS.written_short(k));
        if warp == weft {
            vec![("bending stiffness", warp)]
        } else {
            vec![
                ("bending stiffness of the warp", warp),
                ("bending stiffness of the weft", weft),
            ]
        }
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let hinges = hinges(plan.scene.cloth, |of_warp| self.along(of_warp));
        let folds = plan.fabric().folds.map(|when| (when, plan.scene.cloth.sources_as_made()));
        let folds = folds.as_ref().map(|(when, copied)| (*when, copied.as_slice()));
        plan.add_bending(&hinges, folds);
    }
}
