//! Inflation: a prescribed pressure over time on one side of the cloth. The force on a vertex is the pressure times the gradient
//! of the volume ([walls](crate::solve::walls)). So a closed cloth gets neither a net force nor a torque. The pressure does work,
//! like wind, and stores no energy.

use super::enclosed::{open_edges, volume};
use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, PRESSURE, SceneError, Table, ValueError};
use crate::solve::walls::{Filling, Gas};
use crate::world::{KEY_TIME, SceneParts, check_key_time};

const GIVEN: Field = Field::new("pressure", PRESSURE, -1e7, 1e7);

pub(super) const REGISTRATION: Registration = Registration::new(&["pressure", "keyframes"], |table, _| {
    let given = table.number(&GIVEN)?;
    let keyframes = read_keyframes(table)?;
    match given {
        Some(_) if !keyframes.is_empty() => {
            let message = "inflation takes `pressure` or `keyframes`, not both".to_owned();
            Err(table.error("keyframes", message))
        }
        Some(pressure) => Ok(Box::new(Inflation::at(pressure))),
        None => Ok(Box::new(Inflation { keyframes })),
    }
});

fn read_keyframes(table: &Table<'_>) -> Result<Vec<PressureKey>, SceneError> {
    let mut keyframes: Vec<PressureKey> = Vec::new();
    for key in table.tables("keyframes")? {
        key.expect_keys(&["time", "pressure"])?;
        let next = PressureKey {
            time: key.required_number(&KEY_TIME)?,
            pressure: key.required_number(&GIVEN)?,
        };
        next.check(keyframes.last()).map_err(|error| key.placed(&error))?;
        keyframes.push(next);
    }
    Ok(keyframes)
}

/// A pressure on one side of the cloth. On a closed cloth it acts from inside, on an open one towards the side from which
/// triangles are counter-clockwise. A negative pressure pushes the other way.
#[derive(Clone, Debug, PartialEq)]
pub struct Inflation {
    /// Keyframes in order, at least one. The pressure is linear in between, and constant before the first and after the last.
    pub keyframes: Vec<PressureKey>,
}

/// A pressure at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureKey {
    /// The time in seconds of the simulation.
    pub time: f64,
    /// The pressure above that of the surrounding air, in Pa.
    pub pressure: f64,
}

impl PressureKey {
    fn check(&self, last: Option<&Self>) -> Result<(), ValueError> {
        GIVEN.check(self.pressure)?;
        check_key_time(self.time, last.map(|last| last.time))
    }
}

impl Inflation {
    /// Sets a constant pressure, in Pa.
    #[must_use]
    pub fn at(pressure: f64) -> Self {
        let keyframes = vec![PressureKey { time: 0.0, pressure }];
        Self { keyframes }
    }

    /// Returns the pressure in Pa at a time in seconds.
    fn pressure(&self, time: f64) -> f64 {
        let keys = &self.keyframes;
        let next = keys.partition_point(|key| key.time <= time);
        match (next.checked_sub(1).map(|last| keys[last]), keys.get(next)) {
            (Some(a), Some(b)) => a.pressure + (b.pressure - a.pressure) * ((time - a.time) / (b.time - a.time)),
            (Some(key), None) | (None, Some(&key)) => key.pressure,
            (None, None) => 0.0,
        }
    }
}

crate::identify!(Inflation { keyframes });
crate::identify!(PressureKey { time, pressure });

impl Effect for Inflation {
    fn name(&self) -> &'static str {
        "inflation"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.keyframes.is_empty() {
            let message = "inflation needs a `pressure`, or `keyframes` of it, such as [{ time = 0, pressure = \"2 kPa\" }]";
            return Err(ValueError::new("keyframes", message));
        }
        let before = std::iter::once(None).chain(self.keyframes.iter().map(Some));
        before.zip(&self.keyframes).try_for_each(|(last, key)| key.check(last))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        let is_inside_out = open_edges(&cloth.topology_as_made()) == 0 && volume(&cloth.mesh) < 0.0;
        plan.add_walls(Given {
            inflation: self.clone(),
            outward: if is_inside_out { -1.0 } else { 1.0 },
        });
    }
}

#[derive(Debug)]
struct Given {
    inflation: Inflation,
    /// The side to which the triangles' normals point.
    outward: f64,
}

impl Filling for Given {
    fn at(&self, time: f64) -> Gas {
        Gas::Pressure(self.outward * self.inflation.pressure(time))
    }
}
