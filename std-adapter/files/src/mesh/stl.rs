//! STL, text and binary. The format has no vertex numbers, so vertices in exactly the same place are one, numbered by their first
//! appearance.
//!
//! This reader is our own because `stl_io` reads text as 32-bit numbers and skips unknown lines. Neither it nor `nom_stl` rejects
//! a loop of other than three vertices. The binary form is fifty bytes a triangle.

use super::checks::{check_finite, read_vertex};
use super::notes::{FilePart, LeftOut};
use super::options::ReadOptions;
use super::parsed::Parsed;
use super::text::{Words, fields, is_space, number, quoted, without_byte_order_mark};
use crate::problem::FileProblem;
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
    // Other bytes may begin like UTF-16 by chance.
    let is_wide = || {
        let letters = bytes.iter().take(24).filter(|byte| byte.is_ascii_graphic());
        without_byte_order_mark(bytes).is_err() && letters.copied().take(5).eq(*b"solid")
    };
    let mut parsed = Parsed::default();
    if size != Some(bytes.len()) && is_wide() {
        return Err(FileProblem::WideText);
    }
    if size != Some(bytes.len()) && is_like_text(bytes) {
        read_text(without_byte_order_mark(bytes)?, &mut parsed)?;
    } else {
        read_binary(bytes, declared, &mut parsed)?;
    }
    Ok(welded(parsed))
}

/// Returns whether the first bytes are those of a text. The number of triangles in a binary file is such only from a hundred
/// million on.
fn is_like_text(bytes: &[u8]) -> bool {
    let header = &bytes[..bytes.len().min(HEADER)];
    header.iter().all(|byte| *byte >= b' ' || is_space(byte))
}

fn no_header() -> FileProblem {
    FileProblem::Header("is missing: an STL file begins with 'solid' or with 84 bytes and the number of its triangles".to_owned())
}

