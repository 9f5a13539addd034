//! PLY, in its three encodings, through `ply-rs-bw`.
//!
//! The library reads the header and one element at a time. Around it we check what it does not:
//! that a header does not claim more than the file can hold, declares nothing twice, and that
//! nothing is left over.

use super::error::FileProblem;
use super::{Features, Parsed, check_finite};
use crate::excerpt::excerpt;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::collections::HashSet;
use std::io::{self, BufRead, Write};

/// How the numbers of a PLY file are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlyEncoding {
    /// Text.
    Ascii,
    /// Binary, least significant byte first.
    #[default]
    LittleEndian,
    /// Binary, most significant byte first.
    BigEndian,
}

const COORDINATES: [&str; 3] = ["x", "y", "z"];
/// Both names are in use for the list of a face's vertices.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];
/// Of an edge.
const ENDS: [&str; 2] = ["vertex1", "vertex2"];

pub(super) fn parse(bytes: &[u8], features: Features) -> Result<Parsed, FileProblem> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Row>::new()
        .read_header(&mut reader)
        .map_err(|error| header_problem(bytes, &error))?;
    let line = reader.line();
    let rest = reader.into_inner();
    check_unique_names(&bytes[..bytes.len() - rest.len()])?;
    let vertex_count = check_layout(&header, features)?;

    let mut parsed = Parsed::default();
    let mut body = Body {
        parser: Parser::new(),
        encoding: header.encoding,
        rest,
        line,
        text: String::new(),
    };
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => body.read(element, |vertex, row, line| {
                let position = DVec3::from_array(row.coordinates);
                check_finite(vertex, position, line)?;
                parsed.mesh.positions.push(position);
                Ok(())
            })?,
            "face" => {
                let mut corners = Vec::new();
                body.read(element, |face, row, line| {
                    corners.clear();
                    for vertex in row.corners {
                        let index = u32::try_from(vertex).ok();
                        let index = index.filter(|&index| (index as usize) < vertex_count);
                        corners.push(index.ok_or(FileProblem::IndexOutOfRange {
                            line,
                            face,
                            vertex,
                            first: 0,
                            vertex_count,
                        })?);
                    }
                    if corners.len() < 3 {
                        return Err(FileProblem::TooFewCorners {
                            line,
                            face,
                            corners: corners.len(),
                        });
                    }
                    parsed.push_face(&corners);
                    Ok(())
                })?;
            }
            "edge" if features == Features::All => body.read(element, |edge, row, line| {
                let named = |end: i64| u32::try_from(end).ok().filter(|&end| (end as usize) < vertex_count);
                match row.ends.map(named) {
                    [Some(from), Some(to)] => parsed.loose_edges.push([from, to]),
                    [first, _] => {
                        let vertex = row.ends[usize::from(first.is_some())];
                        let reason = format!("names vertex {vertex}, but there are {vertex_count} vertices, numbered from 0");
                        return Err(match line {
                            Some(line) => FileProblem::Line {
                                line,
                                reason: format!("'edge' element {edge} {reason}"),
                            },
                            None => FileProblem::Element {
                                element: "edge".to_owned(),
                                index: edge,
                                reason,
                            },
                        });
                    }
                }
                Ok(())
            })?,
            _ => body.read(element, |_, _, _| Ok(()))?,
        }
    }
    body.finish()?;
    if features == Features::All && parsed.mesh.triangles.is_empty() && parsed.loose_edges.is_empty() {
        // As many as the file holds, which were read.
        parsed.points = (0..vertex_count as u32).collect();
    }
    Ok(parsed)
}

