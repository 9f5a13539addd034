//! Wavefront OBJ: the `v` and `f` lines of it, and `l` and `p` where they are wanted.
//!
//! This reader is our own because a collision pair is reported by the numbers of its vertices, so
//! they must be the file's, and its positions must be exact. No crate keeps both (looked at in
//! their current versions): `tobj` renumbers vertices in the order of their first use and drops
//! the rest; `obj`, `obj-rs` and `wobj` hold 32-bit coordinates; `wavefront_obj` numbers vertices
//! for each object anew and refuses faces that reach into another; `wavefront-obj-io` refuses
//! negative indices and needs a newer compiler than we promise.

use super::error::FileProblem;
use super::{Features, Parsed, check_finite};
use crate::excerpt::excerpt;
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::borrow::Cow;
use std::io::{self, Write};
use std::str::Lines;

pub(super) fn parse(bytes: &[u8], features: Features) -> Result<Parsed, FileProblem> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let valid = &bytes[..error.valid_up_to()];
        FileProblem::NotUtf8 {
            line: 1 + valid.iter().filter(|&&byte| byte == b'\n').count(),
        }
    })?;
    let mut reader = Reader::default();
    for (line, text) in LogicalLines::new(text) {
        let mut fields = text.split('#').next().unwrap_or_default().split_ascii_whitespace();
        match fields.next() {
            Some("v") => reader.vertex(line, fields)?,
            Some("f") => reader.face(line, fields)?,
            Some("l") if features == Features::All => reader.edges(line, fields)?,
            Some("p") if features == Features::All => reader.points(line, fields)?,
            // Normals, texture coordinates, groups, materials, free-form surfaces.
            _ => {}
        }
    }
    reader.finish()
}

pub(super) fn write(out: &mut impl Write, mesh: &Mesh, loose_edges: &[[u32; 2]]) -> io::Result<()> {
    let number = |vertex: u32| u64::from(vertex) + 1;
    // `{:?}` is the shortest decimal that reads back as the same number.
    for p in &mesh.positions {
        writeln!(out, "v {:?} {:?} {:?}", p.x, p.y, p.z)?;
    }
    for &[a, b, c] in &mesh.triangles {
        let [a, b, c] = [a, b, c].map(number);
        writeln!(out, "f {a} {b} {c}")?;
    }
    for &[a, b] in loose_edges {
        writeln!(out, "l {} {}", number(a), number(b))?;
    }
    Ok(())
}

#[derive(Default)]
struct Reader {
    parsed: Parsed,
    faces: usize,
    corners: Vec<u32>,
    /// Line, face and vertex where a face names a vertex that comes later, if it comes at all.
    forward: Vec<(usize, Owner, i64)>,
}

/// What names a vertex.
#[derive(Clone, Copy)]
enum Owner {
    Face(usize),
    Edges,
    Points,
}

impl Owner {
    fn words(self) -> String {
        match self {
            Self::Face(face) => format!("face {face}"),
            Self::Edges => "an edge".to_owned(),
            Self::Points => "a point".to_owned(),
        }
    }
}

