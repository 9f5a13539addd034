//! Stretch along warp and weft: C = |w| − 1 for each (Baraff and Witkin 1998), with the compliance 1/(k·A).
//!
//! The solver is extended position-based dynamics (Macklin et al. 2016) with one iteration a step: Δx = −C·W∇C / (∇C·W∇C + α/h²).
//! Where w vanishes it has no direction, and nothing is corrected.
//!
//! Further `sweeps` keep the multipliers of the earlier ones. They leave less stretch and take longer. With 0 `sweeps` the step is
//! [solved until little changes](crate::model::elasticity), without levels.
//!
//! One iteration moves a pull by one edge, so that finer meshes would be softer. Coarse [`levels`] run first to
//! prevent this. One implicit step of h solves x − h²(k/ρ)·x″ = y for the inertial prediction y, with ρ the mass per area. A pull
//! decays by e over the distance h·√(k/ρ). Levels reach [`REACH`] times that distance, where e⁻⁴ remains. A coarser mesh needs no
//! levels.

use super::levels::{self, OnLevels, Tension};
use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::{Fabric, Plan};
use crate::input::{Count, Field, MEMBRANE_STIFFNESS, ValueError};
use crate::model::edge_lengths::Lasting;
use crate::model::elasticity::{Elasticity, Element};
use crate::model::hierarchy::mesh_spacing;
use crate::model::length::length;
use crate::model::membrane::{Membrane, all, image, of_triangles};
use crate::model::schedule::{Local, Schedule};
use crate::world::{Material, SceneParts};
use selvedge_core::glam::DVec3;

const WARP: Field = Field::new("stiffness", MEMBRANE_STIFFNESS, 1e-3, 1e9);
const WEFT: Field = Field::new("weft_stiffness", MEMBRANE_STIFFNESS, 1e-3, 1e9);
const SWEEPS: Count = Count::new("sweeps", 0, 100);

