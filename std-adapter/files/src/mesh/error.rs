//! Problems of mesh files. Each message says where the problem is and what to do.

use super::parsed::Parsed;
use super::sequence::SequenceProblem;
use crate::animation::AnimationProblem;
use crate::excerpt::excerpt;
use selvedge::TopologyError;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The reason why a mesh could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// One file has a problem.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file, as named by the caller.
        path: PathBuf,
        /// The problem.
        problem: FileProblem,
    },
    /// Two files are not two frames of one mesh.
    #[error("{} and {} are not frames of the same mesh: {difference}; export both with the same vertices and triangles in the same order", start.display(), end.display())]
    Frames {
        /// The frame at the start of the step.
        start: PathBuf,
        /// The frame at the end of the step.
        end: PathBuf,
        /// The first difference.
        difference: FrameDifference,
    },
    /// Numbered files are no sequence.
    #[error("{}: {problem}", pattern.display())]
    Sequence {
        /// The pattern or folder.
        pattern: PathBuf,
        /// The problem.
        problem: SequenceProblem,
    },
}

impl MeshError {
    pub(super) fn file(path: &Path, problem: FileProblem) -> Self {
        Self::File {
            path: path.to_owned(),
            problem,
        }
    }
}

/// A problem of a mesh file. Vertices and faces are numbered from 0 in their order in the
/// file; lines from 1, where the file has lines.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileProblem {
    /// There is no such file.
    #[error("there is no such file")]
    Missing,
    /// The path names a folder.
    #[error("this is a folder; name a mesh file in it")]
    Folder,
    /// The file has no bytes.
    #[error("the file is empty")]
    Empty,
    /// The extension names no format.
    #[error("the file's extension must be .obj, .ply, .stl, .off, .gltf or .glb")]
    UnknownExtension,
    /// The system could not read the file.
    #[error("cannot be read: {0}")]
    Read(io::Error),
    /// The system could not write the file.
    #[error("cannot be written: {0}")]
    Write(io::Error),
    /// The text is UTF-16 or UTF-32.
    #[error("the text is UTF-16 or UTF-32, which mesh files must not be; save it as UTF-8 or ASCII")]
    WideText,
    /// The file holds more with an area than the reader can read, and the caller needs it whole.
    #[error("not all of the file can be read: {0}; export it as plain triangles")]
    Incomplete(String),
    /// The file has lines or elements that were not read, and no face.
    #[error("no face was read, but there are: {0}; is this a mesh, and of the format that its extension names?")]
    NoFace(String),
    /// One group was requested of a format that has none.
    #[error("this kind of file has no groups; only OBJ and glTF files can be read in part")]
    NoGroups,
    /// The file has no group or object of that name.
    #[error("there is no group or object '{}'; {}", excerpt(name, 40), Choices(choices))]
    NoSuchGroup {
        /// The requested name.
        name: String,
        /// The names of the file.
        choices: Vec<String>,
    },
    /// A line cannot be understood.
    #[error("line {line}: {reason}")]
    Line {
        /// The number of the line.
        line: usize,
        /// The problem.
        reason: String,
    },
    /// The header declares something that is no triangle mesh.
    #[error("the header {0}")]
    Header(String),
    /// The header declares more than the rest of the file can hold.
    #[error(
        "the header declares {declared} '{element}' elements, which take at least {needed} bytes, but only {left} are left; is the file complete?"
    )]
    TooShort {
        /// Name of the element.
        element: String,
        /// The number of elements that the header declares.
        declared: usize,
        /// The least number of bytes that they need.
        needed: usize,
        /// The number of bytes that remain.
        left: usize,
    },
    /// The file ends before all declared elements were read.
    #[error("the file ends after {found} of the {declared} '{element}' elements that its header declares; is it complete?")]
    Truncated {
        /// Name of the element.
        element: String,
        /// The number of elements that the header declares.
        declared: usize,
        /// The number of complete elements.
        found: usize,
    },
    /// An element of a binary file cannot be understood.
    #[error("'{}' element {index}: {reason}", excerpt(element, 60))]
    Element {
        /// Name of the element.
        element: String,
        /// The number of the element.
        index: usize,
        /// The problem.
        reason: String,
    },
    /// A coordinate is NaN or infinite.
    #[error("{}the {coordinate} coordinate of vertex {vertex} is {value}, but must be finite", Place(*line))]
    NonFinite {
        /// The line, in a file with lines.
        line: Option<usize>,
        /// The number of the vertex.
        vertex: usize,
        /// `x`, `y` or `z`.
        coordinate: char,
        /// The value.
        value: f64,
    },
    /// A face names a vertex that does not exist.
    #[error("{}face {face} names vertex {vertex}, but there are {vertex_count} vertices, numbered from {first}", Place(*line))]
    IndexOutOfRange {
        /// The line, in a file with lines.
        line: Option<usize>,
        /// The number of the face.
        face: usize,
        /// The vertex as the file names it.
        vertex: i64,
        /// The number of the first vertex in this kind of file.
        first: u32,
        /// The number of vertices in the file.
        vertex_count: usize,
    },
    /// A face has fewer than three vertices.
    #[error("{}face {face} has {corners} vertices, but needs three or more", Place(*line))]
    TooFewCorners {
        /// The line, in a file with lines.
        line: Option<usize>,
        /// The number of the face.
        face: usize,
        /// The number of its corners.
        corners: usize,
    },
    /// A problem of a glTF file.
    #[error(transparent)]
    Figure(Box<AnimationProblem>),
    /// The triangles have no topology: there are none, or too many.
    #[error(transparent)]
    Topology(#[from] TopologyError),
}

