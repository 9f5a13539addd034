//! Mesh files, and merged vertices.

use crate::answers::{class, rows};
use crate::arrays::{Frames, indices, with_frames};
use crate::errors::{InputError, of_topology};
use pyo3::prelude::*;
use selvedge::{Mesh, Topology};
use selvedge_cloth::files::mesh::{self, LooseMesh, ReadOptions};
use selvedge_cloth::glam::DVec3;
use std::path::PathBuf;

fn check_distance(name: &str, distance: f64) -> PyResult<f64> {
    match distance {
        _ if (0.0..f64::INFINITY).contains(&distance) => Ok(distance),
        _ => Err(InputError::new_err(format!(
            "{name} is {distance}, but must be a distance, 0 or more"
        ))),
    }
}

#[doc = crate::stub!("read_mesh")]
#[pyfunction]
#[pyo3(signature = (path, *, only=None, weld=None))]
pub(crate) fn read_mesh<'py>(
    py: Python<'py>,
    path: PathBuf,
    only: Option<&str>,
    weld: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let options = ReadOptions {
        loose_features: true,
        only,
        weld: weld.map(|distance| check_distance("weld", distance)).transpose()?,
    };
    let read = py.detach(|| mesh::read_with(&path, &options));
    let LooseMesh {
        positions,
        topology,
        notes,
    } = read.map_err(|error| InputError::new_err(error.to_string()))?;
    class(py, "MeshFile")?.call1((
        rows(py, positions.iter().map(DVec3::to_array).collect())?,
        rows(py, topology.proper_triangles().to_vec())?,
        rows(py, topology.loose_edges().collect())?,
        topology.points().collect::<Vec<u32>>(),
        notes.missing(),
        notes.to_string(),
    ))
}

#[doc = crate::stub!("welded")]
#[pyfunction]
#[pyo3(signature = (positions, faces, tolerance=0.0))]
pub(crate) fn welded<'py>(
    py: Python<'py>,
    positions: &Bound<'py, PyAny>,
    faces: &Bound<'py, PyAny>,
    tolerance: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let tolerance = check_distance("tolerance", tolerance)?;
    let triangles: Vec<[u32; 3]> = indices(faces, "faces")?;
    let positions: Vec<DVec3> = with_frames!(Frames::of([("positions", positions)])?, [positions] => {
        positions.rows()?.iter().map(|row| DVec3::from(row.map(f64::from))).collect()
    });
    let welded = py.detach(|| {
        // Names the first triangle with a vertex that does not exist.
        Topology::new(positions.len(), triangles.clone())?;
        Ok(Mesh { positions, triangles }.welded(tolerance))
    });
    let welded = welded.map_err(of_topology)?;
    class(py, "Welded")?.call1((
        rows(py, welded.mesh.positions.iter().map(DVec3::to_array).collect())?,
        rows(py, welded.mesh.triangles)?,
        numpy::PyArray1::from_vec(py, welded.vertex_of),
    ))
}
