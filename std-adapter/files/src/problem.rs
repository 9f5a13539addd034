//! Problems of one file, of a mesh or of a moving figure. Each message says where the problem is and what to do.

use crate::excerpt::excerpt;
use crate::mesh::format::FileFormat;
use selvedge::TopologyError;
use std::fmt;
use std::io;

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
    #[error("the file's extension must be {}", FileFormat::extensions_in_words())]
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
    #[error("there is no group or object '{}'; {}", excerpt(name, 40), ChooseFrom(choices))]
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
struct ChooseFrom<'a>(&'a [String]);

impl fmt::Display for ChooseFrom<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            [] => f.write_str("it has none"),
            names => write!(f, "choose from '{}'", excerpt(&names.join("', '"), 400)),
        }
    }
}

/// A problem of a file of a moving figure. Vertices, triangles and keys are numbered from 0, names are the file's.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnimationProblem {
    /// It cannot be read, or its mesh is invalid.
    #[error(transparent)]
    File(#[from] FileProblem),
    /// The reader was left out of this program.
    #[error(
        "this program was built without the reader of glTF files; build it with the feature `gltf` of selvedge-cloth or selvedge-files"
    )]
    NotBuiltIn,
    /// The file is not valid glTF 2.0, or contradicts itself.
    #[error("is not a valid glTF 2.0 file: {0}")]
    NotGltf(String),
    /// The bytes of a buffer are missing.
    #[error("buffer {buffer} {reason}")]
    Buffer {
        /// The number of the buffer.
        buffer: usize,
        /// The problem.
        reason: String,
    },
    /// Some numbers are invalid.
    #[error("{what}: {reason}")]
    Values {
        /// The owner of the numbers, in words.
        what: String,
        /// The problem, and the valid form.
        reason: String,
    },
    /// No node has a mesh.
    #[error("no node of the file has a mesh")]
    NoMesh,
    /// No node with a mesh has this name.
    #[error("no node '{name}' has a mesh; those that have: {choices}")]
    NoSuchNode {
        /// The requested name.
        name: String,
        /// The names of the file.
        choices: NamesInFile,
    },
    /// Several nodes with a mesh have this name.
    #[error("{} nodes of this name have a mesh; name one by its path: {choices}", choices.0.len())]
    SeveralNodes {
        /// The paths of these nodes.
        choices: NamesInFile,
    },
    /// The file requires an extension without which its shapes or motion are not known.
    #[error("it requires the extension '{name}', which is not read; {remedy}")]
    Extension {
        /// The extension's name.
        name: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// No animation has this name.
    #[error("there is no animation '{name}'; {}", if choices.0.is_empty() { "there is none".to_owned() } else { format!("choose from {choices}") })]
    NoSuchAnimation {
        /// The requested name.
        name: String,
        /// The names of the file.
        choices: NamesInFile,
    },
    /// There are several animations, and none was chosen.
    #[error("there are {} animations; choose one with `animation`: {choices}", choices.0.len())]
    SeveralAnimations {
        /// The names of the file.
        choices: NamesInFile,
    },
}

/// The names to choose from, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NamesInFile(pub Vec<String>);

impl fmt::Display for NamesInFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, name) in self.0.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(f, "{comma}'{}'", excerpt(name, 40))?;
        }
        Ok(())
    }
}