pub(super) fn write(out: &mut impl Write, mesh: &Mesh, loose_edges: &[[u32; 2]], encoding: PlyEncoding) -> io::Result<()> {
    let mut vertex = ElementDef::new("vertex".to_owned());
    vertex.count = mesh.positions.len();
    for name in COORDINATES {
        let double = PropertyType::Scalar(ScalarType::Double);
        vertex.properties.add(PropertyDef::new(name.to_owned(), double));
    }
    let mut face = ElementDef::new("face".to_owned());
    face.count = mesh.triangles.len();
    let list = PropertyType::List(ScalarType::UChar, ScalarType::UInt);
    face.properties.add(PropertyDef::new(CORNERS[0].to_owned(), list));
    let mut edge = ElementDef::new("edge".to_owned());
    edge.count = loose_edges.len();
    for name in ENDS {
        let index = PropertyType::Scalar(ScalarType::UInt);
        edge.properties.add(PropertyDef::new(name.to_owned(), index));
    }

    let mut header = Header::new();
    header.encoding = match encoding {
        PlyEncoding::Ascii => Encoding::Ascii,
        PlyEncoding::LittleEndian => Encoding::BinaryLittleEndian,
        PlyEncoding::BigEndian => Encoding::BinaryBigEndian,
    };
    header.elements.add(vertex.clone());
    header.elements.add(face.clone());
    if edge.count > 0 {
        header.elements.add(edge.clone());
    }

    let writer = Writer::<Written>::new();
    writer.write_header(out, &header)?;
    let vertices = mesh.positions.iter().map(|p| (Written::Vertex(*p), &vertex));
    let faces = mesh.triangles.iter().map(|t| (Written::Face(*t), &face));
    let edges = loose_edges.iter().map(|ends| (Written::Edge(*ends), &edge));
    for (row, element) in vertices.chain(faces).chain(edges) {
        match encoding {
            PlyEncoding::Ascii => writer.write_ascii_element(out, &row, element)?,
            PlyEncoding::LittleEndian => writer.write_little_endian_element(out, &row, element)?,
            PlyEncoding::BigEndian => writer.write_big_endian_element(out, &row, element)?,
        };
    }
    Ok(())
}

/// One element to write.
enum Written {
    Vertex(DVec3),
    Face([u32; 3]),
    Edge([u32; 2]),
}

impl PropertyAccess for Written {
    fn new() -> Self {
        Self::Face([0; 3])
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        match (self, name) {
            (Self::Vertex(position), "x") => Some(position.x),
            (Self::Vertex(position), "y") => Some(position.y),
            (Self::Vertex(position), "z") => Some(position.z),
            _ => None,
        }
    }

    fn get_uint(&self, name: &str) -> Option<u32> {
        let Self::Edge(ends) = self else { return None };
        ENDS.iter().position(|end| *end == name).map(|end| ends[end])
    }

    fn get_list_uint(&self, _name: &str) -> Option<&[u32]> {
        match self {
            Self::Face(triangle) => Some(triangle),
            Self::Vertex(_) | Self::Edge(_) => None,
        }
    }
}

/// What we want of one element read, whichever it is.
#[derive(Default)]
struct Row {
    coordinates: [f64; 3],
    corners: Vec<i64>,
    ends: [i64; 2],
    /// How many numbers the element is written with.
    numbers: usize,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        self.numbers += 1;
        match (scalar(&property), COORDINATES.iter().position(|c| *c == name)) {
            (Some(value), Some(coordinate)) => self.coordinates[coordinate] = value,
            (Some(value), None) => {
                if let Some(end) = ENDS.iter().position(|end| *end == name) {
                    // All of them are whole numbers: the header was looked at.
                    self.ends[end] = value as i64;
                }
            }
            (None, _) => {
                let (list, length) = integers(property);
                self.numbers += length;
                if CORNERS.contains(&name) && self.corners.is_empty() {
                    self.corners = list;
                }
            }
        }
        PropertyAccessResult::Set
    }
}

/// The value of a number; every type of PLY fits into an `f64` exactly.
fn scalar(property: &Property) -> Option<f64> {
    match *property {
        Property::Char(value) => Some(value.into()),
        Property::UChar(value) => Some(value.into()),
        Property::Short(value) => Some(value.into()),
        Property::UShort(value) => Some(value.into()),
        Property::Int(value) => Some(value.into()),
        Property::UInt(value) => Some(value.into()),
        Property::Float(value) => Some(value.into()),
        Property::Double(value) => Some(value),
        _ => None,
    }
}

/// A list of integers, and the length of any list.
fn integers(property: Property) -> (Vec<i64>, usize) {
    fn widen<T: Into<i64>>(list: Vec<T>) -> (Vec<i64>, usize) {
        let length = list.len();
        (list.into_iter().map(Into::into).collect(), length)
    }
    match property {
        Property::ListChar(list) => widen(list),
        Property::ListUChar(list) => widen(list),
        Property::ListShort(list) => widen(list),
        Property::ListUShort(list) => widen(list),
        Property::ListInt(list) => widen(list),
        Property::ListUInt(list) => widen(list),
        Property::ListFloat(list) => (Vec::new(), list.len()),
        Property::ListDouble(list) => (Vec::new(), list.len()),
        _ => (Vec::new(), 0),
    }
}

