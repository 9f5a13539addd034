//! `[cloth]`: the mesh and its mass.

use super::shapes;
use crate::input::{
    AREA_DENSITY, Count, Field, LARGEST_COORDINATE, LENGTH, RATIO, SPEED, SceneError, Table, ValueError, suggestion,
};
use crate::sleeve::{RefinementError, ring_sizes, sleeve};
use selvedge::{Mesh, Topology};
use selvedge_core::glam::DVec3;

/// The cloth at rest.
#[derive(Clone, Debug)]
pub struct Cloth {
    pub(crate) mesh: Mesh,
    pub(crate) topology: Topology,
    /// Mass per area in kg/m².
    pub density: f64,
    /// The direction that the warp takes, as far as it lies in each triangle.
    pub(crate) warp: DVec3,
    /// The velocity that all of it starts with, in m/s.
    pub velocity: DVec3,
    /// Vertices that have a name.
    parts: Vec<(&'static str, Vec<u32>)>,
}

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
const CELLS: Count = Count::new("cells", 1, 2000);
const CELLS_AROUND: Count = Count::new("cells", 3, 2000);
const REFINEMENT: Count = Count::new("refinement", 1, 1000);
const CORNER: Field = Field::vector("corner", LENGTH, LARGEST_COORDINATE);
const FIRST: Field = Field::vector("first", LENGTH, LARGEST_COORDINATE);
const SECOND: Field = Field::vector("second", LENGTH, LARGEST_COORDINATE);
const FROM: Field = Field::vector("from", LENGTH, LARGEST_COORDINATE);
const TO: Field = Field::vector("to", LENGTH, LARGEST_COORDINATE);
const RADIUS: Field = Field::new("radius", LENGTH, 1e-3, LARGEST_COORDINATE);
const WARP: Field = Field::vector("warp", RATIO, LARGEST_COORDINATE);
const DENSITY: Field = Field::new("density", AREA_DENSITY, 1e-3, 100.0);
const VELOCITY: Field = Field::vector("velocity", SPEED, 1e3);

impl Cloth {
    /// A parallelogram with a corner and two sides, in metres, in `cells` along each; `density` in kg/m². Its warp goes along the first
    /// side. Vertices go row by row along the first side.
    ///
    /// Parts: `left`, `right`, `bottom`, `top`, and the corners, such as `bottom-left`.
    ///
    /// # Errors
    /// If a number is beyond its range, or the sides are parallel.
    pub fn sheet(corner: DVec3, sides: [DVec3; 2], cells: [u32; 2], density: f64) -> Result<Self, ValueError> {
        CORNER.check_vector(corner)?;
        FIRST.check_vector(sides[0])?;
        SECOND.check_vector(sides[1])?;
        cells.into_iter().try_for_each(|count| CELLS.check(count))?;
        if sides[0].cross(sides[1]).length() < 0.1 * sides[0].length() * sides[1].length() || sides[0] == DVec3::ZERO {
            return Err(ValueError::new(
                "sides",
                "the two sides of the sheet must not be parallel or zero",
            ));
        }
        let [columns, rows] = cells;
        let at = |column: u32, row: u32| row * (columns + 1) + column;
        let parts = vec![
            ("left", (0..=rows).map(|row| at(0, row)).collect()),
            ("right", (0..=rows).map(|row| at(columns, row)).collect()),
            ("bottom", (0..=columns).map(|column| at(column, 0)).collect()),
            ("top", (0..=columns).map(|column| at(column, rows)).collect()),
            ("bottom-left", vec![at(0, 0)]),
            ("bottom-right", vec![at(columns, 0)]),
            ("top-left", vec![at(0, rows)]),
            ("top-right", vec![at(columns, rows)]),
        ];
        Self::with_parts(shapes::sheet(corner, sides, cells), sides[0], density, parts)
    }

    /// An open tube from one point to another, in metres, with `cells` around and along it; `density` in kg/m². Its warp goes along.
    ///
    /// Parts: `start`, `end`.
    ///
    /// # Errors
    /// If a number is beyond its range, or the two points are the same.
    pub fn tube([from, to]: [DVec3; 2], radius: f64, cells: [u32; 2], density: f64) -> Result<Self, ValueError> {
        FROM.check_vector(from)?;
        TO.check_vector(to)?;
        if from == to {
            return Err(ValueError::new(TO.name, "`from` and `to` are the same point"));
        }
        RADIUS.check(radius)?;
        cells.into_iter().try_for_each(|count| CELLS_AROUND.check(count))?;
        let mesh = shapes::tube([from, to], radius, cells);
        let count = mesh.positions.len() as u32;
        let parts = vec![
            ("start", (0..cells[0]).collect()),
            ("end", (count - cells[0]..count).collect()),
        ];
        Self::with_parts(mesh, to - from, density, parts)
    }

