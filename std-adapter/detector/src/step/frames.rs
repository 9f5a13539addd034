//! The positions of a step, and checks of them.

use super::error::{Frame, StepError};
use crate::mesh::Topology;
use selvedge_core::PairKind;
use selvedge_core::boxes::Aabb;
use selvedge_core::boxes::mapping::Mapping;
use selvedge_core::glam::DVec3;
use selvedge_core::narrowing::rounded_up;
use selvedge_core::{Motion, Position, Scalar};

/// Checks that a separation, a tolerance or a distance is finite and not negative.
///
/// # Errors
/// Returns [`StepError::BadLimit`] otherwise.
pub(crate) fn check_length<S: Scalar>(length: S) -> Result<(), StepError> {
    if length >= S::ZERO && length.is_finite() {
        Ok(())
    } else {
        Err(StepError::BadLimit { length: length.to_f64() })
    }
}

/// Checks that both frames have a finite position for each vertex.
///
/// # Errors
/// Returns [`StepError::WrongLength`] or [`StepError::NotFinite`] otherwise, for the first frame with an error.
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

pub(crate) fn check_pair(topology: &Topology, kind: PairKind, pair: [u32; 2]) -> Result<(), StepError> {
    if topology.has_pair(kind, pair) {
        Ok(())
    } else {
        Err(StepError::NoSuchPair { kind, pair })
    }
}

/// Returns the same position in `f64`.
pub(crate) fn exactly<P: Position>(position: P) -> DVec3 {
    let [x, y, z] = position.into();
    DVec3::new(x.to_f64(), y.to_f64(), z.to_f64())
}

/// The positions of a step, in either format. Code that reads them is compiled once, not for each type of positions.
pub(crate) trait Motions: Sync {
    fn len(&self) -> usize;
    /// Returns where a vertex starts and ends, exactly.
    fn motion(&self, vertex: usize) -> Motion<f64>;
    /// Returns the mapping of boxes for the positions, whose extent is given. The other arguments are those of [`Mapping::new`].
    fn mapping(&self, extent: &Aabb<f64>, separation: f64, until: f64, is_swept: bool) -> Mapping;
}

/// Two frames that have a finite position for each vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<'a, P> {
    start: &'a [P],
    end: &'a [P],
}

impl<'a, P: Position> Step<'a, P> {
    /// Checks two frames.
    pub(crate) fn checked(start: &'a [P], end: &'a [P], vertex_count: usize) -> Result<Self, StepError> {
        check_frames(start, end, vertex_count)?;
        Ok(Self::of_finite(start, end))
    }

    /// Takes two frames that are known to be valid.
    pub(crate) const fn of_finite(start: &'a [P], end: &'a [P]) -> Self {
        Self { start, end }
    }
}

impl<P: Position> Motions for Step<'_, P> {
    fn len(&self) -> usize {
        self.start.len()
    }

    fn motion(&self, vertex: usize) -> Motion<f64> {
        Motion::new(exactly(self.start[vertex]), exactly(self.end[vertex]))
    }

    fn mapping(&self, extent: &Aabb<f64>, separation: f64, until: f64, is_swept: bool) -> Mapping {
        let (separation, until) = (rounded_up(separation), P::Scalar::from_f64(until));
        Mapping::new(extent, separation, until, is_swept)
    }
}

/// Rounds a position to the caller's format.
pub(crate) fn nearest<P: Position>(position: DVec3) -> P {
    P::from(position.to_array().map(P::Scalar::from_f64))
}

/// Rounds a position to the caller's format, and returns it in `f64`.
pub(crate) fn rounded<P: Position>(position: DVec3) -> DVec3 {
    exactly(nearest::<P>(position))
}