impl Reader {
    /// `v x y z`, then perhaps a weight or a colour, which are left out.
    fn vertex<'a>(&mut self, line: usize, mut fields: impl Iterator<Item = &'a str>) -> Result<(), FileProblem> {
        let vertex = self.parsed.mesh.positions.len();
        let mut coordinates = [0.0; 3];
        for (value, name) in coordinates.iter_mut().zip(['x', 'y', 'z']) {
            let wrong = |what: String| FileProblem::Line {
                line,
                reason: format!("vertex {vertex} {what}"),
            };
            let field = fields.next().ok_or_else(|| wrong(format!("has no {name} coordinate")))?;
            *value = field.parse().map_err(|_| {
                wrong(format!(
                    "has the {name} coordinate '{}', which is not a number",
                    quoted(field)
                ))
            })?;
        }
        let position = DVec3::from_array(coordinates);
        check_finite(vertex, position, Some(line))?;
        self.parsed.mesh.positions.push(position);
        Ok(())
    }

    /// `f a b c …`, each corner a vertex, perhaps with `/texture/normal`, which are left out.
    fn face<'a>(&mut self, line: usize, fields: impl Iterator<Item = &'a str>) -> Result<(), FileProblem> {
        self.corners.clear();
        for field in fields {
            let corner = self.corner(line, field, Owner::Face(self.faces))?;
            self.corners.push(corner);
        }
        if self.corners.len() < 3 {
            return Err(FileProblem::TooFewCorners {
                line: Some(line),
                face: self.faces,
                corners: self.corners.len(),
            });
        }
        self.parsed.push_face(&self.corners);
        self.faces += 1;
        Ok(())
    }

    /// `l a b …`, from vertex to vertex, each perhaps with `/texture`, which is left out.
    fn edges<'a>(&mut self, line: usize, fields: impl Iterator<Item = &'a str>) -> Result<(), FileProblem> {
        self.corners.clear();
        for field in fields {
            let vertex = self.corner(line, field, Owner::Edges)?;
            self.corners.push(vertex);
        }
        if self.corners.len() < 2 {
            let reason = format!("a line needs two vertices or more, but names {}", self.corners.len());
            return Err(FileProblem::Line { line, reason });
        }
        let edges = self.corners.windows(2).map(|ends| [ends[0], ends[1]]);
        self.parsed.loose_edges.extend(edges);
        Ok(())
    }

    /// `p a …`.
    fn points<'a>(&mut self, line: usize, fields: impl Iterator<Item = &'a str>) -> Result<(), FileProblem> {
        for field in fields {
            let vertex = self.corner(line, field, Owner::Points)?;
            self.parsed.points.push(vertex);
        }
        Ok(())
    }

    /// The vertex that a corner names: from 1 for the file's first, or from −1 for the one just
    /// above the face.
    fn corner(&mut self, line: usize, field: &str, owner: Owner) -> Result<u32, FileProblem> {
        let name = field.split('/').next().unwrap_or_default();
        let vertex: i64 = name.parse().map_err(|_| FileProblem::Line {
            line,
            reason: format!(
                "{} names a vertex '{}', which is not a whole number",
                owner.words(),
                quoted(field)
            ),
        })?;
        let count = self.parsed.mesh.positions.len();
        let index = if vertex < 0 {
            vertex.checked_add(count as i64)
        } else {
            vertex.checked_sub(1)
        };
        match index.map(u32::try_from) {
            Some(Ok(index)) => {
                if index as usize >= count {
                    self.forward.push((line, owner, vertex));
                }
                Ok(index)
            }
            _ => Err(self.out_of_range(line, owner, vertex)),
        }
    }

    fn finish(self) -> Result<Parsed, FileProblem> {
        let count = self.parsed.mesh.positions.len() as i64;
        match self.forward.iter().find(|&&(_, _, vertex)| vertex > count) {
            Some(&(line, owner, vertex)) => Err(self.out_of_range(line, owner, vertex)),
            None => Ok(self.parsed),
        }
    }

    fn out_of_range(&self, line: usize, owner: Owner, vertex: i64) -> FileProblem {
        let vertex_count = self.parsed.mesh.positions.len();
        match owner {
            Owner::Face(face) => FileProblem::IndexOutOfRange {
                line: Some(line),
                face,
                vertex,
                first: 1,
                vertex_count,
            },
            Owner::Edges | Owner::Points => FileProblem::Line {
                line,
                reason: format!(
                    "{} names vertex {vertex}, but there are {vertex_count} vertices, numbered from 1",
                    owner.words()
                ),
            },
        }
    }
}

/// A field for a message.
fn quoted(field: &str) -> String {
    excerpt(field, 40)
}

/// Lines with their numbers from 1; one that ends in a backslash goes on in the next.
struct LogicalLines<'a> {
    lines: Lines<'a>,
    read: usize,
}

impl<'a> LogicalLines<'a> {
    fn new(text: &'a str) -> Self {
        // Some editors put a byte order mark in front.
        let lines = text.strip_prefix('\u{feff}').unwrap_or(text).lines();
        Self { lines, read: 0 }
    }
}

impl<'a> Iterator for LogicalLines<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.lines.next()?;
        self.read += 1;
        let number = self.read;
        let Some(beginning) = line.strip_suffix('\\').filter(|_| !line.starts_with('#')) else {
            return Some((number, line.into()));
        };
        let mut joined = beginning.to_owned();
        for next in self.lines.by_ref() {
            self.read += 1;
            joined.push(' ');
            match next.strip_suffix('\\') {
                Some(middle) => joined.push_str(middle),
                None => {
                    joined.push_str(next);
                    break;
                }
            }
        }
        Some((number, joined.into()))
    }
}
