//! The two frames of a step, and what can be wrong with them.

use crate::PairKind;
use selvedge_core::Scalar;

/// Why a step could not be run. Nothing has changed; another one can be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// A frame has too few or too many positions.
    #[error("the {frame} frame has {found} positions, but the mesh has {expected} vertices")]
    WrongLength {
        /// `"start"`, `"end"`, or `"moving"` for what is no frame but has one entry for each vertex as well.
        frame: &'static str,
        /// The length of the slice.
        found: usize,
        /// The mesh's vertices.
        expected: usize,
    },
    /// A position is NaN or infinite. (Culling would keep every pair of that vertex; better to say so.)
    #[error("the {frame} frame has a coordinate that is not a finite number: vertex {vertex} is at {position}")]
    NotFinite {
        /// `"start"` or `"end"`.
        frame: &'static str,
        /// The first such vertex.
        vertex: usize,
        /// Its position.
        position: String,
    },
    /// A separation or a tolerance is negative, infinite or NaN.
    #[error("{length} is no separation, and no tolerance: it must be a finite length, not negative")]
    BadLimit {
        /// What was given.
        length: String,
    },
    /// A pair names a vertex, a face or an edge that the mesh does not have.
    #[error("there is no {kind} pair {}, {} in this mesh", pair[0], pair[1])]
    NoSuchPair {
        /// Vertex–face or edge–edge.
        kind: PairKind,
        /// The first such pair.
        pair: [u32; 2],
    },
}

/// A separation or a tolerance must be a length: finite, not negative.
pub fn check_length<S: Scalar>(length: S) -> Result<(), StepError> {
    if length >= S::ZERO && length.is_finite() {
        Ok(())
    } else {
        Err(StepError::BadLimit {
            length: format!("{length}"),
        })
    }
}

/// Both frames must have a finite position for each vertex.
pub fn check_frames<S: Scalar>(start: &[S::Vector], end: &[S::Vector], vertex_count: usize) -> Result<(), StepError> {
    check_frame::<S>("start", start, vertex_count)?;
    check_frame::<S>("end", end, vertex_count)
}

fn check_frame<S: Scalar>(frame: &'static str, positions: &[S::Vector], expected: usize) -> Result<(), StepError> {
    if positions.len() != expected {
        return Err(StepError::WrongLength {
            frame,
            found: positions.len(),
            expected,
        });
    }
    let is_finite = |&position: &S::Vector| {
        let coordinates: [S; 3] = position.into();
        coordinates.into_iter().all(Scalar::is_finite)
    };
    match positions.iter().position(|position| !is_finite(position)) {
        None => Ok(()),
        Some(vertex) => {
            let [x, y, z]: [S; 3] = positions[vertex].into();
            Err(StepError::NotFinite {
                frame,
                vertex,
                position: format!("({x}, {y}, {z})"),
            })
        }
    }
}
