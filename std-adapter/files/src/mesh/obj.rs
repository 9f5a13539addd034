//! Wavefront OBJ: lines `v` and `f`, and `l` and `p` on request.
//!
//! A collision pair is reported by the numbers of its vertices, so they must be the file's, and its positions must be exact. No
//! current crate keeps both, so this reader is our own. `tobj` renumbers vertices in the order of their first use and drops the
//! rest. `obj`, `obj-rs` and `wobj` hold 32-bit coordinates. `wavefront_obj` numbers vertices for each object separately and
//! refuses faces that name vertices of another. `wavefront-obj-io` refuses negative indices and needs a newer compiler than we
//! promise. None reports the lines that it skips.

use super::checks::{check_finite, not_a_number};
use super::notes::{FilePart, LeftOut};
use super::options::ReadOptions;
use super::parsed::Parsed;
use super::text::{Lines, fields, integer, number, quoted, trim, without_byte_order_mark};
use crate::problem::FileProblem;
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::io::{self, Write};

pub(super) fn parse(bytes: &[u8], options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    let mut lines = Lines::new(without_byte_order_mark(bytes)?);
    let mut reader = ObjReader::new(*options);
    let mut joined = Vec::new();
    while let Some(line) = lines.next() {
        let (number, mut line) = (lines.number, statement(line));
        if line.ends_with(b"\\") && continues(line) {
            join(line, &mut lines, &mut joined);
            line = &joined;
        }
        reader.line(number, line)?;
    }
    reader.finish()
}

/// Returns a line without its comment and the surrounding white space. A comment ends with its line, even after a backslash.
fn statement(line: &[u8]) -> &[u8] {
    let comment = line.iter().position(|&byte| byte == b'#');
    trim(&line[..comment.unwrap_or(line.len())])
}

/// Returns whether a backslash at the end of a line joins it with the next. A name may end in one: `mtllib C:\textures\`.
fn continues(line: &[u8]) -> bool {
    match fields(line).next() {
        Some(b"mtllib" | b"usemtl" | b"maplib" | b"usemap" | b"o" | b"g" | b"shadow_obj" | b"trace_obj" | b"call" | b"csh") => {
            line.ends_with(b" \\") || line.ends_with(b"\t\\")
        }
        _ => true,
    }
}

/// Joins a line that ends in a backslash with those after it.
fn join(first: &[u8], lines: &mut Lines<'_>, joined: &mut Vec<u8>) {
    joined.clear();
    let mut part = first;
    while let Some(text) = part.strip_suffix(b"\\") {
        joined.extend_from_slice(text);
        joined.push(b' ');
        part = lines.next().map_or(&[], statement);
    }
    joined.extend_from_slice(part);
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

/// Returns the number of the vertex that a corner names. Numbers of texture coordinates and of a normal may follow.
fn corner_name(field: &[u8]) -> Option<i64> {
    let mut parts = field.split(|&byte| byte == b'/');
    let vertex = parts.next().and_then(integer);
    let is_number = |part: &[u8]| part.is_empty() || integer(part).is_some();
    vertex.filter(|_| parts.clone().count() <= 2 && parts.all(is_number))
}

/// Finds a face or a vertex among the words of a line that is not read. The line end before it was lost.
fn hidden_statement<'a>(mut words: impl Iterator<Item = &'a [u8]> + Clone) -> Option<&'a [u8]> {
    while let Some(word) = words.next() {
        let follow = |is: fn(&[u8]) -> bool| {
            let rest = words.clone();
            rest.clone().all(is) && rest.count() >= 3
        };
        let is_statement = match word {
            b"f" | b"fo" => follow(|word| corner_name(word).is_some()),
            b"v" => follow(|word| number(word).is_some()),
            _ => false,
        };
        if is_statement {
            return Some(word);
        }
    }
    None
}

struct ObjReader<'a> {
    options: ReadOptions<'a>,
    parsed: Parsed,
    /// The number of all faces of the file so far, requested or not.
    face: usize,
    corners: Vec<u32>,
    /// References to later vertices: line, owner and number of vertices that must exist, in ascending order of that number.
    forward: Vec<(usize, Owner, i64)>,
    groups: WantedGroups,
}

/// The groups and objects of a file, if only one of them is read.
#[derive(Default)]
struct WantedGroups {
    object_is_wanted: bool,
    group_is_wanted: bool,
    was_found: bool,
    names: Vec<String>,
}

