//! Text files with any line end and any encoding of names, and with numbers as C and Rust spell them.

use crate::excerpt::excerpt;
use crate::problem::FileProblem;

/// The physical lines of a text with their numbers from 1. A line ends with LF, CR or CR LF.
#[derive(Clone, Copy)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    /// The number of lines that were returned.
    pub(super) number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, number: 0 }
    }

    /// The bytes after the last line that was returned.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|&byte| byte == b'\n' || byte == b'\r');
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = match rest {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => rest,
        };
        Some(line)
    }
}

/// The words of a text, with the numbers of their lines. White space and line ends separate words alike.
#[derive(Clone)]
pub(super) struct Words<'a> {
    lines: Lines<'a>,
    /// The part of the current line after the last word that was returned.
    line: &'a [u8],
    is_first: bool,
    /// True if `#` begins a comment, which ends with its line.
    has_comments: bool,
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a [u8], has_comments: bool) -> Self {
        Self {
            lines: Lines::new(text),
            line: &[],
            is_first: false,
            has_comments,
        }
    }

    /// The line of the last word that was returned, from 1.
    pub(super) fn number(&self) -> usize {
        self.lines.number
    }

    /// Returns whether the last word that was returned is the first of its line.
    pub(super) fn is_first(&self) -> bool {
        self.is_first
    }

    /// The number of bytes after the last word that was returned.
    pub(super) fn bytes_left(&self) -> usize {
        self.line.len() + self.lines.rest().len()
    }

    /// Returns how many words are left on the current line.
    pub(super) fn words_in_line(&self) -> usize {
        fields(self.line).count()
    }

    /// Returns the letters at the begin of the next word, and leaves the rest of it.
    pub(super) fn next_letters(&mut self) -> Option<&'a [u8]> {
        let mut ahead = self.clone();
        let word = ahead.next()?;
        let letters = word.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        if letters == word.len() {
            *self = ahead;
        } else {
            // Move to the begin of the word.
            while trim(self.line).is_empty() {
                self.next_line()?;
            }
            self.line = &trim(self.line)[letters..];
        }
        Some(&word[..letters])
    }

    fn next_line(&mut self) -> Option<()> {
        self.line = self.lines.next()?;
        if self.has_comments {
            self.line = self.line.split(|&byte| byte == b'#').next().unwrap_or_default();
        }
        Some(())
    }

    /// Returns the next word if it stands on the current line.
    pub(super) fn next_in_line(&mut self) -> Option<&'a [u8]> {
        let line = trim(self.line);
        if line.is_empty() {
            return None;
        }
        let (word, rest) = line.split_at(line.iter().position(is_space).unwrap_or(line.len()));
        self.line = rest;
        Some(word)
    }

    /// Returns the words that are left on the current line.
    pub(super) fn rest_of_line(&mut self) -> &'a [u8] {
        trim(std::mem::take(&mut self.line))
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        self.is_first = false;
        loop {
            if let Some(word) = self.next_in_line() {
                return Some(word);
            }
            self.is_first = true;
            self.next_line()?;
        }
    }
}

/// Removes a byte order mark in front of UTF-8 text.
///
/// # Errors
/// Returns an error if the bytes are UTF-16 or UTF-32 text, which no mesh format allows.
pub(super) fn without_byte_order_mark(bytes: &[u8]) -> Result<&[u8], FileProblem> {
    let is_wide = match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => true,
        // Without a mark the text is a letter and a zero byte, in either order.
        [a, b, c, d, ..] => matches!(
            [a, b, c, d].map(|&byte| byte != 0),
            [true, false, true, false] | [false, true, false, true]
        ),
        _ => false,
    };
    if is_wide {
        return Err(FileProblem::WideText);
    }
    Ok(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes))
}

/// Returns whether C's `isspace` accepts the byte.
pub(super) fn is_space(&byte: &u8) -> bool {
    matches!(byte, b' ' | 9..=13)
}

/// Returns the parts of a line between white space.
pub(super) fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(is_space).filter(|field| !field.is_empty())
}

pub(super) fn trim(mut line: &[u8]) -> &[u8] {
    while let [rest @ .., last] = line
        && is_space(last)
    {
        line = rest;
    }
    while let [first, rest @ ..] = line
        && is_space(first)
    {
        line = rest;
    }
    line
}

/// Parses a number as C's `strtod` and Rust spell it: `.5`, `5.`, `+1e3`, `inf`, `-nan(ind)`, and `1.#QNAN` of older Windows
/// programs. The result is the nearest `f64`, and may be infinite or NaN.
pub(super) fn number(field: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(field).ok()?;
    text.parse().ok().or_else(|| not_finite(text))
}

#[cold]
fn not_finite(text: &str) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    let unsigned = lower.trim_start_matches(['+', '-']);
    if unsigned.starts_with("nan(")
        || unsigned.starts_with("1.#qnan")
        || unsigned.starts_with("1.#snan")
        || unsigned.starts_with("1.#ind")
    {
        return Some(f64::NAN);
    }
    unsigned.starts_with("1.#inf").then_some(f64::INFINITY)
}

/// Parses a whole number in decimal digits with an optional sign.
pub(super) fn integer(field: &[u8]) -> Option<i64> {
    let (is_negative, digits) = match field {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0_i64;
    for digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        value = 10 * value + i64::from(digit - b'0');
    }
    Some(if is_negative { -value } else { value })
}

/// Returns a piece of a file for a message, in any encoding.
pub(super) fn quoted(text: &[u8], limit: usize) -> String {
    excerpt(&String::from_utf8_lossy(trim(text)), limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_with_lf_cr_or_both() {
        let lines: Vec<&[u8]> = Lines::new(b"a\rb\r\nc\n\nd\r\r").collect();
        assert_eq!(lines, [b"a", b"b", b"c", b"" as &[u8], b"d", b""]);
    }

    #[test]
    fn numbers_are_spelled_as_in_c() {
        let spelled = [
            (".5", 0.5),
            ("5.", 5.0),
            ("5.e0", 5.0),
            ("+.5E+1", 5.0),
            ("-0", -0.0),
            ("1e-400", 0.0),
            ("INF", f64::INFINITY),
            ("1.#INF00", f64::INFINITY),
        ];
        for (text, value) in spelled {
            assert_eq!(number(text.as_bytes()).map(f64::to_bits), Some(value.to_bits()), "{text}");
        }
        for text in ["nan", "-NaN", "-nan(ind)", "nan(0x8000)", "-1.#IND", "1.#QNAN0"] {
            assert!(number(text.as_bytes()).is_some_and(f64::is_nan), "{text}");
        }
        for text in ["", ".", "1,5", "1e", "0x10", "1.5f", "one", "\u{661}"] {
            assert_eq!(number(text.as_bytes()), None, "{text}");
        }
    }
}