/// What follows the header.
struct Body<'a> {
    parser: Parser<Row>,
    encoding: Encoding,
    rest: &'a [u8],
    /// Of the next line, in an ASCII file.
    line: usize,
    text: String,
}

impl Body<'_> {
    /// Reads all elements of one kind; `take` gets each one's number, content and line.
    fn read(
        &mut self,
        element: &ElementDef,
        mut take: impl FnMut(usize, Row, Option<usize>) -> Result<(), FileProblem>,
    ) -> Result<(), FileProblem> {
        self.check_room(element)?;
        if self.encoding != Encoding::Ascii && element.properties.is_empty() {
            // Any number of them takes no bytes at all.
            return Ok(());
        }
        for index in 0..element.count {
            let (row, line) = match self.encoding {
                Encoding::Ascii => (self.read_line(element, index)?, Some(self.line)),
                _ => (self.read_binary(element, index)?, None),
            };
            take(index, row, line)?;
            self.line += 1;
        }
        Ok(())
    }

    /// Refuses a count that the rest of the file cannot hold, before anything is made of it.
    fn check_room(&self, element: &ElementDef) -> Result<(), FileProblem> {
        let properties = element.properties.values();
        let (each, last) = match self.encoding {
            // A digit and a separator for each property, or an empty line; the last line may end
            // with the file.
            Encoding::Ascii => ((2 * properties.len()).max(1), 1),
            _ => (properties.map(|p| smallest_size(&p.data_type)).sum(), 0),
        };
        let needed = element.count.saturating_mul(each).saturating_sub(last);
        if needed > self.rest.len() {
            return Err(FileProblem::TooShort {
                element: quoted(&element.name),
                declared: element.count,
                needed,
                left: self.rest.len(),
            });
        }
        Ok(())
    }

    fn read_binary(&mut self, element: &ElementDef, index: usize) -> Result<Row, FileProblem> {
        let row = match self.encoding {
            Encoding::BinaryBigEndian => self.parser.read_big_endian_element(&mut self.rest, element),
            _ => self.parser.read_little_endian_element(&mut self.rest, element),
        };
        row.map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => truncated(element, index),
            _ => FileProblem::Element {
                element: quoted(&element.name),
                index,
                reason: quoted(&error.to_string()),
            },
        })
    }

    fn read_line(&mut self, element: &ElementDef, index: usize) -> Result<Row, FileProblem> {
        self.text.clear();
        let line = self.line;
        let read = self.rest.read_line(&mut self.text);
        if read.map_err(|_| FileProblem::NotUtf8 { line })? == 0 {
            return Err(truncated(element, index));
        }
        match self.parser.read_ascii_element(&self.text, element) {
            Ok(row) if row.numbers == self.text.split_ascii_whitespace().count() => Ok(row),
            _ => Err(self.line_problem(element, index)),
        }
    }

    /// Why the line just read is not the element that it should be.
    fn line_problem(&self, element: &ElementDef, index: usize) -> FileProblem {
        // The library knows no `nan` and no `inf`, but the user should be told about them.
        let scalars = element
            .properties
            .values()
            .take_while(|p| matches!(p.data_type, PropertyType::Scalar(_)));
        if element.name == "vertex" {
            for (property, field) in scalars.zip(self.text.split_ascii_whitespace()) {
                let value = field.parse().unwrap_or(0.0_f64);
                if COORDINATES.contains(&property.name.as_str()) && !value.is_finite() {
                    return FileProblem::NonFinite {
                        line: Some(self.line),
                        vertex: index,
                        coordinate: property.name.chars().next().unwrap_or_default(),
                        value,
                    };
                }
            }
        }
        let names: Vec<&str> = element.properties.keys().map(String::as_str).collect();
        FileProblem::Line {
            line: self.line,
            reason: format!(
                "'{}' element {index} must be the numbers {} that the header declares, not '{}'",
                quoted(&element.name),
                quoted(&names.join(", ")),
                quoted(&self.text)
            ),
        }
    }

    /// Only white space may be left.
    fn finish(self) -> Result<(), FileProblem> {
        let bytes = self.rest.trim_ascii().len();
        if bytes == 0 {
            return Ok(());
        }
        Err(FileProblem::Trailing {
            line: (self.encoding == Encoding::Ascii).then_some(self.line),
            bytes,
        })
    }
}