    /// The paper's [`sleeve`]; `density` in kg/m². Its warp goes along x.
    ///
    /// Parts: `shoulder`, `cuff`.
    ///
    /// # Errors
    /// If a number is beyond its range.
    pub fn sleeve(refinement: u32, density: f64) -> Result<Self, ValueError> {
        REFINEMENT.check(refinement)?;
        let complain = |error: RefinementError| ValueError::new(REFINEMENT.name, error.to_string());
        let mesh = sleeve(refinement).map_err(complain)?;
        let sizes = ring_sizes(refinement).map_err(complain)?;
        let count = mesh.positions.len() as u32;
        let [first, last] = [sizes[0], sizes[sizes.len() - 1]];
        let parts = vec![("shoulder", (0..first).collect()), ("cuff", (count - last..count).collect())];
        Self::with_parts(mesh, DVec3::X, density, parts)
    }

    /// Any mesh of proper triangles, in metres, as it is at rest; `warp` is the direction of the warp, as far as it lies in each
    /// triangle, `density` in kg/m².
    ///
    /// # Errors
    /// If a number is beyond its range, or the mesh has vertices without triangles, triangles without area, or none at all.
    pub fn of_mesh(mesh: Mesh, warp: DVec3, density: f64) -> Result<Self, ValueError> {
        Self::with_parts(mesh, warp, density, Vec::new())
    }

    fn with_parts(mesh: Mesh, warp: DVec3, density: f64, parts: Vec<(&'static str, Vec<u32>)>) -> Result<Self, ValueError> {
        DENSITY.check(density)?;
        WARP.check_vector(warp)?;
        shapes::check(&mesh)?;
        let topology = mesh.topology();
        let topology = topology.map_err(|error| ValueError::new("shape", error.to_string()))?;
        let statistics = topology.statistics();
        if statistics.degenerate_triangles > 0 || statistics.isolated_vertices > 0 {
            let message = format!("cloth must consist of proper triangles, but the mesh has {statistics}");
            return Err(ValueError::new("file", message));
        }
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        if let Some(flat) = mesh.triangles.iter().position(|t| area(t) < SMALLEST_AREA) {
            let message =
                format!("triangle {flat} of the cloth has an area below {SMALLEST_AREA:e} square metres; are the units metres?");
            return Err(ValueError::new("shape", message));
        }
        Ok(Self {
            density,
            velocity: DVec3::ZERO,
            mesh,
            topology,
            warp,
            parts,
        })
    }

    /// What may have been changed since it was made.
    pub(crate) fn check(&self) -> Result<(), ValueError> {
        let checked = DENSITY.check(self.density).and(VELOCITY.check_vector(self.velocity));
        checked.map_err(|error| error.of("cloth"))
    }

    pub(crate) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let shape = table.required_choice("shape", &SHAPES)?;
        let own: &[&str] = match shape {
            ClothShape::Sleeve => &["refinement"],
            ClothShape::Sheet => &["corner", "sides", "cells"],
            ClothShape::Tube => &["from", "to", "radius", "cells"],
            ClothShape::File => &["file", "warp"],
        };
        table.expect_keys(&[&["shape", "density", "velocity"], own].concat())?;
        let density = || table.required_number(&DENSITY);
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
        Ok(cloth)
    }

    /// At rest, from which the simulation starts.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Its edges.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The vertices of a part that has a name; `None` if there is no such part.
    #[must_use]
    pub fn part(&self, name: &str) -> Option<&[u32]> {
        let part = self.parts.iter().find(|(known, _)| *known == name);
        part.map(|(_, vertices)| vertices.as_slice())
    }

    /// Of this mesh, 100 g/m², its warp along x.
    #[cfg(test)]
    pub(crate) fn of(mesh: Mesh) -> Self {
        Self {
            topology: mesh.topology().unwrap(),
            mesh,
            density: 0.1,
            warp: DVec3::X,
            velocity: DVec3::ZERO,
            parts: Vec::new(),
        }
    }

    /// The vertices of a part, or what is wrong with its name.
    pub(crate) fn named_part(&self, name: &str) -> Result<&[u32], String> {
        self.part(name).ok_or_else(|| {
            let names = self.parts.iter().map(|(known, _)| *known);
            format!("this cloth has no part '{name}'{}", suggestion(name, names))
        })
    }
}

/// Edges of a hundredth of a millimetre.
const SMALLEST_AREA: f64 = 1e-10;
