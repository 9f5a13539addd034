//! OFF, the Object File Format of Geomview: text, with or without colours and normals.
//!
//! No maintained crate reads it with 64-bit coordinates.
//!
//! In most files each vertex and each face has a line of its own, with a colour or a normal behind it. In Geomview's own format,
//! line ends separate numbers as other white space does, and only a colour ends with its line. So the reader tries several forms
//! one after the other, and takes the first that reads the file to its end. If there is none, the result is that of the first
//! form.

use super::checks::{corner, read_vertex};
use super::notes::{FilePart, LeftOut};
use super::options::ReadOptions;
use super::parsed::Parsed;
use super::text::{Words, fields, integer, number, quoted, without_byte_order_mark};
use crate::problem::FileProblem;

pub(super) fn parse(bytes: &[u8], options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    if options.only.is_some() {
        return Err(FileProblem::NoGroups);
    }
    let mut words = Words::new(without_byte_order_mark(bytes)?, true);
    let width = read_kind(&mut words)?;
    let read = |form: &Form| {
        let mut words = words.clone();
        let [vertex_count, face_count] = read_counts(&mut words, form)?;
        let mut elements = Elements {
            words,
            parsed: Parsed::default(),
            vertex_count,
            corners: Vec::new(),
            has_colours: false,
        };
        elements.vertices(form, width)?;
        elements.faces(form, face_count, options)?;
        elements.finish();
        Ok(elements.parsed)
    };
    let is_plain: fn(&Parsed) -> bool = |parsed| parsed.left_out.is_empty();
    let is_whole: fn(&Parsed) -> bool = |parsed| parsed.left_out.iter().all(|part| !part.may_have_area);
    // A number in the wrong place may be taken for a face of fewer than three corners, which is left out.
    let plain = read(&FORMS[0]);
    for is_good in [is_plain, is_whole] {
        if plain.as_ref().is_ok_and(is_good) {
            break;
        }
        if let Some(other) = FORMS[1..].iter().filter_map(|form| read(form).ok()).find(is_good) {
            return Ok(other);
        }
    }
    plain
}

/// A way to divide the words of a file into numbers, vertices and faces.
struct Form {
    /// The number of edges may be missing. Then the counts end with their line.
    may_lack_edges: bool,
    /// Each vertex has a line of its own, and anything may follow its coordinates.
    has_vertex_lines: bool,
    /// Each face ends with its line, and a colour may follow its vertices.
    has_face_lines: bool,
}

const FORMS: [Form; 8] = {
    const fn form([may_lack_edges, has_vertex_lines, has_face_lines]: [bool; 3]) -> Form {
        Form {
            may_lack_edges,
            has_vertex_lines,
            has_face_lines,
        }
    }
    [
        form([true, true, true]),
        form([true, false, true]),
        form([true, true, false]),
        form([true, false, false]),
        form([false, true, true]),
        form([false, false, true]),
        form([false, true, false]),
        form([false, false, false]),
    ]
};

/// Reads the kind, which may be missing: `OFF`, `COFF`. Counts may follow without a space: `OFF8 6 12`. Returns how many numbers
/// a vertex has in Geomview's format.
fn read_kind(words: &mut Words<'_>) -> Result<usize, FileProblem> {
    let header = |what: &str| Err(FileProblem::Header(what.to_owned()));
    let kind = words.next_letters().unwrap_or_default();
    let mut ahead = words.clone();
    let next = ahead.next().unwrap_or_default();
    let width = match kind {
        b"" if !next.is_empty() && next.iter().all(u8::is_ascii_digit) => 3,
        b"OFF" => 3,
        b"NOFF" => 6,
        b"COFF" => 7,
        b"CNOFF" => 10,
        b"STOFF" => 5,
        b"STNOFF" => 8,
        b"STCOFF" => 9,
        b"STCNOFF" => 12,
        b"nOFF" => {
            return header("is of the kind 'nOFF', whose points may have other than three coordinates; convert it to 'OFF'");
        }
        b"" if next.starts_with(b"4") && next.ends_with(b"OFF") => {
            return header("is of a kind with four coordinates; convert it to 'OFF'");
        }
        _ => return header("is missing: an OFF file begins with a line 'OFF'"),
    };
    if next == b"BINARY" {
        return header("is of the kind 'OFF BINARY', which is not read; convert it to the text form");
    }
    Ok(width)
}

/// Reads the numbers of vertices, faces and edges. Returns the first two.
fn read_counts(words: &mut Words<'_>, form: &Form) -> Result<[usize; 2], FileProblem> {
    let mut text = words.clone();
    let first = text.next();
    let line = text.number();
    let text = [first.unwrap_or_default(), text.rest_of_line()].join(&b' ');
    if first.is_none() {
        let reason = "has no line with the numbers of vertices, faces and edges";
        return Err(FileProblem::Header(reason.to_owned()));
    }
    let lacks_edges = form.may_lack_edges && fields(&text).count() == 2;
    let mut counts = [0; 3];
    for count in &mut counts[..if lacks_edges { 2 } else { 3 }] {
        let read = words.next().and_then(integer).and_then(|count| usize::try_from(count).ok());
        *count = read.ok_or_else(|| {
            let reason = format!(
                "here must be the numbers of vertices, faces and edges, not '{}'",
                quoted(&text, 60)
            );
            FileProblem::at_line(line, reason)
        })?;
    }
    let [vertices, faces, _] = counts;
    // Each element takes a digit and the white space after it.
    let left = words.bytes_left() + 1;
    for (element, declared) in [("vertex", vertices), ("face", faces)] {
        if declared > left / 2 {
            return Err(FileProblem::TooShort {
                element: element.to_owned(),
                declared,
                needed: 2 * declared.min(usize::MAX / 2),
                left,
            });
        }
    }
    Ok([vertices, faces])
}