pub(super) const REGISTRATION: Registration =
    Registration::new(&["stiffness", "weft_stiffness", "sweeps", "levels"], |table, world| {
        let of_material = world.cloth.material.as_ref().map(Stretch::of_material);
        let stretch = table.number_or(&WARP, Stretch::isotropic, of_material)?;
        Ok(Box::new(Stretch {
            weft_stiffness: table.number(&WEFT)?.unwrap_or(stretch.weft_stiffness),
            sweeps: table.count(&SWEEPS)?.unwrap_or(stretch.sweeps),
            levels: levels::read_most(table)?,
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
    /// The number of sweeps over all triangles of the mesh in a step. With 0 stretch and shear are solved together until little
    /// changes. This is accurate at any time step and on any mesh, and takes up to three times as long for cloth without contact, or
    /// up to four and a half times with steps of 4 ms. Many layers on each other come to rest better with sweeps.
    pub sweeps: u32,
    /// The largest number of coarse levels that run before the mesh, from the finest. `None` uses all useful ones.
    pub levels: Option<u32>,
}

impl Stretch {
    pub(super) const fn of_material(material: &Material) -> Self {
        Self {
            weft_stiffness: material.stretch[1],
            ..Self::isotropic(material.stretch[0])
        }
    }

    /// Sets the same stiffness along warp and weft, in N/m, with one sweep.
    #[must_use]
    pub const fn isotropic(stiffness: f64) -> Self {
        Self {
            stiffness,
            weft_stiffness: stiffness,
            sweeps: 1,
            levels: None,
        }
    }
}

/// The distance between the seeds of the coarsest level, as a multiple of the distance that a pull travels in a step.
const REACH: f64 = 4.0;

impl Effect for Stretch {
    fn name(&self) -> &'static str {
        "stretch"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        WARP.check(self.stiffness)?;
        WEFT.check(self.weft_stiffness)?;
        SWEEPS.check(self.sweeps)?;
        levels::check(self.levels)
    }

    fn announce(&self, fabric: &mut Fabric) {
        fabric.stretch = Some([self.stiffness, self.weft_stiffness]);
        fabric.is_solved_together = self.sweeps == 0;
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        let [warp, weft] = [self.stiffness, self.weft_stiffness].map(|k| MEMBRANE_STIFFNESS.written_short(k));
        if warp == weft {
            vec![("stiffness along warp and weft", warp)]
        } else {
            vec![("stiffness along the warp", warp), ("stiffness along the weft", weft)]
        }
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        let sweeps = match self.sweeps {
            0 => Some(("sweeps", "until little changes".to_owned())),
            1 => None,
            sweeps => Some(("sweeps", sweeps.to_string())),
        };
        sweeps.into_iter().chain(levels::settings(self.levels)).collect()
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        let stiffness = [self.stiffness, self.weft_stiffness];
        if plan.solves_at_once() {
            let effect = plan.effect;
            return plan.membranes().stretch(effect, stiffness);
        }
        let fabric = plan.fabric();
        if fabric.is_solved_together {
            let [warp, weft] = stiffness;
            let elements = of_triangles(cloth, |membrane, area| Element {
                membrane,
                stiffness: [warp, weft, fabric.shear.unwrap_or(0.0)].map(|k| k * area),
            });
            plan.add_constraint(Elasticity::new(elements, cloth.mesh.positions.len()));
            return;
        }
        let springs = of_triangles(cloth, |membrane, area| Spring {
            membrane,
            compliance: stiffness.map(|k| 1.0 / (k * area)),
        });
        let springs = Schedule::times(springs, &cloth.mesh.positions, self.sweeps);
        let stiffest = self.stiffness.max(self.weft_stiffness);
        let way = plan.scene.time_step * (stiffest / cloth.density).sqrt();
        let coarsest = if way > mesh_spacing(cloth) { REACH * way } else { 0.0 };
        let levels = plan.levels(coarsest, self.levels);
        // Each level and the mesh itself do their part of the work.
        let parts = (levels.len() + 1) as f64;
        let [warp, weft] = stiffness;
        let shares = [Some(warp), Some(weft), fabric.shear].map(|k| k.map(|k| k / parts));
        let stretch = OnLevels::new(levels, springs, |triangle| Tension::stretch(triangle, shares));
        if fabric.is_limited {
            plan.add_constraint(stretch);
        } else {
            plan.add_constraint(Lasting::new(stretch, &cloth.mesh));
        }
    }
}

#[derive(Debug)]
struct Spring {
    membrane: Membrane,
    /// The compliances along warp and weft, in 1/J (C has no unit).
    compliance: [f64; 2],
}

impl Local<3> for Spring {
    /// The multipliers along warp and weft.
    type Multipliers = [f64; 2];

    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], stiffening: f64, so_far: &mut [f64; 2]) -> [DVec3; 3] {
        let mut moves = [DVec3::ZERO; 3];
        for (which, c) in [self.membrane.a, self.membrane.b].into_iter().enumerate() {
            let stretched = image(c, [x[0] + moves[0], x[1] + moves[1], x[2] + moves[2]]);
            let length = length(stretched);
            let c = all(c);
            let weight = w[0] * c[0] * c[0] + w[1] * c[1] * c[1] + w[2] * c[2] * c[2];
            // A vector shorter than a millionth has no reliable direction.
            if length > 1e-6 && weight > 0.0 {
                let compliance = self.compliance[which] * stiffening;
                let multiplier = (1.0 - length - compliance * so_far[which]) / (weight + compliance);
                so_far[which] += multiplier;
                let along = stretched * (multiplier / length);
                for k in 0..3 {
                    moves[k] += along * (w[k] * c[k]);
                }
            }
        }
        moves
    }

    /// Returns ½k·A·C² for both directions.
    fn energy(&self, x: [DVec3; 3]) -> Option<f64> {
        let [warp, weft] = self.compliance;
        let of = |c: [f64; 2], compliance: f64| 0.5 * (image(c, x).length() - 1.0).powi(2) / compliance;
        Some(of(self.membrane.a, warp) + of(self.membrane.b, weft))
    }
}
