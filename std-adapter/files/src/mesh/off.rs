//! OFF, the Object File Format of Geomview: text, with or without colours and normals.
//!
//! No maintained crate reads it with 64-bit coordinates.

use super::error::FileProblem;
use super::notes::{FilePart, LeftOut};
use super::parsed::Parsed;
use super::text::{Lines, fields, integer, quoted, trim, without_byte_order_mark};
use super::{ReadOptions, corner, read_vertex};

pub(super) fn parse(bytes: &[u8], options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    if options.only.is_some() {
        return Err(FileProblem::NoGroups);
    }
    let mut content = Content(Lines::new(without_byte_order_mark(bytes)?));
    let [vertex_count, face_count] = read_header(&mut content)?;
    let mut parsed = Parsed::default();
    for vertex in 0..vertex_count {
        let (line, text) = content.next().ok_or_else(|| truncated("vertex", vertex_count, vertex))?;
        parsed.positions.push(read_vertex(vertex, line, fields(text))?);
    }
    let mut corners = Vec::new();
    for face in 0..face_count {
        let (line, text) = content.next().ok_or_else(|| truncated("face", face_count, face))?;
        read_face(face, line, text, vertex_count, &mut corners)?;
        match (corners.as_slice(), options.loose_features) {
            (&[point], true) => parsed.points.push(point),
            (&[from, to], true) => parsed.loose_edges.push([from, to]),
            ([] | [_] | [_, _], _) => parsed.leave_out(LeftOut::new(FilePart::Face, "", 1, Some(line), false)),
            (corners, _) => parsed.faces.push(corners),
        }
    }
    if let Some((line, _)) = content.next() {
        parsed.leave_out(LeftOut::new(
            FilePart::Line,
            "after the last face",
            1 + content.count(),
            Some(line),
            true,
        ));
    }
    Ok(parsed)
}

/// The lines with their numbers, without comments and empty lines.
struct Content<'a>(Lines<'a>);

impl<'a> Iterator for Content<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = self.0.next()?;
            let text = trim(line.split(|&byte| byte == b'#').next().unwrap_or_default());
            if !text.is_empty() {
                return Some((self.0.number, text));
            }
        }
    }
}

/// Reads the kind, and the counts if they follow on the same line, even without a space: `OFF`, `COFF 8 6 12`, `OFF8 6 12`.
/// Returns the numbers of vertices and faces.
fn read_header(content: &mut Content<'_>) -> Result<[usize; 2], FileProblem> {
    let header = |what: &str| FileProblem::Header(what.to_owned());
    let (mut line, mut text) = content
        .next()
        .ok_or_else(|| header("is missing: an OFF file begins with a line 'OFF'"))?;
    let keyword = text.iter().position(|byte| !byte.is_ascii_alphabetic()).unwrap_or(text.len());
    let (kind, counts) = text.split_at(keyword);
    match kind {
        b"" if text[0].is_ascii_digit()
            && text[1..]
                .iter()
                .all(|byte| byte.is_ascii_digit() || super::text::is_space(byte)) => {}
        b"OFF" | b"COFF" | b"NOFF" | b"CNOFF" | b"STOFF" | b"STCOFF" | b"STNOFF" | b"STCNOFF" => {}
        b"nOFF" => {
            return Err(header(
                "is of the kind 'nOFF', whose points may have other than three coordinates; convert it to 'OFF'",
            ));
        }
        _ if text.ends_with(b"OFF") && text.starts_with(b"4") => {
            return Err(header("is of a kind with four coordinates; convert it to 'OFF'"));
        }
        _ => return Err(header("is missing: an OFF file begins with a line 'OFF'")),
    }
    let mut counts = trim(counts);
    if counts.starts_with(b"BINARY") {
        return Err(header(
            "is of the kind 'OFF BINARY', which is not read; convert it to the text form",
        ));
    }
    if counts.is_empty() {
        (line, text) = content
            .next()
            .ok_or_else(|| header("has no line with the numbers of vertices, faces and edges"))?;
        counts = text;
    }
    let numbers: Vec<_> = fields(counts)
        .map(|field| integer(field).and_then(|count| usize::try_from(count).ok()))
        .collect();
    match numbers.as_slice() {
        [Some(vertices), Some(faces)] | [Some(vertices), Some(faces), Some(_)] => {
            // Each element takes a digit and a line end.
            let left = content.0.rest().len() + 1;
            for (element, declared) in [("vertex", *vertices), ("face", *faces)] {
                if declared > left / 2 {
                    return Err(FileProblem::TooShort {
                        element: element.to_owned(),
                        declared,
                        needed: 2 * declared.min(usize::MAX / 2),
                        left,
                    });
                }
            }
            Ok([*vertices, *faces])
        }
        _ => Err(FileProblem::at_line(
            line,
            format!(
                "here must be the numbers of vertices, faces and edges, not '{}'",
                quoted(counts, 60)
            ),
        )),
    }
}

/// Reads `n v₁ … vₙ`. A colour after it is left out.
fn read_face(face: usize, line: usize, text: &[u8], vertex_count: usize, corners: &mut Vec<u32>) -> Result<(), FileProblem> {
    let wrong = |reason: String| FileProblem::Line { line, reason };
    let mut fields = fields(text);
    let count = fields.next().unwrap_or_default();
    let count = integer(count).filter(|&count| count >= 0);
    let count = count.ok_or_else(|| {
        wrong(format!(
            "face {face} must begin with the number of its vertices, not '{}'",
            quoted(text, 40)
        ))
    })?;
    corners.clear();
    for _ in 0..count {
        let Some(field) = fields.next() else {
            return Err(wrong(format!("face {face} has {} of its {count} vertices", corners.len())));
        };
        let vertex = integer(field).ok_or_else(|| {
            wrong(format!(
                "face {face} names a vertex '{}', which is not a whole number",
                quoted(field, 40)
            ))
        })?;
        corners.push(corner(face, vertex, vertex_count, Some(line))?);
    }
    Ok(())
}

fn truncated(element: &str, declared: usize, found: usize) -> FileProblem {
    FileProblem::Truncated {
        element: element.to_owned(),
        declared,
        found,
    }
}