/// The part of a file that names a vertex.
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

impl<'a> ObjReader<'a> {
    fn new(options: ReadOptions<'a>) -> Self {
        Self {
            options,
            parsed: Parsed::default(),
            face: 0,
            corners: Vec::new(),
            forward: Vec::new(),
            groups: WantedGroups::default(),
        }
    }

    fn line(&mut self, line: usize, text: &[u8]) -> Result<(), FileProblem> {
        let mut fields = fields(text);
        let Some(keyword) = fields.next() else {
            return Ok(());
        };
        let is_read = match keyword {
            b"v" | b"f" | b"fo" => true,
            b"l" | b"p" => self.options.loose_features,
            _ => false,
        };
        if !is_read && let Some(word) = hidden_statement(fields.clone()) {
            let reason = format!(
                "the line begins with '{}', but '{}' follows on it; give it a line of its own",
                quoted(keyword, 40),
                quoted(word, 60)
            );
            return Err(FileProblem::Line { line, reason });
        }
        match keyword {
            b"v" => self.vertex(line, fields),
            // The keyword `fo` is an old spelling of `f`.
            b"f" | b"fo" => self.face(line, fields),
            b"l" if self.options.loose_features => self.edges(line, fields),
            b"p" if self.options.loose_features => self.points(line, fields),
            b"o" | b"g" => {
                self.group(keyword, trim(&text[1..]));
                Ok(())
            }
            // These lines are looks, and parts of curves and surfaces that are counted by their own lines.
            b"vn" | b"vt" | b"vp" | b"vc" | b"s" | b"mg" | b"usemtl" | b"mtllib" | b"usemap" | b"maplib" | b"bevel"
            | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" | b"ctech" | b"stech" | b"cstype" | b"deg"
            | b"bmat" | b"step" | b"parm" | b"trim" | b"hole" | b"scrv" | b"sp" | b"end" | b"con" => Ok(()),
            b"l" | b"p" | b"curv" | b"curv2" | b"cdc" => {
                self.leave_out(line, keyword, false);
                Ok(())
            }
            // These are free-form surfaces, other files, and unknown lines.
            _ => {
                self.leave_out(line, keyword, true);
                Ok(())
            }
        }
    }

    fn leave_out(&mut self, line: usize, keyword: &[u8], may_have_area: bool) {
        self.parsed.leave_out(LeftOut::new(
            FilePart::Line,
            quoted(keyword, 40),
            1,
            Some(line),
            may_have_area,
        ));
    }

    /// Reads `g a b …` or `o name`.
    fn group(&mut self, keyword: &[u8], names: &[u8]) {
        let Some(only) = self.options.only else {
            return;
        };
        let is_wanted = names == only.as_bytes() || keyword == b"g" && fields(names).any(|name| name == only.as_bytes());
        if keyword == b"g" {
            self.groups.group_is_wanted = is_wanted;
        } else {
            self.groups.object_is_wanted = is_wanted;
        }
        self.groups.was_found |= is_wanted;
        let name = quoted(names, 40);
        if !self.groups.names.contains(&name) && self.groups.names.len() < 100 {
            self.groups.names.push(name);
        }
    }

    fn is_wanted(&self) -> bool {
        self.options.only.is_none() || self.groups.object_is_wanted || self.groups.group_is_wanted
    }

