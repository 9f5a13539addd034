//! The header of a PLY file.

use super::super::format::PlyEncoding;
use super::super::text::{Lines, fields, integer, quoted, without_byte_order_mark};
use super::{COORDINATES, CORNERS, ENDS};
use crate::problem::FileProblem;

#[derive(Debug, Default)]
pub(super) struct Header {
    pub(super) elements: Vec<Element>,
}

#[derive(Debug, PartialEq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<PlyProperty>,
}

#[derive(Debug, PartialEq)]
pub(super) struct PlyProperty {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) role: Role,
}

/// The use that the reader makes of a property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    Coordinate(usize),
    Corners,
    End(usize),
    /// The property is not used.
    Unused,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Scalar(Number),
    /// A list, with the types of its length and of its numbers.
    List(Number, Number),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Number {
    /// Returns the type for a name. There are two sets of names in use, and 64-bit integers, which some programs add.
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"long" | b"int64" => Self::I64,
            b"ulong" | b"uint64" => Self::U64,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }

    /// Returns the number of bytes in a binary file.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

impl Kind {
    /// Returns the number of bytes in a binary file, with an empty list.
    pub(super) fn smallest_size(self) -> usize {
        match self {
            Self::Scalar(number) | Self::List(number, _) => number.size(),
        }
    }
}

impl Header {
    pub(super) fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

impl Element {
    pub(super) fn has(&self, role: Role) -> bool {
        self.properties.iter().any(|property| property.role == role)
    }

    /// Returns the role of a property of that name and kind. Coordinates may be of any type; vertices are named by whole numbers.
    fn role(&self, name: &str, kind: Kind) -> Role {
        let place = |names: &[&str]| names.iter().position(|own| *own == name);
        let wanted = match (self.name.as_str(), kind) {
            ("vertex", Kind::Scalar(_)) => place(&COORDINATES).map(Role::Coordinate),
            ("face" | "tristrips", Kind::List(_, number)) if !number.is_float() => place(&CORNERS).map(|_| Role::Corners),
            ("edge", Kind::Scalar(number)) if !number.is_float() => place(&ENDS).map(Role::End),
            _ => None,
        };
        wanted.unwrap_or(Role::Unused)
    }
}

fn encoding_named(name: &[u8]) -> Option<PlyEncoding> {
    Some(match name {
        b"ascii" => PlyEncoding::Ascii,
        b"binary_little_endian" => PlyEncoding::LittleEndian,
        b"binary_big_endian" => PlyEncoding::BigEndian,
        _ => return None,
    })
}

/// Reads the header. Returns it with the encoding and the lines after it.
pub(super) fn read(bytes: &[u8]) -> Result<(Header, PlyEncoding, Lines<'_>), FileProblem> {
    let mut lines = Lines::new(without_byte_order_mark(bytes)?);
    if !lines.next().is_some_and(|line| fields(line).eq([b"ply"])) {
        return Err(FileProblem::Header(
            "is missing: a PLY file begins with a line 'ply'".to_owned(),
        ));
    }
    let mut header = Header::default();
    let mut encoding = None;
    while let Some(text) = lines.next() {
        let line = lines.number;
        let words: Vec<&[u8]> = fields(text).take(6).collect();
        match words.as_slice() {
            [] | [b"comment" | b"obj_info", ..] => {}
            [b"format", name, b"1.0"] if encoding.is_none() => match encoding_named(name) {
                Some(known) => encoding = Some(known),
                None => return Err(does_not_belong(line, text)),
            },
            [b"element", name, count] => {
                let count = integer(count).and_then(|count| usize::try_from(count).ok());
                let Some(count) = count else {
                    return Err(does_not_belong(line, text));
                };
                let name = String::from_utf8_lossy(name).into_owned();
                if header.element(&name).is_some() {
                    return Err(twice(line, text));
                }
                header.elements.push(Element {
                    name,
                    count,
                    properties: Vec::new(),
                });
            }
            [b"property", kind @ .., name] => {
                let kind = match kind {
                    [number] => Number::named(number).map(Kind::Scalar),
                    [b"list", length, number] => Number::named(length)
                        .filter(|length| !length.is_float())
                        .zip(Number::named(number))
                        .map(|(length, number)| Kind::List(length, number)),
                    _ => None,
                };
                let (Some(kind), Some(element)) = (kind, header.elements.last_mut()) else {
                    return Err(does_not_belong(line, text));
                };
                let name = String::from_utf8_lossy(name).into_owned();
                let role = element.role(&name, kind);
                if role != Role::Unused && element.has(role) {
                    return Err(twice(line, text));
                }
                element.properties.push(PlyProperty { name, kind, role });
            }
            [b"end_header"] => {
                let encoding =
                    encoding.ok_or_else(|| FileProblem::Header("has no line 'format', such as 'format ascii 1.0'".to_owned()))?;
                return Ok((header, encoding, lines));
            }
            _ => return Err(does_not_belong(line, text)),
        }
    }
    Err(FileProblem::Header(
        "has no end: the line 'end_header' is missing; is the file complete?".to_owned(),
    ))
}

fn does_not_belong(line: usize, text: &[u8]) -> FileProblem {
    let reason = format!("this does not belong in the header of a PLY file: '{}'", quoted(text, 60));
    FileProblem::Line { line, reason }
}

fn twice(line: usize, text: &[u8]) -> FileProblem {
    let reason = format!("the header declares this twice: '{}'", quoted(text, 60));
    FileProblem::Line { line, reason }
}
