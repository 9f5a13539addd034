//! The elements of a PLY file.

use super::super::checks::not_a_number;
use super::super::format::PlyEncoding;
use super::super::notes::{FilePart, LeftOut};
use super::super::parsed::Parsed;
use super::super::text::{Lines, fields, integer, is_space, number, quoted, trim};
use super::header::{Element, Kind, Number, PlyProperty, Role};
use super::{COORDINATES, element_problem};
use crate::problem::FileProblem;

#[derive(Debug, Default)]
pub(super) struct Row {
    pub(super) coordinates: [f64; 3],
    pub(super) corners: Vec<i64>,
    pub(super) ends: [i64; 2],
}

/// The bytes after the header.
pub(super) struct Body<'a> {
    encoding: PlyEncoding,
    /// The lines of a text file, or the bytes of a binary one.
    lines: Lines<'a>,
    rest: &'a [u8],
}

impl<'a> Body<'a> {
    pub(super) fn new(encoding: PlyEncoding, lines: Lines<'a>, bytes: &'a [u8]) -> Self {
        let mut rest = lines.rest();
        // If the lines of the header end in CR alone, the next byte belongs to the numbers, even if it looks like LF.
        let first_end = bytes.iter().position(|&byte| byte == b'\r' || byte == b'\n').unwrap_or(0);
        let header = &bytes[..bytes.len() - rest.len()];
        if bytes[first_end..].starts_with(b"\r") && !bytes[first_end..].starts_with(b"\r\n") && header.ends_with(b"\r\n") {
            rest = &bytes[header.len() - 1..];
        }
        Self { encoding, lines, rest }
    }

    /// Reads all elements of one kind. `take` gets the number, content and line of each.
    pub(super) fn read(
        &mut self,
        element: &Element,
        mut take: impl FnMut(usize, &Row, Option<usize>) -> Result<(), FileProblem>,
    ) -> Result<(), FileProblem> {
        self.check_room(element)?;
        if self.encoding != PlyEncoding::Ascii && element.properties.is_empty() {
            // Such elements take no bytes at all.
            return Ok(());
        }
        let mut row = Row::default();
        for index in 0..element.count {
            row.corners.clear();
            let line = match self.encoding {
                PlyEncoding::Ascii => Some(self.read_line(element, index, &mut row)?),
                PlyEncoding::LittleEndian => self.read_binary::<false>(element, index, &mut row)?,
                PlyEncoding::BigEndian => self.read_binary::<true>(element, index, &mut row)?,
            };
            take(index, &row, line)?;
        }
        Ok(())
    }

    /// Refuses a count that the rest of the file cannot hold, before memory is reserved for it.
    pub(super) fn check_room(&self, element: &Element) -> Result<(), FileProblem> {
        let properties = element.properties.iter();
        let (each, last, left) = match self.encoding {
            // An element takes a digit and a separator for each property, or an empty line. The last line may end with the file.
            PlyEncoding::Ascii => ((2 * properties.len()).max(1), 1, self.lines.rest().len()),
            _ => (
                properties.map(|property| property.kind.smallest_size()).sum(),
                0,
                self.rest.len(),
            ),
        };
        let needed = element.count.saturating_mul(each).saturating_sub(last);
        if needed > left {
            return Err(FileProblem::TooShort {
                element: quoted(element.name.as_bytes(), 60),
                declared: element.count,
                needed,
                left,
            });
        }
        Ok(())
    }

    fn read_binary<const BIG: bool>(
        &mut self,
        element: &Element,
        index: usize,
        row: &mut Row,
    ) -> Result<Option<usize>, FileProblem> {
        let cut_off = || truncated(element, index);
        for property in &element.properties {
            match property.kind {
                Kind::Scalar(number) => {
                    let bytes = take(&mut self.rest, number.size()).ok_or_else(cut_off)?;
                    match property.role {
                        Role::Coordinate(axis) => row.coordinates[axis] = value::<BIG>(number, bytes),
                        Role::End(end) => row.ends[end] = whole::<BIG>(number, bytes),
                        Role::Corners | Role::Unused => {}
                    }
                }
                Kind::List(length, number) => {
                    let bytes = take(&mut self.rest, length.size()).ok_or_else(cut_off)?;
                    let length = whole::<BIG>(length, bytes);
                    let Ok(length) = usize::try_from(length) else {
                        let reason = format!("the list '{}' has the length {length}", quoted(property.name.as_bytes(), 40));
                        return Err(element_problem(&element.name, index, None, reason));
                    };
                    let size = length.checked_mul(number.size()).ok_or_else(cut_off)?;
                    let bytes = take(&mut self.rest, size).ok_or_else(cut_off)?;
                    if property.role == Role::Corners {
                        row.corners
                            .extend(bytes.chunks_exact(number.size()).map(|bytes| whole::<BIG>(number, bytes)));
                    }
                }
            }
        }
        Ok(None)
    }

    /// Reads the next line that is not empty, and returns its number.
    fn read_line(&mut self, element: &Element, index: usize, row: &mut Row) -> Result<usize, FileProblem> {
        let mut text = self.lines.next().ok_or_else(|| truncated(element, index))?;
        while !element.properties.is_empty() && trim(text).is_empty() {
            text = self.lines.next().ok_or_else(|| truncated(element, index))?;
        }
        let line = self.lines.number;
        read_fields(element, text, row).ok_or_else(|| line_problem(element, index, line, text))?;
        Ok(line)
    }

