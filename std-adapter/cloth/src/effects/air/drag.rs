//! The drag of moving air.

use crate::effects::registration::ActsOn;
use crate::input::{AIR_DENSITY, Field, LENGTH, RATIO, SceneError, Table, ValueError};
use crate::world::{Cloth, SceneParts};

const DENSITY: Field = Field::new("air_density", AIR_DENSITY, 0.0, 1e3);
const DRAG: Field = Field::new("drag", RATIO, 0.0, 100.0);
const ROPE_DIAMETER: Field = Field::new("rope_diameter", LENGTH, 0.0, 1.0);

#[derive(Clone, Copy, Debug)]
pub(crate) struct Drag {
    /// The density of the air, in kg/m³.
    pub(super) density: f64,
    /// The drag coefficient for head-on flow.
    pub(super) coefficient: f64,
    /// The diameter of loose edges, in metres. At 0 the air does not push them.
    pub(in crate::effects) rope_diameter: f64,
}

impl Drag {
    /// Air at sea level that does not push ropes.
    pub(super) const DEFAULT: Self = Self {
        density: 1.2,
        coefficient: 1.0,
        rope_diameter: 0.0,
    };

    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let number = |field, default| table.number(field).map(|read| read.unwrap_or(default));
        Ok(Self {
            density: number(&DENSITY, Self::DEFAULT.density)?,
            coefficient: number(&DRAG, Self::DEFAULT.coefficient)?,
            rope_diameter: number(&ROPE_DIAMETER, Self::DEFAULT.rope_diameter)?,
        })
    }

    /// Checks the numbers, and that there are loose edges if they have a diameter.
    pub(super) fn check(self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        DENSITY.check(self.density)?;
        DRAG.check(self.coefficient)?;
        ROPE_DIAMETER.check(self.rope_diameter)?;
        if self.rope_diameter == 0.0 || world.cloths.iter().any(Cloth::has_loose_edges) {
            return Ok(());
        }
        let message = "is the diameter of loose edges, but no cloth has any: remove it, or add a rope";
        Err(ValueError::new(
            ROPE_DIAMETER.name,
            format!("`{}` {message}", ROPE_DIAMETER.name),
        ))
    }

    pub(super) fn acts_on(self) -> ActsOn {
        if self.rope_diameter > 0.0 {
            ActsOn::Vertices
        } else {
            ActsOn::Triangles
        }
    }

    /// Returns ½ρc over a density of the cloth.
    pub(in crate::effects) fn over(self, density: f64) -> f64 {
        0.5 * self.density * self.coefficient / density
    }
}