struct Elements<'a> {
    words: Words<'a>,
    parsed: Parsed,
    vertex_count: usize,
    corners: Vec<u32>,
    /// A face has numbers after its vertices.
    has_colours: bool,
}

impl Elements<'_> {
    fn vertices(&mut self, form: &Form, width: usize) -> Result<(), FileProblem> {
        let (mut first_width, count) = (None, self.vertex_count);
        for vertex in 0..count {
            let mut ahead = self.words.clone();
            if ahead.next().is_none() {
                return Err(truncated("vertex", count, vertex));
            }
            let own_width = if form.has_vertex_lines {
                1 + ahead.words_in_line()
            } else {
                width
            };
            let first_width = *first_width.get_or_insert(own_width);
            if own_width < 3 {
                let name = ['x', 'y', 'z'][own_width];
                let reason = format!("vertex {vertex} has no {name} coordinate");
                return Err(FileProblem::at_line(ahead.number(), reason));
            }
            let position = read_vertex(vertex, || (self.words.next(), self.words.number()))?;
            for _ in 3..own_width {
                let word = self.words.next().ok_or_else(|| truncated("vertex", count, vertex))?;
                if number(word).is_none() {
                    let reason = format!(
                        "vertex {vertex} has '{}' after its coordinates, which is not a number",
                        quoted(word, 40)
                    );
                    return Err(FileProblem::at_line(self.words.number(), reason));
                }
            }
            if own_width != first_width {
                let reason = format!("vertex {vertex} has {own_width} numbers, but those before it have {first_width}");
                return Err(FileProblem::at_line(self.words.number(), reason));
            }
            self.parsed.positions.push(position);
        }
        Ok(())
    }

    fn faces(&mut self, form: &Form, count: usize, options: &ReadOptions<'_>) -> Result<(), FileProblem> {
        for face in 0..count {
            let word = self.words.next().ok_or_else(|| truncated("face", count, face))?;
            let line = self.words.number();
            self.face(face, word, form)?;
            match (self.corners.as_slice(), options.loose_features) {
                (&[point], true) => self.parsed.points.push(point),
                (&[from, to], true) => self.parsed.loose_edges.push([from, to]),
                ([] | [_] | [_, _], _) => {
                    let part = LeftOut::new(FilePart::Face, "", 1, Some(line), false);
                    self.parsed.leave_out(part);
                }
                (corners, _) => self.parsed.faces.push(corners),
            }
        }
        Ok(())
    }

    /// Reads `n v₁ … vₙ`, whose first word was read, and the colour after it.
    fn face(&mut self, face: usize, first: &[u8], form: &Form) -> Result<(), FileProblem> {
        let line = self.words.number();
        let wrong = |reason: String| FileProblem::Line { line, reason };
        // Without lines of their own, a face of fewer corners is rather a number in the wrong place.
        let least = if form.has_vertex_lines && form.has_face_lines { 1 } else { 3 };
        let count = integer(first).filter(|&count| count >= least).ok_or_else(|| {
            let text = [first, self.words.clone().rest_of_line()].join(&b' ');
            wrong(format!(
                "face {face} must begin with the number of its vertices, not '{}'",
                quoted(&text, 40)
            ))
        })?;
        self.corners.clear();
        for _ in 0..count {
            let word = if form.has_face_lines {
                self.words.next_in_line()
            } else {
                self.words.next()
            };
            let Some(word) = word else {
                let found = self.corners.len();
                return Err(wrong(format!("face {face} has {found} of its {count} vertices")));
            };
            let vertex = integer(word).ok_or_else(|| {
                wrong(format!(
                    "face {face} names a vertex '{}', which is not a whole number",
                    quoted(word, 40)
                ))
            })?;
            self.corners.push(corner(face, vertex, self.vertex_count, Some(line))?);
        }
        if !form.has_face_lines {
            return Ok(());
        }
        let colour = self.words.rest_of_line();
        self.has_colours |= !colour.is_empty();
        let is_colour = fields(colour).all(|word| number(word).is_some()) && matches!(fields(colour).count(), 0 | 1 | 3 | 4);
        if is_colour {
            return Ok(());
        }
        let reason = "which is no colour of one, three or four numbers";
        Err(wrong(format!(
            "face {face} has '{}' after its vertices, {reason}",
            quoted(colour, 40)
        )))
    }

    /// Reports the lines after the last face. Beside colours, a face of fewer than three corners may be the end of another face.
    fn finish(&mut self) {
        for part in &mut self.parsed.left_out {
            part.may_have_area |= self.has_colours;
        }
        let (mut count, mut first) = (0, None);
        while self.words.next().is_some() {
            first.get_or_insert(self.words.number());
            self.words.rest_of_line();
            count += 1;
        }
        if count > 0 {
            let part = LeftOut::new(FilePart::Line, "after the last face", count, first, true);
            self.parsed.leave_out(part);
        }
    }
}

fn truncated(element: &str, declared: usize, found: usize) -> FileProblem {
    FileProblem::Truncated {
        element: element.to_owned(),
        declared,
        found,
    }
}
