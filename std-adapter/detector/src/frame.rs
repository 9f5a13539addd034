//! The two frames of a step, and what can be wrong with them.

use crate::PairKind;
use crate::broad_phase::Fit;
use selvedge_core::boxes::Aabb;
use selvedge_core::boxes::mapping::Mapping;
use selvedge_core::glam::DVec3;
use selvedge_core::narrowing::rounded_up;
use selvedge_core::{Motion, Position, Scalar};
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
        }
    }
}

impl std::error::Error for StepError {}

/// A separation or a tolerance must be a length: finite, not negative.
pub fn check_length<S: Scalar>(length: S) -> Result<(), StepError> {
    if length >= S::ZERO && length.is_finite() {
        Ok(())
    } else {
        Err(StepError::BadLimit { length: length.to_f64() })
    }
}

/// Both frames must have a finite position for each vertex.
pub fn check_frames<P: Position>(start: &[P], end: &[P], vertex_count: usize) -> Result<(), StepError> {
    check_frame(Frame::Start, start, vertex_count)?;
    check_frame(Frame::End, end, vertex_count)
}

pub(crate) fn check_frame<P: Position>(frame: Frame, positions: &[P], expected: usize) -> Result<(), StepError> {
    if positions.len() != expected {
        return Err(StepError::WrongLength {
            frame,
            found: positions.len(),
            expected,
        });
    }
    let is_finite = |&position: &P| {
        let [x, y, z] = position.into();
        x.is_finite() && y.is_finite() && z.is_finite()
    };
    match positions.iter().position(|position| !is_finite(position)) {
        None => Ok(()),
        Some(vertex) => {
            let position: [P::Scalar; 3] = positions[vertex].into();
            Err(StepError::NotFinite {
                frame,
                vertex,
                position: position.map(Scalar::to_f64),
            })
        }
    }
}

/// The same position in `f64`.
pub(crate) fn exactly<P: Position>(position: P) -> DVec3 {
    let [x, y, z] = position.into();
    DVec3::new(x.to_f64(), y.to_f64(), z.to_f64())
}

/// A step's positions, of either format. What reads them is compiled once, not for each type that positions have.
pub(crate) trait Motions: Sync {
    /// How many vertices there are.
    fn len(&self) -> usize;
    /// Where a vertex starts and ends, exactly.
    fn of(&self, vertex: usize) -> Motion<f64>;
    /// How boxes are made of them; `extent` is theirs.
    fn mapping(&self, extent: &Aabb<f64>, fit: &Fit) -> Mapping;
}

/// Frames that are as long as they must be, and finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<'a, P> {
    start: &'a [P],
    end: &'a [P],
}

impl<'a, P: Position> Step<'a, P> {
    /// Checks the frames of a mesh with so many vertices.
    pub(crate) fn checked(start: &'a [P], end: &'a [P], vertex_count: usize) -> Result<Self, StepError> {
        check_frames(start, end, vertex_count)?;
        Ok(Self::of_finite(start, end))
    }

    /// Of frames that are known to be as long as they must be, and finite.
    pub(crate) const fn of_finite(start: &'a [P], end: &'a [P]) -> Self {
        Self { start, end }
    }
}

impl<P: Position> Motions for Step<'_, P> {
    fn len(&self) -> usize {
        self.start.len()
    }

    fn of(&self, vertex: usize) -> Motion<f64> {
        Motion::new(exactly(self.start[vertex]), exactly(self.end[vertex]))
    }

    fn mapping(&self, extent: &Aabb<f64>, fit: &Fit) -> Mapping {
        let (separation, until) = (rounded_up(fit.separation), P::Scalar::from_f64(fit.until));
        Mapping::new(extent, separation, until, fit.is_swept)
    }
}
