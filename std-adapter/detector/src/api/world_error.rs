//! Why a world refuses a question.

use crate::engine::world::MeshHandle;
use crate::step::StepError;
use std::fmt;

/// Why a world could not do what it was asked. Nothing was lost: it can be asked again.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WorldError {
    /// The mesh was removed, or never there.
    NoSuchMesh {
        /// What was given.
        mesh: MeshHandle,
    },
    /// Two motions are given for one mesh.
    MovedTwice {
        /// Which mesh.
        mesh: MeshHandle,
    },
    /// The positions that a mesh is to move between are too few, too many, or not finite.
    BadPositions {
        /// Which mesh.
        mesh: MeshHandle,
        /// What is wrong with them.
        error: StepError,
    },
    /// A pose is none: a number is not finite, the quaternion is zero, or the mesh would be out of the range of numbers.
    BadPose {
        /// Which mesh.
        mesh: MeshHandle,
    },
    /// All meshes together have too many vertices to be numbered.
    TooLarge {
        /// How many they would have.
        vertices: usize,
        /// How many they may have.
        most: usize,
    },
    /// Positions to be inserted, a length of the criterion, or why the step was cut short.
    Step(StepError),
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchMesh { mesh } => write!(f, "there is no mesh {mesh}: it was removed, or is of another world"),
            Self::MovedTwice { mesh } => write!(f, "two motions are given for mesh {mesh}: give one"),
            Self::BadPositions { mesh, error } => write!(f, "mesh {mesh}: {error}"),
            Self::BadPose { mesh } => write!(
                f,
                "mesh {mesh} has no such pose: its numbers must be finite, its quaternion not zero, and the mesh in the range of numbers"
            ),
            Self::TooLarge { vertices, most } => {
                write!(
                    f,
                    "the meshes would have {vertices} vertices, but more than {most} cannot be numbered"
                )
            }
            Self::Step(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for WorldError {}

impl From<StepError> for WorldError {
    fn from(error: StepError) -> Self {
        Self::Step(error)
    }
}