    /// Reads `v x y z`. A weight or a colour after it is left out.
    fn vertex<'b>(&mut self, line: usize, mut fields: impl Iterator<Item = &'b [u8]>) -> Result<(), FileProblem> {
        let vertex = self.parsed.positions.len();
        let mut coordinates = [0.0; 3];
        for (value, name) in coordinates.iter_mut().zip(['x', 'y', 'z']) {
            let missing = || FileProblem::at_line(line, format!("vertex {vertex} has no {name} coordinate"));
            let field = fields.next().ok_or_else(missing)?;
            *value = number(field).ok_or_else(|| not_a_number(vertex, line, name, field))?;
        }
        // A backslash has joined two lines by mistake.
        let is_word = |field: &&[u8]| number(field).is_none();
        let mut rest = 0;
        if let Some(word) = fields.inspect(|_| rest += 1).find(is_word) {
            let reason = format!(
                "vertex {vertex} has '{}' after its coordinates, which is not a number",
                quoted(word, 40)
            );
            return Err(FileProblem::Line { line, reason });
        }
        // The most are a weight and a colour of four numbers.
        if rest > 5 {
            let reason = format!(
                "vertex {vertex} has {} numbers, but the most are eight; is it one vertex?",
                3 + rest
            );
            return Err(FileProblem::Line { line, reason });
        }
        let position = DVec3::from_array(coordinates);
        check_finite(vertex, position, Some(line))?;
        self.parsed.positions.push(position);
        Ok(())
    }

    /// Reads vertices into `corners`.
    fn corners<'b>(&mut self, line: usize, fields: impl Iterator<Item = &'b [u8]>, owner: Owner) -> Result<(), FileProblem> {
        self.corners.clear();
        for field in fields {
            let corner = self.corner(line, field, owner)?;
            self.corners.push(corner);
        }
        Ok(())
    }

    /// Reads `f a b c …`. `/texture/normal` after a vertex is left out.
    fn face<'b>(&mut self, line: usize, fields: impl Iterator<Item = &'b [u8]>) -> Result<(), FileProblem> {
        self.corners(line, fields, Owner::Face(self.face))?;
        if self.corners.len() < 3 {
            return Err(FileProblem::TooFewCorners {
                line: Some(line),
                face: self.face,
                corners: self.corners.len(),
            });
        }
        if self.is_wanted() {
            self.parsed.faces.push(&self.corners);
        }
        self.face += 1;
        Ok(())
    }

    /// Reads `l a b …`, from vertex to vertex. `/texture` after a vertex is left out.
    fn edges<'b>(&mut self, line: usize, fields: impl Iterator<Item = &'b [u8]>) -> Result<(), FileProblem> {
        self.corners(line, fields, Owner::Edges)?;
        if self.corners.len() < 2 {
            let reason = format!("a line needs two vertices or more, but names {}", self.corners.len());
            return Err(FileProblem::Line { line, reason });
        }
        if self.is_wanted() {
            let edges = self.corners.windows(2).map(|ends| [ends[0], ends[1]]);
            self.parsed.loose_edges.extend(edges);
        }
        Ok(())
    }

    /// Reads `p a …`.
    fn points<'b>(&mut self, line: usize, fields: impl Iterator<Item = &'b [u8]>) -> Result<(), FileProblem> {
        self.corners(line, fields, Owner::Points)?;
        if self.is_wanted() {
            self.parsed.points.extend_from_slice(&self.corners);
        }
        Ok(())
    }

    /// Returns the vertex that a corner names, as in `7`, `7/3` and `7//2`. Numbers count from 1 for the file's first vertex, or
    /// from −1 for the one just above the face.
    fn corner(&mut self, line: usize, field: &[u8], owner: Owner) -> Result<u32, FileProblem> {
        let vertex = corner_name(field).ok_or_else(|| {
            FileProblem::at_line(
                line,
                format!(
                    "{} names a vertex '{}', which is not a whole number",
                    owner.words(),
                    quoted(field, 40)
                ),
            )
        })?;
        let count = self.parsed.positions.len();
        let index = if vertex < 0 { vertex + count as i64 } else { vertex - 1 };
        let Ok(index) = u32::try_from(index) else {
            return Err(self.out_of_range(line, owner, vertex));
        };
        if index as usize >= count && self.forward.last().is_none_or(|&(.., highest)| highest < vertex) {
            self.forward.push((line, owner, vertex));
        }
        Ok(index)
    }

    fn finish(self) -> Result<Parsed, FileProblem> {
        let count = self.parsed.positions.len() as i64;
        if let Some(&(line, owner, vertex)) = self.forward.iter().find(|&&(_, _, vertex)| vertex > count) {
            return Err(self.out_of_range(line, owner, vertex));
        }
        match self.options.only {
            Some(only) if !self.groups.was_found => Err(FileProblem::NoSuchGroup {
                name: only.to_owned(),
                choices: self.groups.names,
            }),
            _ => Ok(self.parsed),
        }
    }

    fn out_of_range(&self, line: usize, owner: Owner, vertex: i64) -> FileProblem {
        let vertex_count = self.parsed.positions.len();
        match owner {
            Owner::Face(face) => FileProblem::IndexOutOfRange {
                line: Some(line),
                face,
                vertex,
                first: 1,
                vertex_count,
            },
            Owner::Edges | Owner::Points => FileProblem::at_line(
                line,
                format!(
                    "{} names vertex {vertex}, but there are {vertex_count} vertices, numbered from 1",
                    owner.words()
                ),
            ),
        }
    }
}
