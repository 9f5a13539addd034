//! The meshes of a glTF file at rest.

use super::options::ReadOptions;
use super::parsed::Parsed;
use crate::animation::{AnimationProblem, Choice, parse as parse_figure};
use crate::problem::FileProblem;
use std::path::Path;

/// Reads all meshes of the scene, or that of the node that `options` name. Other files are looked for beside `path`.
pub(super) fn parse(bytes: &[u8], path: &Path, options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    let choice = Choice {
        node: options.only,
        at_rest: true,
        ..Choice::default()
    };
    let figure = parse_figure(bytes, path, &choice).map_err(|problem| match problem {
        AnimationProblem::File(problem) => problem,
        problem => FileProblem::Figure(Box::new(problem)),
    })?;
    let mut parsed = Parsed {
        positions: figure.mesh().positions.clone(),
        ..Parsed::default()
    };
    figure.mesh().triangles.iter().for_each(|corners| parsed.faces.push(corners));
    figure.left_out().iter().for_each(|part| parsed.leave_out(part.clone()));
    Ok(parsed)
}