    /// Reports the remaining bytes, unless they are white space or zeros.
    pub(super) fn finish(self, parsed: &mut Parsed) {
        let rest = match self.encoding {
            PlyEncoding::Ascii => self.lines.rest(),
            _ => self.rest,
        };
        if rest.iter().all(|byte| is_space(byte) || *byte == 0) {
            return;
        }
        parsed.leave_out(LeftOut::new(
            FilePart::TrailingByte,
            "",
            rest.len(),
            (self.encoding == PlyEncoding::Ascii).then_some(self.lines.number + 1),
            true,
        ));
    }
}

/// Reads exactly the fields that an element has. Unused fields may be anything.
fn read_fields(element: &Element, text: &[u8], row: &mut Row) -> Option<()> {
    let mut fields = fields(text);
    for property in &element.properties {
        match property.kind {
            Kind::Scalar(kind) => {
                let field = fields.next()?;
                match property.role {
                    Role::Coordinate(axis) => row.coordinates[axis] = spelled(kind, field)?,
                    Role::End(end) => row.ends[end] = integer(field)?,
                    Role::Corners | Role::Unused => {}
                }
            }
            Kind::List(..) => {
                let length = integer(fields.next()?)?;
                for _ in 0..u64::try_from(length).ok()? {
                    let field = fields.next()?;
                    if property.role == Role::Corners {
                        row.corners.push(integer(field)?);
                    }
                }
            }
        }
    }
    fields.next().is_none().then_some(())
}

/// Reads a number of that type. Numbers of the type `float` are rounded to it.
fn spelled(kind: Number, field: &[u8]) -> Option<f64> {
    let value = number(field)?;
    match kind {
        Number::F64 => Some(value),
        // The text is rounded once, since rounding twice may differ.
        Number::F32 => Some(
            std::str::from_utf8(field)
                .ok()?
                .parse()
                .map_or(value, |single: f32| f64::from(single)),
        ),
        // C reads the digits before the point, so a fraction would be lost.
        _ if value.fract() == 0.0 || !value.is_finite() => Some(value),
        _ => None,
    }
}

/// Returns the reason why a line is not the expected element.
#[cold]
fn line_problem(element: &Element, index: usize, line: usize, text: &[u8]) -> FileProblem {
    let scalars = element
        .properties
        .iter()
        .take_while(|property| matches!(property.kind, Kind::Scalar(_)));
    for (PlyProperty { role, .. }, field) in scalars.zip(fields(text)) {
        let Role::Coordinate(axis) = *role else { continue };
        match number(field) {
            Some(value) if !value.is_finite() => {
                return FileProblem::NonFinite {
                    line: Some(line),
                    vertex: index,
                    coordinate: ['x', 'y', 'z'][axis],
                    value,
                };
            }
            Some(_) => {}
            None => return not_a_number(index, line, COORDINATES[axis], field),
        }
    }
    let names: Vec<&str> = element.properties.iter().map(|property| property.name.as_str()).collect();
    FileProblem::at_line(
        line,
        format!(
            "'{}' element {index} must be the numbers {} that the header declares, not '{}'",
            quoted(element.name.as_bytes(), 60),
            quoted(names.join(", ").as_bytes(), 60),
            quoted(text, 60)
        ),
    )
}

fn truncated(element: &Element, found: usize) -> FileProblem {
    FileProblem::Truncated {
        element: quoted(element.name.as_bytes(), 60),
        declared: element.count,
        found,
    }
}

fn take<'a>(rest: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (taken, left) = rest.split_at_checked(count)?;
    *rest = left;
    Some(taken)
}

/// Returns the bytes of a number, least significant first, as an array of its size.
fn ordered<const BIG: bool, const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut own = [0; N];
    own.copy_from_slice(bytes);
    if BIG {
        own.reverse();
    }
    own
}

fn value<const BIG: bool>(number: Number, bytes: &[u8]) -> f64 {
    match number {
        Number::F32 => f32::from_le_bytes(ordered::<BIG, 4>(bytes)).into(),
        Number::F64 => f64::from_le_bytes(ordered::<BIG, 8>(bytes)),
        Number::U64 => u64::from_le_bytes(ordered::<BIG, 8>(bytes)) as f64,
        _ => whole::<BIG>(number, bytes) as f64,
    }
}

/// Returns a whole number. If it does not fit, it returns −1, which is no length and no vertex. Numbers with a fraction are not
/// read here.
fn whole<const BIG: bool>(number: Number, bytes: &[u8]) -> i64 {
    match number {
        Number::I8 => i8::from_le_bytes(ordered::<BIG, 1>(bytes)).into(),
        Number::U8 => bytes[0].into(),
        Number::I16 => i16::from_le_bytes(ordered::<BIG, 2>(bytes)).into(),
        Number::U16 => u16::from_le_bytes(ordered::<BIG, 2>(bytes)).into(),
        Number::I32 => i32::from_le_bytes(ordered::<BIG, 4>(bytes)).into(),
        Number::U32 => u32::from_le_bytes(ordered::<BIG, 4>(bytes)).into(),
        Number::I64 => i64::from_le_bytes(ordered::<BIG, 8>(bytes)),
        Number::U64 => i64::try_from(u64::from_le_bytes(ordered::<BIG, 8>(bytes))).unwrap_or(-1),
        Number::F32 | Number::F64 => -1,
    }
}
