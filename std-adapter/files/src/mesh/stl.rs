//! STL, text and binary. The format has no vertex numbers, so vertices in exactly the same place are one, numbered by their first
//! appearance.
//!
//! This reader is our own because `stl_io` reads text as 32-bit numbers and skips unknown lines. Neither it nor `nom_stl` rejects
//! a loop of other than three vertices. The binary form is fifty bytes a triangle.

use super::error::FileProblem;
use super::notes::{FilePart, LeftOut};
use super::parsed::Parsed;
use super::text::{Lines, fields, quoted, without_byte_order_mark};
use super::{ReadOptions, check_finite, read_vertex};
use selvedge::first_coincident;
use selvedge_core::glam::DVec3;

/// The size of the header: a text of eighty bytes, and the number of triangles.
const HEADER: usize = 84;
/// The size of a triangle: a normal, three corners of 32-bit numbers, and two bytes.
const TRIANGLE: usize = 50;

pub(super) fn parse(bytes: &[u8], options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    if options.only.is_some() {
        return Err(FileProblem::NoGroups);
    }
    let declared = bytes
        .get(80..HEADER)
        .map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize);
    let size = declared.map(|count| HEADER.saturating_add(count.saturating_mul(TRIANGLE)));
    // Binary files may begin with `solid` as well, but few texts have the size that their bytes 80 to 83 say.
    let is_text = || starts_text(without_byte_order_mark(bytes).unwrap_or(bytes));
    // Other bytes may begin like UTF-16 by chance.
    let is_wide = || {
        let letters = bytes.iter().take(24).filter(|byte| byte.is_ascii_graphic());
        without_byte_order_mark(bytes).is_err() && letters.copied().take(5).eq(*b"solid")
    };
    let mut parsed = Parsed::default();
    if size != Some(bytes.len()) && is_wide() {
        return Err(FileProblem::WideText);
    }
    if size != Some(bytes.len()) && is_text() {
        read_text(without_byte_order_mark(bytes)?, &mut parsed)?;
    } else {
        read_binary(bytes, declared, &mut parsed)?;
    }
    Ok(welded(parsed))
}

/// Returns whether a text begins with `solid`, and the first line after it with `facet` or `endsolid`.
fn starts_text(bytes: &[u8]) -> bool {
    let mut lines = Lines::new(bytes).filter_map(|line| fields(line).next());
    let is = |word: Option<&[u8]>, names: &[&str]| {
        word.is_some_and(|word| names.iter().any(|name| word.eq_ignore_ascii_case(name.as_bytes())))
    };
    is(lines.next(), &["solid"]) && is(lines.next(), &["facet", "endsolid"])
}

fn read_binary(bytes: &[u8], declared: Option<usize>, parsed: &mut Parsed) -> Result<(), FileProblem> {
    let Some(declared) = declared else {
        return Err(FileProblem::Header(
            "is missing: an STL file begins with 'solid' or with 84 bytes and the number of its triangles".to_owned(),
        ));
    };
    let body = &bytes[HEADER..];
    if body.len() / TRIANGLE < declared {
        return Err(FileProblem::Truncated {
            element: "triangle".to_owned(),
            declared,
            found: body.len() / TRIANGLE,
        });
    }
    let (body, rest) = body.split_at(declared * TRIANGLE);
    parsed.positions.reserve_exact(3 * declared);
    for triangle in body.chunks_exact(TRIANGLE) {
        let first = parsed.positions.len() as u32;
        for corner in triangle[12..48].chunks_exact(12) {
            let coordinate = |k: usize| f32::from_le_bytes([corner[k], corner[k + 1], corner[k + 2], corner[k + 3]]);
            let position = DVec3::new(coordinate(0).into(), coordinate(4).into(), coordinate(8).into());
            check_finite(parsed.positions.len(), position, None)?;
            parsed.positions.push(position);
        }
        parsed.faces.push(&[first, first + 1, first + 2]);
    }
    if rest.iter().any(|&byte| byte != 0) {
        parsed.leave_out(LeftOut::new(FilePart::TrailingByte, "", rest.len(), None, true));
    }
    Ok(())
}

/// The place in a text, which decides on the lines that may follow.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Outside,
    Solid,
    Facet,
    Loop,
    AfterLoop,
}

fn read_text(bytes: &[u8], parsed: &mut Parsed) -> Result<(), FileProblem> {
    let mut lines = Lines::new(bytes);
    let mut state = State::Outside;
    while let Some(text) = lines.next() {
        let line = lines.number;
        let mut words = fields(text);
        let Some(first) = words.next() else { continue };
        let wrong = |reason: String| FileProblem::Line { line, reason };
        state = match (state, first.to_ascii_lowercase().as_slice()) {
            (State::Outside, b"solid") => State::Solid,
            (State::Solid, b"endsolid") => State::Outside,
            (State::Solid, b"facet") => State::Facet,
            (State::Facet, b"outer") => State::Loop,
            (State::Loop, b"vertex") => {
                let vertex = parsed.positions.len();
                parsed.positions.push(read_vertex(vertex, line, words)?);
                State::Loop
            }
            (State::Loop, b"endloop") => {
                let first = 3 * parsed.faces.len();
                let corners = parsed.positions.len() - first;
                if corners != 3 {
                    let face = parsed.faces.len();
                    return Err(wrong(format!("facet {face} has {corners} vertices, but must have three")));
                }
                let first = first as u32;
                parsed.faces.push(&[first, first + 1, first + 2]);
                State::AfterLoop
            }
            (State::AfterLoop, b"endfacet") => State::Solid,
            (state, _) => {
                let expected = match state {
                    State::Outside => "'solid'",
                    State::Solid => "'facet' or 'endsolid'",
                    State::Facet => "'outer loop'",
                    State::Loop => "'vertex' or 'endloop'",
                    State::AfterLoop => "'endfacet'",
                };
                return Err(wrong(format!("here must be {expected}, not '{}'", quoted(text, 60))));
            }
        };
    }
    if state == State::Outside {
        return Ok(());
    }
    Err(FileProblem::Header(
        "has no end: the line 'endsolid' is missing; is the file complete?".to_owned(),
    ))
}

/// Merges equal vertices.
fn welded(mut parsed: Parsed) -> Parsed {
    let first = first_coincident(&parsed.positions, 0.0);
    let mut numbers: Vec<u32> = Vec::with_capacity(first.len());
    let mut count = 0;
    for (vertex, &first) in first.iter().enumerate() {
        if first as usize == vertex {
            parsed.positions[count] = parsed.positions[vertex];
            numbers.push(count as u32);
            count += 1;
        } else {
            numbers.push(numbers[first as usize]);
        }
    }
    parsed.positions.truncate(count);
    parsed.faces.renumber(&numbers);
    parsed
}
