//! Reasons for refusing a step of a world.

use crate::engine::world::MeshHandle;
use crate::step::StepError;
use std::fmt;

/// The reason for refusing a call to a world, which remains usable.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WorldError {
    /// The mesh was removed, or belongs to another world.
    NoSuchMesh {
        /// The handle.
        mesh: MeshHandle,
    },
    /// Two motions are given for one mesh.
    MovedTwice {
        /// The mesh.
        mesh: MeshHandle,
    },
    /// The positions of a mesh are too few, too many, or not finite.
    BadPositions {
        /// The mesh.
        mesh: MeshHandle,
        /// The reason.
        error: StepError,
    },
    /// A pose is invalid: a number is not finite, the quaternion is zero, or a position would overflow.
    BadPose {
        /// The mesh.
        mesh: MeshHandle,
    },
    /// All meshes together have too many vertices to be numbered.
    TooLarge {
        /// The number of vertices.
        vertices: usize,
        /// The most vertices.
        most: usize,
    },
    /// Positions to insert or a length of the criterion are invalid, or the step was cut short.
    Step(StepError),
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchMesh { mesh } => write!(f, "there is no mesh {mesh}: it was removed, or belongs to another world"),
            Self::MovedTwice { mesh } => write!(f, "two motions are given for mesh {mesh}: give one"),
            Self::BadPositions { mesh, error } => write!(f, "mesh {mesh}: {error}"),
            Self::BadPose { mesh } => write!(
                f,
                "the pose of mesh {mesh} is invalid: its numbers must be finite, its quaternion not zero, and all positions within the range of numbers"
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
