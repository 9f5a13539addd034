//! Two frames of one mesh: a time step from files.

use super::error::MeshError;
use super::frame_difference::FrameDifference;
use super::options::ReadOptions;
use super::{MeshNotes, load};
use crate::FileSource;
use selvedge::{Topology, TopologyError};
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
    /// A report about the first file, with the parts of the second that may have an area and were left out.
    pub notes: MeshNotes,
}

/// Reads two frames of one mesh, of any formats. They must have as many vertices, and the same faces in the same order. Polygons
/// are split by their shape at the start.
///
/// # Errors
/// Returns the errors of [`read`](super::read) for either file, or an error with both files and their first difference.
pub fn read_step(start: &Path, end: &Path) -> Result<MeshStep, MeshError> {
    let read = |path: &Path| match load(&FileSource::Disk, path, &ReadOptions::default()) {
        Ok(frame) if frame.faces.len() == 0 => {
            let problem = frame.check_content().err().unwrap_or(TopologyError::NoTriangles.into());
            Err(MeshError::file(path, problem))
        }
        Ok(frame) => Ok(frame),
        Err(problem) => Err(MeshError::file(path, problem)),
    };
    let (mut first, mut last) = (read(start)?, read(end)?);
    if let Some(difference) = FrameDifference::find(&first, &last) {
        return Err(MeshError::Frames {
            start: start.to_owned(),
            end: end.to_owned(),
            difference,
        });
    }
    let mut split = first.triangles();
    let triangles = std::mem::take(&mut split.triangles);
    let topology = Topology::new(first.positions.len(), triangles).map_err(|error| MeshError::file(start, error.into()))?;
    let mut notes = first.notes(&mut split, &topology);
    let of_last = last.notes(&mut split, &topology).left_out;
    notes.left_out.extend(of_last.into_iter().filter(|part| part.may_have_area));
    Ok(MeshStep {
        topology,
        start: first.positions,
        end: last.positions,
        notes,
    })
}
