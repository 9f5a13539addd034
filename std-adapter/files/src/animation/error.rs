//! What can be wrong with the file of a moving figure.

use crate::excerpt::excerpt;
use crate::mesh::FileProblem;
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a figure could not be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", path.display())]
pub struct AnimationError {
    /// The file, as named by the caller.
    pub path: PathBuf,
    /// What is wrong with it.
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

/// What is wrong with a file of a moving figure. Vertices, triangles and keys are numbered from 0, names are the file's.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnimationProblem {
    /// It cannot be read, or its mesh is none.
    #[error(transparent)]
    File(#[from] FileProblem),
    /// The reader was left out of this program.
    #[error(
        "this program was built without the reader of glTF files; build it with the feature `gltf` of selvedge-cloth or selvedge-files"
    )]
    NotBuiltIn,
    /// It is no glTF 2.0 file, or one that contradicts itself.
    #[error("is not a valid glTF 2.0 file: {0}")]
    NotGltf(String),
    /// A buffer's bytes are not there.
    #[error("buffer {buffer} {reason}")]
    Buffer {
        /// Which buffer.
        buffer: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// Numbers are not as they should be.
    #[error("{what}: {reason}")]
    Values {
        /// Whose they are, in words.
        what: String,
        /// What is wrong with them, and what would be right.
        reason: String,
    },
    /// No node has a mesh.
    #[error("no node of the file has a mesh")]
    NoMesh,
    /// No node with a mesh has this name.
    #[error("no node '{name}' has a mesh; those that have: {choices}")]
    NoSuchNode {
        /// What was asked for.
        name: String,
        /// What there is.
        choices: Choices,
    },
    /// Several nodes have a mesh, and none was chosen.
    #[error("{} nodes have a mesh; say with `node` which is meant: {choices}", choices.0.len())]
    SeveralNodes {
        /// What there is.
        choices: Choices,
    },
    /// Nothing in the file moves.
    #[error("has no animation; a mesh that keeps its shape can be read as OBJ or PLY")]
    NoAnimation,
    /// No animation has this name.
    #[error("there is no animation '{name}'; choose from {choices}")]
    NoSuchAnimation {
        /// What was asked for.
        name: String,
        /// What there is.
        choices: Choices,
    },
    /// There are several animations, and none was chosen.
    #[error("there are {} animations; say with `animation` which is meant: {choices}", choices.0.len())]
    SeveralAnimations {
        /// What there is.
        choices: Choices,
    },
    /// The mesh stays as it is: neither its node nor a joint of its skin moves, nor a weight of its morph targets changes.
    #[error(
        "the animation '{animation}' does not move '{node}': it has no channel of its node, of a joint of its skin, or of its morph targets"
    )]
    NothingMoves {
        /// The animation.
        animation: String,
        /// The node.
        node: String,
    },
}

/// Names that there are to choose from, in the order of the file.
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
