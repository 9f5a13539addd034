//! Why a step or a setting is refused.

use crate::PairKind;
use std::fmt;

/// One of the two frames of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The positions at time 0.
    Start,
    /// The positions at time 1.
    End,
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Start => "start",
            Self::End => "end",
        })
    }
}

/// Why a step could not be run, or a setting not be taken. Nothing has changed; another one can be.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A frame has too few or too many positions.
    WrongLength {
        /// Which frame.
        frame: Frame,
        /// How many positions it has.
        found: usize,
        /// The mesh's vertices.
        expected: usize,
    },
    /// A list that has an entry for each vertex has too few or too many.
    WrongCount {
        /// How many entries there are.
        found: usize,
        /// The mesh's vertices.
        expected: usize,
    },
    /// A position is NaN or infinite. (Culling would keep every pair of that vertex; better to say so.)
    NotFinite {
        /// Which frame.
        frame: Frame,
        /// The first such vertex.
        vertex: usize,
        /// Its position.
        position: [f64; 3],
    },
    /// A separation or a tolerance is negative, infinite or NaN.
    BadLimit {
        /// What was given.
        length: f64,
    },
    /// A vertex is named that the mesh does not have.
    NoSuchVertex {
        /// The vertex.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// A pair names a vertex, a face or an edge that the mesh does not have.
    NoSuchPair {
        /// Vertex–face or edge–edge.
        kind: PairKind,
        /// The first such pair.
        pair: [u32; 2],
    },
    /// A contact's time is not in [0, 1] of the step.
    BadTime {
        /// What was given.
        time: f64,
    },
    /// Another thread has [cancelled](crate::Cancellation) the step.
    Cancelled,
    /// More pairs are near each other than the [limit](crate::CollisionDetector::set_pair_limit) allows to look at.
    TooManyPairs {
        /// The limit.
        limit: u64,
    },
    /// The pairs and contacts of the step take more memory than the [limit](crate::CollisionDetector::set_memory_limit) allows.
    TooMuchMemory {
        /// The limit, in bytes.
        limit: u64,
    },
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::WrongLength { frame, found, expected } => {
                write!(
                    f,
                    "the {frame} frame has {found} positions, but the mesh has {expected} vertices"
                )
            }
            Self::WrongCount { found, expected } => {
                write!(f, "there are {found} entries, but the mesh has {expected} vertices")
            }
            Self::NotFinite {
                frame,
                vertex,
                position: [x, y, z],
            } => write!(
                f,
                "the {frame} frame has a coordinate that is not a finite number: vertex {vertex} is at ({x}, {y}, {z})"
            ),
            Self::BadLimit { length } => write!(
                f,
                "{length} is no separation, and no tolerance: it must be a finite length, not negative"
            ),
            Self::NoSuchVertex { vertex, count } => write!(f, "there is no vertex {vertex} in this mesh: it has {count}"),
            Self::NoSuchPair {
                kind,
                pair: [first, second],
            } => write!(f, "there is no {kind} pair {first}, {second} in this mesh"),
            Self::BadTime { time } => write!(f, "a contact's time is {time}: it must be in [0, 1] of the step"),
            Self::Cancelled => f.write_str("the step was cancelled"),
            Self::TooManyPairs { limit } => write!(
                f,
                "more than {limit} pairs are near each other, the most that may be looked at: raise the limit, or look whether the mesh has collapsed"
            ),
            Self::TooMuchMemory { limit } => write!(
                f,
                "the pairs and contacts of the step take more than {limit} bytes: check whether many triangles are in one place, or raise the memory limit"
            ),
        }
    }
}

impl std::error::Error for StepError {}
