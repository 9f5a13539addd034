//! Internal pressure: a closed cloth keeps its volume. The energy is ½·K·(V − r·V₀)²/(r·V₀), with the volume V of its
//! [walls](crate::solve::walls) and a bulk modulus K.

use super::enclosed::{open_edges, volume};
use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, PRESSURE, RATIO, ValueError};
use crate::solve::walls::{Filling, Gas};
use crate::world::SceneParts;

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

crate::identify!(InternalPressure { volume, modulus });

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
        plan.add_walls(Given {
            modulus: self.modulus,
            volume: self.volume * volume(&cloth.mesh),
        });
    }
}

/// A gas of this bulk modulus and volume.
#[derive(Debug)]
struct Given {
    modulus: f64,
    volume: f64,
}

impl Filling for Given {
    fn at(&self, _: f64) -> Gas {
        let Self { modulus, volume } = *self;
        Gas::Volume { modulus, volume }
    }
}
