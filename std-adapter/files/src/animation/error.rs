//! Problems of files of moving figures.

use crate::problem::AnimationProblem;
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
