//! Checks of numbers and vertices that all parsers share.

use super::text::{number, quoted};
use crate::problem::FileProblem;
use selvedge_core::glam::DVec3;

/// Returns a number as that of a vertex, if there is such a vertex.
pub(super) fn vertex_index(vertex: i64, vertex_count: usize) -> Option<u32> {
    u32::try_from(vertex).ok().filter(|&index| (index as usize) < vertex_count)
}

/// Returns the vertex that a face names by its number from 0 on.
pub(super) fn corner(face: usize, vertex: i64, vertex_count: usize, line: Option<usize>) -> Result<u32, FileProblem> {
    vertex_index(vertex, vertex_count).ok_or(FileProblem::IndexOutOfRange {
        line,
        face,
        vertex,
        first: 0,
        vertex_count,
    })
}

/// Reads the three coordinates of a vertex. `next` returns a word and its line.
pub(super) fn read_vertex<'a>(vertex: usize, mut next: impl FnMut() -> (Option<&'a [u8]>, usize)) -> Result<DVec3, FileProblem> {
    let (mut coordinates, mut line) = ([0.0; 3], 0);
    for (value, name) in coordinates.iter_mut().zip(['x', 'y', 'z']) {
        let word;
        (word, line) = next();
        let word = word.unwrap_or_default();
        *value = number(word).ok_or_else(|| not_a_number(vertex, line, name, word))?;
    }
    let position = DVec3::from_array(coordinates);
    check_finite(vertex, position, Some(line))?;
    Ok(position)
}

pub(super) fn not_a_number(vertex: usize, line: usize, coordinate: impl std::fmt::Display, field: &[u8]) -> FileProblem {
    let field = quoted(field, 40);
    let reason = format!("vertex {vertex} has the {coordinate} coordinate '{field}', which is not a number");
    FileProblem::Line { line, reason }
}

pub(crate) fn check_finite(vertex: usize, position: DVec3, line: Option<usize>) -> Result<(), FileProblem> {
    for (coordinate, value) in ['x', 'y', 'z'].into_iter().zip(position.to_array()) {
        if !value.is_finite() {
            return Err(FileProblem::NonFinite {
                line,
                vertex,
                coordinate,
                value,
            });
        }
    }
    Ok(())
}
