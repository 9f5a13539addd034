//! Reasons for refusing a step or a setting.

use selvedge_core::PairKind;
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

/// The reason for refusing a step or a setting. The detector is unchanged and remains usable.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A frame has too few or too many positions.
    WrongLength {
        /// The frame.
        frame: Frame,
        /// The number of its positions.
        found: usize,
        /// The number of the mesh's vertices.
        expected: usize,
    },
    /// A list with one entry for each vertex has too few or too many entries.
    WrongCount {
        /// The number of entries.
        found: usize,
        /// The number of the mesh's vertices.
        expected: usize,
    },
    /// A position is NaN or infinite. Every pair of that vertex would have to count as a contact.
    NotFinite {
        /// The frame.
        frame: Frame,
        /// The first such vertex.
        vertex: usize,
        /// Its position.
        position: [f64; 3],
    },
    /// A separation or a tolerance is negative, infinite or NaN.
    BadLimit {
        /// The length.
        length: f64,
    },
    /// The mesh does not have a vertex that is named.
    NoSuchVertex {
        /// The vertex.
        vertex: u32,
        /// The number of the mesh's vertices.
        count: usize,
    },
    /// The mesh does not have a vertex, a face or an edge of a pair.
    NoSuchPair {
        /// Vertex–face or edge–edge.
        kind: PairKind,
        /// The first such pair.
        pair: [u32; 2],
    },
    /// A contact's time is not in [0, 1] of the step.
    BadTime {
        /// The time.
        time: f64,
    },
    /// Another thread [cancelled](crate::Cancellation) the step.
    Cancelled,
    /// More pairs are near each other than the [limit](crate::CollisionDetector::set_pair_limit) allows.
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
                "the length {length} is invalid: a separation, tolerance or distance must be finite and not negative"
            ),
            Self::NoSuchVertex { vertex, count } => write!(
                f,
                "there is no vertex {vertex}: the mesh has {count} vertices, numbered from 0"
            ),
            Self::NoSuchPair {
                kind,
                pair: [first, second],
            } => write!(f, "there is no {kind} pair {first}, {second} in this mesh"),
            Self::BadTime { time } => write!(f, "a contact's time is {time}: it must be in [0, 1] of the step"),
            Self::Cancelled => f.write_str("the step was cancelled"),
            Self::TooManyPairs { limit } => write!(
                f,
                "more than {limit} pairs are near each other: check whether the mesh has collapsed, or raise the pair limit"
            ),
            Self::TooMuchMemory { limit } => write!(
                f,
                "the pairs and contacts of the step take more than {limit} bytes: check whether many triangles are in one place, or raise the memory limit"
            ),
        }
    }
}

impl std::error::Error for StepError {}
