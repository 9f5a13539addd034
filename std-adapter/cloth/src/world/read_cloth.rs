//! `[cloth]`, or `[[cloth]]` for each of several.

use super::cloth::{
    CELLS, CELLS_AROUND, CORNER, Cloth, DENSITY, FIRST, FROM, NAME, RADIUS, REFINEMENT, SECOND, TO, VELOCITY, WARP,
};
use super::{Material, shapes};
use crate::effects::effect_names;
use crate::input::{SceneError, Table};
use selvedge_core::glam::DVec3;

#[derive(Clone, Copy)]
enum ClothShape {
    Sleeve,
    Sheet,
    Tube,
    File,
}

const SHAPES: [(&str, ClothShape); 4] = [
    ("sleeve", ClothShape::Sleeve),
    ("sheet", ClothShape::Sheet),
    ("tube", ClothShape::Tube),
    ("file", ClothShape::File),
];

impl Cloth {
    /// All but effects of its own, whose tables have the names of effects.
    pub(crate) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let shape = table.required_choice("shape", &SHAPES)?;
        let own: &[&str] = match shape {
            ClothShape::Sleeve => &["refinement"],
            ClothShape::Sheet => &["corner", "sides", "cells"],
            ClothShape::Tube => &["from", "to", "radius", "cells"],
            ClothShape::File => &["file", "warp"],
        };
        table.expect_keys(&[&["name", "shape", "material", "density", "velocity"], own, &effect_names()].concat())?;
        let material = table.choice("material", &Material::ALL.map(|material| (material.name, material)))?;
        let density = || table.number_or(&DENSITY, |density| density, material.map(|material| material.density));
        let made = match shape {
            ClothShape::Sleeve => Self::sleeve(table.count(&REFINEMENT)?.unwrap_or(1), density()?),
            ClothShape::Sheet => {
                let sides = table.required_table("sides")?;
                sides.expect_keys(&["first", "second"])?;
                let sides = [sides.required_vector(&FIRST)?, sides.required_vector(&SECOND)?];
                let corner = table.vector(&CORNER)?.unwrap_or_default();
                Self::sheet(corner, sides, table.two_counts(&CELLS)?, density()?)
            }
            ClothShape::Tube => {
                let ends = [table.required_vector(&FROM)?, table.required_vector(&TO)?];
                Self::tube(
                    ends,
                    table.required_number(&RADIUS)?,
                    table.two_counts(&CELLS_AROUND)?,
                    density()?,
                )
            }
            ClothShape::File => {
                let warp = table.vector(&WARP)?.unwrap_or(DVec3::X);
                Self::of_mesh(shapes::of_file(table)?, warp, density()?)
            }
        };
        let mut cloth = made.map_err(|error| table.placed(&error))?;
        cloth.velocity = table.vector(&VELOCITY)?.unwrap_or_default();
        cloth.material = material;
        cloth.name = table.text("name")?.unwrap_or(NAME).to_owned();
        Ok(cloth)
    }
}
