//! Internal pressure: a closed cloth keeps its volume, by one constraint on all its vertices (Müller et al. 2007).
//!
//! C = V(x) − r·V₀ with the volume V ([`Walls`]) and the energy ½·K·C²/(r·V₀), K a bulk modulus: compliance r·V₀/K.

use super::enclosed::{Walls, open_edges};
use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, PRESSURE, RATIO, ValueError};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::solve::walls::Gas;
use crate::world::SceneParts;
use selvedge_core::glam::DVec3;

const VOLUME: Field = Field::new("volume", RATIO, 0.01, 10.0);
const MODULUS: Field = Field::new("modulus", PRESSURE, 1e-3, 1e9);

pub(super) const REGISTRATION: Registration = Registration::new(&["volume", "modulus"], |table, _| {
    let mut pressure = InternalPressure::with_volume_ratio(table.required_number(&VOLUME)?);
    if let Some(modulus) = table.number(&MODULUS)? {
        pressure.modulus = modulus;
    }
    Ok(Box::new(pressure))
});

/// A closed cloth keeps a volume, as if it were filled with gas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InternalPressure {
    /// The target volume over the volume at rest.
    pub volume: f64,
    /// The bulk modulus of the gas, in Pa.
    pub modulus: f64,
}

impl InternalPressure {
    /// Sets the target volume, with the modulus of air.
    #[must_use]
    pub const fn with_volume_ratio(volume: f64) -> Self {
        Self { volume, modulus: 1e5 }
    }
}

impl Effect for InternalPressure {
    fn name(&self) -> &'static str {
        "internal_pressure"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        VOLUME.check(self.volume)?;
        MODULUS.check(self.modulus)?;
        match open_edges(&world.cloth.topology) {
            0 => Ok(()),
            open => {
                let message = format!("internal pressure needs a closed cloth, but this one has {open} open edges");
                Err(ValueError::new(VOLUME.name, message))
            }
        }
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        if open_edges(&cloth.topology) > 0 {
            // A torn cloth no longer holds gas.
            return;
        }
        let walls = Walls::new(cloth);
        let rest = walls.volume(&cloth.mesh.positions);
        if plan.solves_at_once() {
            return plan.add_walls(Given {
                modulus: self.modulus,
                volume: self.volume * rest,
            });
        }
        plan.add_constraint(Filling {
            goal: self.volume * rest,
            compliance: self.volume * rest.abs() / self.modulus,
            walls,
        });
    }
}

/// A gas of this bulk modulus and volume.
#[derive(Debug)]
struct Given {
    modulus: f64,
    volume: f64,
}

impl crate::solve::walls::Filling for Given {
    fn at(&self, _: f64) -> Gas {
        let Self { modulus, volume } = *self;
        Gas::Volume { modulus, volume }
    }
}

#[derive(Debug)]
struct Filling {
    goal: f64,
    compliance: f64,
    walls: Walls,
}

impl Constraint for Filling {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        let walls = &mut self.walls;
        walls.look(positions);
        let mut weight = self.compliance / (step.h * step.h);
        for vertex in 0..walls.len() {
            weight += step.inverse_masses[vertex] * walls.gradient(vertex).length_squared();
        }
        let multiplier = (self.goal - walls.volume(positions)) / weight;
        for vertex in 0..walls.len() {
            positions[vertex] += walls.gradient(vertex) * (multiplier * step.inverse_masses[vertex]);
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let excess = self.walls.volume(now.positions) - self.goal;
        Some(StoredEnergy::Elastic(0.5 * excess * excess / self.compliance))
    }
}
