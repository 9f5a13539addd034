//! Reads `[cloth]`, or each of several `[[cloth]]`.

use crate::effects::effect_names;
use crate::input::{SceneError, Table};
use crate::world::cloth::{
    CELLS, CELLS_AROUND, CORNER, Cloth, DENSITY, FIRST, FROM, LINEAR_DENSITY_OF_EDGES, NAME, POINTS, RADIUS, REFINEMENT, SECOND,
    SEGMENTS, TO, VELOCITY, WARP,
};
use crate::world::{Material, read_mesh};
use selvedge_core::glam::DVec3;

#[derive(Clone, Copy)]
enum ClothShape {
    Sleeve,
    Sheet,
    Tube,
    Rope,
    File,
    Mesh,
}

const SHAPES: [(&str, ClothShape); 6] = [
    ("sleeve", ClothShape::Sleeve),
    ("sheet", ClothShape::Sheet),
    ("tube", ClothShape::Tube),
    ("rope", ClothShape::Rope),
    ("file", ClothShape::File),
    ("mesh", ClothShape::Mesh),
];

impl Cloth {
    /// Reads a cloth without its own effects. Returns it with the number of isolated vertices of its file, which are left out.
    pub(crate) fn read(table: &Table<'_>) -> Result<(Self, usize), SceneError> {
        let shape = table.required_choice("shape", &SHAPES)?;
        let of_mesh = [
            &read_mesh::MESH_KEYS[..],
            &["material", "density", "warp", LINEAR_DENSITY_OF_EDGES.name],
        ]
        .concat();
        let of_file = [&of_mesh[..], &["file", "group", "rest_file"]].concat();
        let of_code = [&of_mesh[..], &["mesh"]].concat();
        let own: &[&str] = match shape {
            ClothShape::Sleeve => &["material", "density", "refinement"],
            ClothShape::Sheet => &["material", "density", "corner", "sides", "cells"],
            ClothShape::Tube => &["material", "density", "from", "to", "radius", "cells"],
            ClothShape::Rope => &["points", "segments", LINEAR_DENSITY_OF_EDGES.name],
            ClothShape::File => &of_file,
            ClothShape::Mesh => &of_code,
        };
        table.expect_keys(&[&["name", "shape", "velocity"], own, &effect_names()].concat())?;
        let material = table.choice("material", &Material::ALL.map(|material| (material.name, material)))?;
        let density = || table.number_or(&DENSITY, |density| density, material.map(|material| material.density));
        let (mut isolated, mut file) = (0, None);
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
            ClothShape::Rope => Self::rope(
                &table.required_vectors(&POINTS)?,
                table.required_count(&SEGMENTS)?,
                table.required_number(&LINEAR_DENSITY_OF_EDGES)?,
            ),
            ClothShape::File | ClothShape::Mesh => {
                let warp = table.vector(&WARP)?.unwrap_or(DVec3::X);
                let linear_density = table.number(&LINEAR_DENSITY_OF_EDGES)?;
                let read = match shape {
                    ClothShape::Mesh => read_mesh::cloth_of_code(table, table.named_mesh()?)?,
                    _ => read_mesh::cloth_of_file(table, linear_density.is_some())?,
                };
                isolated = read.left_out;
                file = Some(read.file).filter(|file| !file.is_cloth());
                let mut mesh = read.mesh;
                let start = read.rest.map(|rest| std::mem::replace(&mut mesh.positions, rest));
                let made = match linear_density {
                    None => Self::from_mesh(mesh, warp, density()?),
                    Some(linear_density) => {
                        // A cloth without triangles has no mass per area.
                        let density = if mesh.triangles.is_empty() { 0.0 } else { density()? };
                        Self::from_mesh_with_loose_edges(mesh, &read.loose_edges, warp, [density, linear_density])
                    }
                };
                made.and_then(|cloth| match start {
                    Some(start) => cloth.starting_at(start),
                    None => Ok(cloth),
                })
            }
        };
        let mut cloth = made.map_err(|error| table.placed(&error))?;
        cloth.velocity = table.vector(&VELOCITY)?.unwrap_or_default();
        cloth.material = material;
        cloth.file = file;
        cloth.name = table.text("name")?.unwrap_or(NAME).to_owned();
        Ok((cloth, isolated))
    }
}
