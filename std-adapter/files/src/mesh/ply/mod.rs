//! PLY in its three encodings, with faces, triangle strips, and loose edges on request.
//!
//! This reader is our own. The best maintained crate, `ply-rs-bw`, rejects text that C writes and reads (`.5`, `1e5`, `nan` in an
//! unused property, lines that end in CR). It makes a table of names and values for each element, which takes twenty times as
//! long. It does not check that a header's counts fit the file. `plyfile`-style crates read 32-bit coordinates, or no lists of
//! unknown properties.

mod body;
mod header;
mod write;

pub(super) use write::write;

use super::checks::{check_finite, corner, vertex_index};
use super::notes::{FilePart, LeftOut};
use super::options::ReadOptions;
use super::parsed::Parsed;
use crate::problem::FileProblem;
use body::{Body, Row};
use header::{Element, Header, Kind, Role};
use selvedge_core::glam::DVec3;

const COORDINATES: [&str; 3] = ["x", "y", "z"];
/// The names of the list of a face's vertices; both are in use.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];
/// The names of the two vertices of an edge.
const ENDS: [&str; 2] = ["vertex1", "vertex2"];

pub(super) fn parse(bytes: &[u8], options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    if options.only.is_some() {
        return Err(FileProblem::NoGroups);
    }
    let (header, encoding, lines) = header::read(bytes)?;
    let mut body = Body::new(encoding, lines, bytes);
    let vertex_count = header.vertex_count(options)?;
    let mut reader = PlyReader {
        vertex_count,
        parsed: Parsed::default(),
        face: 0,
        corners: Vec::new(),
    };
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => {
                // The header may declare at most as many elements as the file has room for.
                body.check_room(element)?;
                reader.parsed.positions.reserve_exact(element.count);
                body.read(element, |index, row, line| reader.vertex(index, row, line))?;
            }
            "face" => body.read(element, |_, row, line| reader.face(row, line))?,
            "tristrips" => body.read(element, |index, row, line| reader.strip(index, row, line))?,
            "edge" if options.loose_features => body.read(element, |index, row, line| reader.edge(index, row, line))?,
            _ => {
                body.read(element, |_, _, _| Ok(()))?;
                reader.leave_out(element);
            }
        }
    }
    let mut parsed = reader.parsed;
    body.finish(&mut parsed);
    if options.loose_features && parsed.faces.len() == 0 && parsed.loose_edges.is_empty() && header.has_no_faces() {
        // There are as many points as vertices, which were read.
        parsed.points = (0..vertex_count as u32).collect();
    }
    Ok(parsed)
}

struct PlyReader {
    vertex_count: usize,
    parsed: Parsed,
    face: usize,
    corners: Vec<u32>,
}

impl PlyReader {
    fn vertex(&mut self, vertex: usize, row: &Row, line: Option<usize>) -> Result<(), FileProblem> {
        let position = DVec3::from_array(row.coordinates);
        check_finite(vertex, position, line)?;
        self.parsed.positions.push(position);
        Ok(())
    }

    fn is_vertex(&self, vertex: i64) -> Option<u32> {
        vertex_index(vertex, self.vertex_count)
    }

    fn push(&mut self, corners: &[i64], line: Option<usize>) -> Result<(), FileProblem> {
        let face = self.face;
        self.corners.clear();
        for &vertex in corners {
            self.corners.push(corner(face, vertex, self.vertex_count, line)?);
        }
        if self.corners.len() < 3 {
            return Err(FileProblem::TooFewCorners {
                line,
                face,
                corners: self.corners.len(),
            });
        }
        self.parsed.faces.push(&self.corners);
        self.face += 1;
        Ok(())
    }

    fn face(&mut self, row: &Row, line: Option<usize>) -> Result<(), FileProblem> {
        self.push(&row.corners, line)
    }

