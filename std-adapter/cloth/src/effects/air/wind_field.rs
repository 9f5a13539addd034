//! Wind that varies with place and time. It [pushes](crate::solve::air) triangles, and loose edges that have a
//! diameter, with the velocity of the air at the centre of each.
//!
//! A scene file makes a field from fans and vortices ([`AirSource`]); code may use any function ([`Air`]).

use super::drag::Drag;
use super::sources::{Air, AirSource, Fan, Vortex};
use crate::effects::plan::Plan;
use crate::effects::registration::{ActsOn, Effect, Registration};
use crate::input::ValueError;
use crate::solve::air::Blowing;
use crate::world::SceneParts;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;
use std::sync::Arc;

pub(in crate::effects) const REGISTRATION: Registration =
    Registration::new(&["fan", "vortex", "air_density", "drag", "rope_diameter"], |table, _| {
        let mut sources = Vec::new();
        for fan in table.tables("fan")? {
            sources.push(AirSource::Fan(Fan::read(&fan)?));
        }
        for vortex in table.tables("vortex")? {
            sources.push(AirSource::Vortex(Vortex::read(&vortex)?));
        }
        if sources.is_empty() {
            let message = "a field of wind needs at least one [[effects.wind_field.fan]] or [[effects.wind_field.vortex]]";
            return Err(table.error("fan", message.to_owned()));
        }
        let air = Drag::read(table)?;
        Ok(Box::new(WindField {
            air_density: air.density,
            drag: air.coefficient,
            rope_diameter: air.rope_diameter,
            ..WindField::from_sources(sources)
        }))
    });

/// Wind that varies with place and time.
///
/// ```
/// use selvedge_cloth::effects::{Air, WindField};
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::identify;
///
/// /// Faster with height and time.
/// #[derive(Debug)]
/// struct Rising;
/// identify!(Rising {});
///
/// impl Air for Rising {
///     fn velocity(&self, at: DVec3, time: f64) -> DVec3 {
///         DVec3::X * (2.0 * at.z * time.min(1.0))
///     }
/// }
///
/// let field = WindField::new(Rising);
/// assert_eq!(field.air.velocity(DVec3::Z, 0.5), DVec3::X);
/// ```
#[derive(Clone, Debug)]
pub struct WindField {
    /// The motion of the air.
    pub air: Arc<dyn Air>,
    /// The density of the air, in kg/m³.
    pub air_density: f64,
    /// The drag coefficient of a triangle or a loose edge in head-on flow. Round cords have about 1.1.
    pub drag: f64,
    /// The diameter of loose edges, in metres. At 0 the wind does not push them.
    pub rope_diameter: f64,
}

impl WindField {
    /// Makes a field of air at sea level that does not push ropes.
    #[must_use]
    pub fn new(air: impl Air + 'static) -> Self {
        Self {
            air: Arc::new(air),
            air_density: Drag::DEFAULT.density,
            drag: Drag::DEFAULT.coefficient,
            rope_diameter: Drag::DEFAULT.rope_diameter,
        }
    }

    /// Makes a field from fans and vortices, as scene files do.
    #[must_use]
    pub fn from_sources(sources: Vec<AirSource>) -> Self {
        Self::new(sources)
    }

    const fn resistance(&self) -> Drag {
        Drag {
            density: self.air_density,
            coefficient: self.drag,
            rope_diameter: self.rope_diameter,
        }
    }
}

crate::identify!(WindField {
    air,
    air_density,
    drag,
    rope_diameter
});

impl Effect for WindField {
    fn name(&self) -> &'static str {
        "wind_field"
    }

    fn acts_on(&self) -> ActsOn {
        self.resistance().acts_on()
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        self.air.check()?;
        self.resistance().check(world)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_air(Field(Arc::clone(&self.air)), self.resistance());
    }
}

/// The air at the middle of a triangle or an edge.
#[derive(Debug)]
struct Field(Arc<dyn Air>);

impl Blowing for Field {
    fn velocity(&self, corners: &[DVec3], time: f64) -> DVec3 {
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let velocity = self.0.velocity(middle, time);
        if velocity.is_finite() { velocity } else { DVec3::ZERO }
    }
}
