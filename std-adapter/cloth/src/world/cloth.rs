//! `[cloth]`: the mesh and its mass.

use super::shapes;
use crate::input::{AREA_DENSITY, LARGEST_COORDINATE, LENGTH, RATIO, SPEED, SceneError, Table, suggestion};
use crate::sleeve::{RefinementError, ring_sizes, sleeve};
use selvedge::{Mesh, Topology};
use selvedge_core::glam::DVec3;

/// The cloth at rest.
#[derive(Clone, Debug)]
pub struct Cloth {
    /// Rest positions, from which the simulation starts.
    pub mesh: Mesh,
    /// Its edges.
    pub topology: Topology,
    /// Mass per area in kg/m².
    pub density: f64,
    /// The direction that the warp takes, as far as it lies in each triangle.
    pub(crate) warp: DVec3,
    /// The velocity that all of it starts with, in m/s.
    pub(crate) velocity: DVec3,
    /// Vertices that a scene can name.
    selections: Vec<(&'static str, Vec<u32>)>,
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
const CELLS: std::ops::RangeInclusive<u64> = 1..=2000;

impl Cloth {
    pub(crate) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let shape = table.required_choice("shape", &SHAPES)?;
        let own: &[&str] = match shape {
            ClothShape::Sleeve => &["refinement"],
            ClothShape::Sheet => &["corner", "sides", "cells"],
            ClothShape::Tube => &["from", "to", "radius", "cells"],
            ClothShape::File => &["file", "warp"],
        };
        table.expect_keys(&[&["shape", "density", "velocity"], own].concat())?;
        let (mesh, warp, selections) = match shape {
            ClothShape::Sleeve => read_sleeve(table)?,
            ClothShape::Sheet => read_sheet(table)?,
            ClothShape::Tube => read_tube(table)?,
            ClothShape::File => {
                let warp = table.vector("warp", RATIO, LARGEST_COORDINATE)?.unwrap_or(DVec3::X);
                (shapes::of_file(table)?, warp, Vec::new())
            }
        };
        let topology = mesh.topology().map_err(|error| table.error("shape", error.to_string()))?;
        let statistics = topology.statistics();
        if statistics.degenerate_triangles > 0 || statistics.isolated_vertices > 0 {
            let message = format!("cloth must consist of proper triangles, but the mesh has {statistics}");
            return Err(table.error("file", message));
        }
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        if let Some(flat) = mesh.triangles.iter().position(|t| area(t) < SMALLEST_AREA) {
            let message =
                format!("triangle {flat} of the cloth has an area below {SMALLEST_AREA:e} square metres; are the units metres?");
            return Err(table.error("shape", message));
        }
        Ok(Self {
            density: table.required_number("density", AREA_DENSITY, 1e-3..=100.0)?,
            velocity: table.vector("velocity", SPEED, 1e3)?.unwrap_or_default(),
            mesh,
            topology,
            warp,
            selections,
        })
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
            selections: Vec::new(),
        }
    }

    /// The vertices that `name` stands for. What is wrong, if it stands for none.
    pub(crate) fn selection(&self, name: &str) -> Result<&[u32], String> {
        match self.selections.iter().find(|(known, _)| *known == name) {
            Some((_, vertices)) => Ok(vertices),
            None => {
                let names = self.selections.iter().map(|(known, _)| *known);
                Err(format!("this cloth has no part '{name}'{}", suggestion(name, names)))
            }
        }
    }
}

/// Edges of a hundredth of a millimetre.
const SMALLEST_AREA: f64 = 1e-10;

type MeshWarpAndParts = (Mesh, DVec3, Vec<(&'static str, Vec<u32>)>);

fn read_sleeve(table: &Table<'_>) -> Result<MeshWarpAndParts, SceneError> {
    let refinement = table.count("refinement", 1..=1000)?.unwrap_or(1) as u32;
    let complain = |error: RefinementError| table.error("refinement", error.to_string());
    let mesh = sleeve(refinement).map_err(complain)?;
    let sizes = ring_sizes(refinement).map_err(complain)?;
    let count = mesh.positions.len() as u32;
    let [first, last] = [sizes[0], sizes[sizes.len() - 1]];
    let selections = vec![("shoulder", (0..first).collect()), ("cuff", (count - last..count).collect())];
    Ok((mesh, DVec3::X, selections))
}

fn read_sheet(table: &Table<'_>) -> Result<MeshWarpAndParts, SceneError> {
    let sides = table.required_table("sides")?;
    sides.expect_keys(&["first", "second"])?;
    let sides = [
        sides.required_vector("first", LENGTH, LARGEST_COORDINATE)?,
        sides.required_vector("second", LENGTH, LARGEST_COORDINATE)?,
    ];
    if sides[0].cross(sides[1]).length() < 0.1 * sides[0].length() * sides[1].length() || sides[0] == DVec3::ZERO {
        let message = "the two sides of the sheet must not be parallel or zero".to_owned();
        return Err(table.error("sides", message));
    }
    let corner = table.vector("corner", LENGTH, LARGEST_COORDINATE)?.unwrap_or_default();
    let cells = table.two_counts("cells", CELLS)?.map(|n| n as u32);
    let [columns, rows] = cells;
    let at = |column: u32, row: u32| row * (columns + 1) + column;
    let selections = vec![
        ("left", (0..=rows).map(|row| at(0, row)).collect()),
        ("right", (0..=rows).map(|row| at(columns, row)).collect()),
        ("bottom", (0..=columns).map(|column| at(column, 0)).collect()),
        ("top", (0..=columns).map(|column| at(column, rows)).collect()),
        ("bottom-left", vec![at(0, 0)]),
        ("bottom-right", vec![at(columns, 0)]),
        ("top-left", vec![at(0, rows)]),
        ("top-right", vec![at(columns, rows)]),
    ];
    Ok((shapes::sheet(corner, sides, cells), sides[0], selections))
}

fn read_tube(table: &Table<'_>) -> Result<MeshWarpAndParts, SceneError> {
    let ends = [
        table.required_vector("from", LENGTH, LARGEST_COORDINATE)?,
        table.required_vector("to", LENGTH, LARGEST_COORDINATE)?,
    ];
    if ends[0] == ends[1] {
        return Err(table.error("to", "`from` and `to` are the same point".to_owned()));
    }
    let radius = table.required_number("radius", LENGTH, 1e-3..=LARGEST_COORDINATE)?;
    let cells = table.two_counts("cells", 3..=2000)?.map(|n| n as u32);
    let mesh = shapes::tube(ends, radius, cells);
    let count = mesh.positions.len() as u32;
    let selections = vec![
        ("start", (0..cells[0]).collect()),
        ("end", (count - cells[0]..count).collect()),
    ];
    Ok((mesh, ends[1] - ends[0], selections))
}