    /// Adds triangle strips, one after the other, with −1 between them. Every other triangle is reversed; those that name a
    /// vertex twice only join two parts.
    fn strip(&mut self, index: usize, row: &Row, line: Option<usize>) -> Result<(), FileProblem> {
        let is_restart = |&vertex: &i64| vertex == -1 || vertex == i64::from(u32::MAX);
        for strip in row.corners.split(is_restart).filter(|strip| !strip.is_empty()) {
            if strip.len() < 3 {
                let reason = format!("has a strip of {} vertices, but needs three or more", strip.len());
                return Err(element_problem("tristrips", index, line, reason));
            }
            for (k, corners) in strip.windows(3).enumerate() {
                let &[a, b, c] = corners else { continue };
                if a == b || b == c || c == a {
                    // The vertices must exist all the same.
                    if let Some(&vertex) = corners.iter().find(|&&vertex| self.is_vertex(vertex).is_none()) {
                        let count = self.vertex_count;
                        let reason = format!("names vertex {vertex}, but there are {count} vertices, numbered from 0");
                        return Err(element_problem("tristrips", index, line, reason));
                    }
                    continue;
                }
                self.push(&if k % 2 == 0 { [a, b, c] } else { [b, a, c] }, line)?;
            }
        }
        Ok(())
    }

    fn edge(&mut self, edge: usize, row: &Row, line: Option<usize>) -> Result<(), FileProblem> {
        match row.ends.map(|end| self.is_vertex(end)) {
            [Some(from), Some(to)] => {
                self.parsed.loose_edges.push([from, to]);
                Ok(())
            }
            [first, _] => {
                let vertex = row.ends[usize::from(first.is_some())];
                let count = self.vertex_count;
                let reason = format!("names vertex {vertex}, but there are {count} vertices, numbered from 0");
                Err(element_problem("edge", edge, line, reason))
            }
        }
    }

    /// Leaves out an element. Its lists of whole numbers may name the corners of faces.
    fn leave_out(&mut self, element: &Element) {
        if element.count > 0 {
            let has_list = element.properties.iter().any(|property| match property.kind {
                Kind::List(_, number) => !number.is_float(),
                Kind::Scalar(_) => false,
            });
            self.parsed.leave_out(LeftOut::new(
                FilePart::Element,
                element.name.clone(),
                element.count,
                None,
                has_list,
            ));
        }
    }
}

fn element_problem(element: &str, index: usize, line: Option<usize>, reason: String) -> FileProblem {
    match line {
        Some(line) => FileProblem::at_line(line, format!("'{element}' element {index} {reason}")),
        None => FileProblem::Element {
            element: element.to_owned(),
            index,
            reason,
        },
    }
}

impl Header {
    fn has_no_faces(&self) -> bool {
        let is_empty = |name: &str| self.element(name).is_none_or(|element| element.count == 0);
        is_empty("face") && is_empty("tristrips")
    }

    /// Returns the number of vertices. Refuses a header without the required vertices, faces or edges.
    fn vertex_count(&self, options: &ReadOptions<'_>) -> Result<usize, FileProblem> {
        let missing = |what: String| FileProblem::Header(format!("declares no {what}"));
        let vertex = self.element("vertex").ok_or_else(|| missing("element 'vertex'".to_owned()))?;
        for (axis, name) in COORDINATES.into_iter().enumerate() {
            if !vertex.has(Role::Coordinate(axis)) {
                return Err(missing(format!("number '{name}' for the element 'vertex'")));
            }
        }
        if let Some(edge) = self.element("edge").filter(|_| options.loose_features) {
            for (end, name) in ENDS.into_iter().enumerate() {
                if !edge.has(Role::End(end)) {
                    return Err(missing(format!("integer '{name}' for the element 'edge'")));
                }
            }
        }
        let of_corners = ["face", "tristrips"].map(|name| self.element(name));
        if of_corners == [None, None] && !options.loose_features {
            return Err(missing("element 'face', so there are no triangles".to_owned()));
        }
        for element in of_corners.into_iter().flatten() {
            if !element.has(Role::Corners) {
                return Err(missing(format!(
                    "list of integers 'vertex_indices' or 'vertex_index' for the element '{}'",
                    element.name
                )));
            }
        }
        Ok(vertex.count)
    }
}
