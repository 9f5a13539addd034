//! Problems of mesh files. Each message says where the problem is and what to do.

use super::frame_difference::FrameDifference;
use crate::excerpt::excerpt;
use crate::problem::FileProblem;
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

/// The reason why files are no sequence of frames.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SequenceProblem {
    /// The name has no place for the number, or several.
    #[error("the name of the files must have one run of '#' where their numbers stand, such as body-####.ply")]
    Pattern,
    /// The folder cannot be read.
    #[error("the folder '{}' cannot be read: {error}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The error of the system.
        error: std::io::Error,
    },
    /// No file has such a name.
    #[error("there is no such file in '{}'", folder.display())]
    NoFiles {
        /// The folder.
        folder: PathBuf,
    },
    /// A number is left out.
    #[error("frame {missing} is missing: there are frames up to {before}, and from {after} on")]
    MissingFrame {
        /// The first number that is missing.
        missing: u64,
        /// The last number before the gap.
        before: u64,
        /// The first number after the gap.
        after: u64,
    },
    /// Two files have the same number.
    #[error("frame {frame} is there twice: '{}' and '{}'", excerpt(one, 60), excerpt(other, 60))]
    TwiceThere {
        /// The number.
        frame: u64,
        /// A file.
        one: String,
        /// Another one.
        other: String,
    },
    /// A folder has files of several sequences, or meshes without a number.
    #[error(
        "this folder has more than one sequence ('{}' and '{}'); name the files, such as body-####.ply",
        excerpt(one, 60),
        excerpt(other, 60)
    )]
    SeveralSequences {
        /// A file.
        one: String,
        /// One of another sequence.
        other: String,
    },
}
