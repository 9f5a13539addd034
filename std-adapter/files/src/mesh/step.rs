//! Two frames of one mesh: a time step from files.

use super::error::{FrameDifference, MeshError};
use super::{MeshNotes, load};
use selvedge::Topology;
use selvedge_core::glam::DVec3;
use std::path::Path;

/// A mesh at the start and at the end of a time step.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshStep {
    /// The topology of both frames.
    pub topology: Topology,
    /// Positions at the start of the step, one for each vertex.
    pub start: Vec<DVec3>,
    /// Positions at the end of the step, one for each vertex.
    pub end: Vec<DVec3>,
    /// What is worth telling the user about the first file.
    pub notes: MeshNotes,
}

/// Reads two frames of one mesh, of any formats: as many vertices, and the same triangles in the
/// same order.
///
/// # Errors
/// Those of [`read`](super::read) for either file; or both files and their first difference.
pub fn read_step(start: &Path, end: &Path) -> Result<MeshStep, MeshError> {
    let (first, topology) = load(start).map_err(|problem| MeshError::file(start, problem))?;
    let (last, _) = load(end).map_err(|problem| MeshError::file(end, problem))?;
    let (vertices, triangles) = (last.mesh.positions.len(), &last.mesh.triangles);
    match FrameDifference::find(&topology, vertices, triangles) {
        Some(difference) => Err(MeshError::Frames {
            start: start.to_owned(),
            end: end.to_owned(),
            difference,
        }),
        None => Ok(MeshStep {
            notes: first.notes(&topology),
            topology,
            start: first.mesh.positions,
            end: last.mesh.positions,
        }),
    }
}