fn read_binary(bytes: &[u8], declared: Option<usize>, parsed: &mut Parsed) -> Result<(), FileProblem> {
    let Some(declared) = declared else {
        return Err(no_header());
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

/// Returns whether a word is a keyword, in capitals or not.
fn is(word: &[u8], keyword: &str) -> bool {
    word.eq_ignore_ascii_case(keyword.as_bytes())
}

/// Reads `solid NAME`, its facets, and `endsolid NAME`, as often as they follow each other. White space and line ends separate
/// words alike; only a name ends with its line.
fn read_text(bytes: &[u8], parsed: &mut Parsed) -> Result<(), FileProblem> {
    let words = Words::new(bytes, false);
    let mut text = Text { words, parsed };
    let mut is_first = true;
    while let Some(word) = text.keyword(true) {
        if is_first && !is(word, "solid") && text.parsed.left_out.is_empty() {
            return Err(no_header());
        }
        text.expect(word, &["solid"])?;
        is_first = false;
        text.solid()?;
    }
    Ok(())
}

struct Text<'a, 'b> {
    words: Words<'a>,
    parsed: &'b mut Parsed,
}

impl<'a> Text<'a, '_> {
    /// Returns the next word.
    fn word(&mut self) -> Option<&'a [u8]> {
        self.skip_comments();
        self.words.next()
    }

    /// Leaves out lines `# …`. The format has no comments, but some programs write them.
    fn skip_comments(&mut self) {
        loop {
            let mut ahead = self.words.clone();
            let is_comment = ahead.next().is_some_and(|word| word.starts_with(b"#")) && ahead.is_first();
            if !is_comment {
                return;
            }
            let has_vertex = fields(ahead.rest_of_line()).any(|word| is(word, "vertex"));
            self.words = ahead;
            self.leave_out("#", has_vertex);
        }
    }

    fn leave_out(&mut self, name: &str, may_have_area: bool) {
        let line = Some(self.words.number());
        self.parsed
            .leave_out(LeftOut::new(FilePart::Line, name, 1, line, may_have_area));
    }

    /// Returns the next word that is no colour. The format has no colours, but some programs write `color R G B` outside of
    /// facets.
    fn keyword(&mut self, is_outside: bool) -> Option<&'a [u8]> {
        loop {
            let word = self.word()?;
            if !(is_outside && (is(word, "color") || is(word, "colour"))) {
                return Some(word);
            }
            self.leave_out("color", false);
            for _ in 0..4 {
                self.skip(|word| number(word).is_some());
            }
        }
    }

    /// Reads the next word if it is such a word.
    fn skip(&mut self, is_such: impl Fn(&[u8]) -> bool) {
        self.skip_comments();
        let mut ahead = self.words.clone();
        if ahead.next().is_some_and(is_such) {
            self.words = ahead;
        }
    }

    /// Returns the index of the keyword that a word is.
    fn expect(&mut self, word: &[u8], keywords: &[&str]) -> Result<usize, FileProblem> {
        if let Some(index) = keywords.iter().position(|keyword| is(word, keyword)) {
            return Ok(index);
        }
        let line = self.words.number();
        let found = [word, self.words.rest_of_line()].join(&b' ');
        let expected = keywords.join("' or '").replace("outer", "outer loop");
        let reason = format!("here must be '{expected}', not '{}'", quoted(&found, 60));
        Err(FileProblem::Line { line, reason })
    }

    /// Returns the index of the keyword that must follow.
    fn next(&mut self, keywords: &[&str]) -> Result<usize, FileProblem> {
        let word = self.keyword(keywords.contains(&"endsolid")).ok_or_else(no_end)?;
        self.expect(word, keywords)
    }

    /// Reads what follows the word `solid`.
    fn solid(&mut self) -> Result<(), FileProblem> {
        let name = self.name()?;
        while self.next(&["facet", "endsolid"])? == 0 {
            self.facet()?;
        }
        // Another solid may follow on the same line.
        let mut ahead = self.words.clone();
        let is_repeated = name.iter().all(|word| ahead.next_in_line() == Some(word));
        if is_repeated && ahead.clone().next_in_line().is_some_and(|word| is(word, "solid")) {
            self.words = ahead;
        } else {
            self.name()?;
        }
        Ok(())
    }

    /// Reads a name: the rest of the line, or the words before `facet normal`. It contains no facet.
    fn name(&mut self) -> Result<Vec<&'a [u8]>, FileProblem> {
        let mut name = Vec::new();
        loop {
            let mut ahead = self.words.clone();
            let Some(word) = ahead.next_in_line() else { break };
            if is(word, "facet") && ahead.clone().next_in_line().is_some_and(|word| is(word, "normal")) {
                break;
            }
            self.words = ahead;
            if is(word, "endloop") || is(word, "endfacet") {
                self.expect(word, &["facet normal"])?;
            }
            name.push(word);
        }
        Ok(name)
    }

    /// Reads what follows the word `facet`.
    fn facet(&mut self) -> Result<(), FileProblem> {
        if self.next(&["normal", "outer"])? == 0 {
            // A normal is not used, so it may be anything.
            for _ in 0..3 {
                self.skip(|word| !is(word, "outer"));
            }
            self.next(&["outer"])?;
        }
        self.next(&["loop"])?;
        let first = self.parsed.positions.len();
        while self.corner(first)? {
            let vertex = self.parsed.positions.len();
            let position = read_vertex(vertex, || (self.word(), self.words.number()))?;
            self.parsed.positions.push(position);
        }
        let corners = self.parsed.positions.len() - first;
        if corners != 3 {
            let face = self.parsed.faces.len();
            let reason = format!("facet {face} has {corners} vertices, but must have three");
            return Err(FileProblem::at_line(self.words.number(), reason));
        }
        let first = first as u32;
        self.parsed.faces.push(&[first, first + 1, first + 2]);
        self.next(&["endfacet"]).map(drop)
    }

    /// Returns whether a corner follows, and not the end of the loop.
    fn corner(&mut self, first: usize) -> Result<bool, FileProblem> {
        let word = self.keyword(false).ok_or_else(no_end)?;
        let vertex = self.parsed.positions.len();
        if vertex > first && number(word).is_some() {
            let reason = format!(
                "vertex {} has the fourth coordinate '{}', but must have three",
                vertex - 1,
                quoted(word, 40)
            );
            return Err(FileProblem::at_line(self.words.number(), reason));
        }
        Ok(self.expect(word, &["vertex", "endloop"])? == 0)
    }
}

fn no_end() -> FileProblem {
    FileProblem::Header("has no end: the line 'endsolid' is missing; is the file complete?".to_owned())
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
