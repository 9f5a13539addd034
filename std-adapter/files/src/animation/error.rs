//! Problems of files of moving figures.

use crate::excerpt::excerpt;
use crate::mesh::FileProblem;
use std::fmt;
use std::path::{Path, PathBuf};

/// The reason why a figure could not be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", path.display())]
pub struct AnimationError {
    /// The file, as named by the caller.
    pub path: PathBuf,
    /// The problem.
    pub problem: AnimationProblem,
}

impl AnimationError {
    pub(super) fn of(path: &Path, problem: AnimationProblem) -> Self {
        Self {
            path: path.to_owned(),
            problem,
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
        choices: Choices,
    },
    /// Several nodes with a mesh have this name.
    #[error("{} nodes of this name have a mesh; name one by its path: {choices}", choices.0.len())]
    SeveralNodes {
        /// The paths of these nodes.
        choices: Choices,
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
        choices: Choices,
    },
    /// There are several animations, and none was chosen.
    #[error("there are {} animations; choose one with `animation`: {choices}", choices.0.len())]
    SeveralAnimations {
        /// The names of the file.
        choices: Choices,
    },
}

/// The names to choose from, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Choices(pub Vec<String>);

impl fmt::Display for Choices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, name) in self.0.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(f, "{comma}'{}'", excerpt(name, 40))?;
        }
        Ok(())
    }
}