fn truncated(element: &ElementDef, found: usize) -> FileProblem {
    FileProblem::Truncated {
        element: quoted(&element.name),
        declared: element.count,
        found,
    }
}

/// The bytes of a property in a binary file, with an empty list.
fn smallest_size(property: &PropertyType) -> usize {
    match property {
        PropertyType::Scalar(number) | PropertyType::List(number, _) => match number {
            ScalarType::Char | ScalarType::UChar => 1,
            ScalarType::Short | ScalarType::UShort => 2,
            ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
            ScalarType::Double => 8,
        },
    }
}

/// Refuses a header without vertices, faces or edges as we need them; otherwise how many vertices.
fn check_layout(header: &Header, features: Features) -> Result<usize, FileProblem> {
    let missing = |what: &str| FileProblem::Header(format!("declares no {what}"));
    let vertex = header.elements.get("vertex").ok_or_else(|| missing("element 'vertex'"))?;
    for name in COORDINATES {
        match vertex.properties.get(name).map(|p| &p.data_type) {
            Some(PropertyType::Scalar(_)) => {}
            _ => {
                return Err(missing(&format!("number '{name}' for the element 'vertex'")));
            }
        }
    }
    if let Some(edge) = header.elements.get("edge").filter(|_| features == Features::All) {
        for name in ENDS {
            match edge.properties.get(name).map(|p| &p.data_type) {
                Some(PropertyType::Scalar(number)) if !is_float(number) => {}
                _ => return Err(missing(&format!("integer '{name}' for the element 'edge'"))),
            }
        }
    }
    let Some(face) = header.elements.get("face") else {
        return match features {
            Features::Triangles => Err(missing("element 'face', so there are no triangles")),
            Features::All => Ok(vertex.count),
        };
    };
    match CORNERS
        .iter()
        .find_map(|name| face.properties.get(*name))
        .map(|p| &p.data_type)
    {
        Some(PropertyType::List(_, number)) if !is_float(number) => Ok(vertex.count),
        _ => Err(missing(
            "list of integers 'vertex_indices' or 'vertex_index' for the element 'face'",
        )),
    }
}

fn is_float(number: &ScalarType) -> bool {
    matches!(number, ScalarType::Float | ScalarType::Double)
}

/// The library keeps the last of two declarations with the same name and so would read the rest
/// of the file wrongly.
fn check_unique_names(header: &[u8]) -> Result<(), FileProblem> {
    let mut elements = HashSet::new();
    let mut properties = HashSet::new();
    for (index, line) in header.split(|&byte| byte == b'\n').enumerate() {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let (keyword, name) = (words.next(), words.next());
        let fresh = match (keyword, name) {
            (Some(b"element"), Some(name)) => {
                properties.clear();
                elements.insert(name)
            }
            (Some(b"property"), Some(first)) => properties.insert(words.next_back().unwrap_or(first)),
            _ => true,
        };
        if !fresh {
            return Err(FileProblem::Line {
                line: index + 1,
                reason: format!(
                    "the header declares this name twice: '{}'",
                    quoted(&String::from_utf8_lossy(line))
                ),
            });
        }
    }
    Ok(())
}

fn header_problem(bytes: &[u8], error: &ParseError) -> FileProblem {
    if !bytes.starts_with(b"ply") {
        return FileProblem::Header("is missing: a PLY file begins with a line 'ply'".to_owned());
    }
    match (error.kind(), error.line()) {
        (io::ErrorKind::UnexpectedEof, _) => {
            FileProblem::Header("has no end: the line 'end_header' is missing; is the file complete?".to_owned())
        }
        (_, Some(line)) => {
            let text = bytes.split(|&byte| byte == b'\n').nth(line - 1).unwrap_or_default();
            FileProblem::Line {
                line,
                reason: format!(
                    "this does not belong in the header of a PLY file: '{}'",
                    quoted(&String::from_utf8_lossy(text))
                ),
            }
        }
        _ => FileProblem::Header(format!("cannot be read: {}", quoted(&error.to_string()))),
    }
}

/// A line, or a name from the header, for a message.
fn quoted(text: &str) -> String {
    excerpt(text.trim(), 60)
}