impl FileProblem {
    pub(crate) fn from_read(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::Missing,
            io::ErrorKind::IsADirectory => Self::Folder,
            _ => Self::Read(error),
        }
    }

    pub(crate) const fn at_line(line: usize, reason: String) -> Self {
        Self::Line { line, reason }
    }
}

/// Writes `line 7: `, or nothing in a file without lines.
struct Place(Option<usize>);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |line| write!(f, "line {line}: "))
    }
}

/// The names to choose from.
struct Choices<'a>(&'a [String]);

impl fmt::Display for Choices<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            [] => f.write_str("it has none"),
            names => write!(f, "choose from '{}'", excerpt(&names.join("', '"), 400)),
        }
    }
}

/// The first difference between the faces of two frames.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameDifference {
    /// The numbers of vertices differ.
    #[error("the first has {start} vertices, the second {end}")]
    VertexCount {
        /// The number at the start of the step.
        start: usize,
        /// The number at the end of the step.
        end: usize,
    },
    /// A face has different vertices, or the same ones in another order.
    #[error("face {face} is {} in the first, {} in the second", Corners(start), Corners(end))]
    Face {
        /// The number of the face, from 0.
        face: usize,
        /// Its vertices at the start of the step.
        start: Vec<u32>,
        /// Its vertices at the end of the step.
        end: Vec<u32>,
    },
    /// The numbers of faces differ, and all faces are alike as far as both lists go.
    #[error("the first has {start} faces, the second {end}")]
    FaceCount {
        /// The number at the start of the step.
        start: usize,
        /// The number at the end of the step.
        end: usize,
    },
}

impl FrameDifference {
    /// The first difference between the vertices and faces of two frames, if any.
    pub(super) fn find(start: &Parsed, end: &Parsed) -> Option<Self> {
        if start.positions.len() != end.positions.len() {
            return Some(Self::VertexCount {
                start: start.positions.len(),
                end: end.positions.len(),
            });
        }
        let mut pairs = start.faces.iter().zip(end.faces.iter()).enumerate();
        if let Some((face, (start, end))) = pairs.find(|(_, (start, end))| start != end) {
            return Some(Self::Face {
                face,
                start: start.to_vec(),
                end: end.to_vec(),
            });
        }
        let counts = [start, end].map(|frame| frame.faces.len());
        (counts[0] != counts[1]).then_some(Self::FaceCount {
            start: counts[0],
            end: counts[1],
        })
    }
}

struct Corners<'a>(&'a [u32]);

impl fmt::Display for Corners<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let corners: Vec<String> = self.0.iter().take(8).map(u32::to_string).collect();
        write!(f, "{}{}", corners.join(" "), if self.0.len() > 8 { " …" } else { "" })
    }
}
