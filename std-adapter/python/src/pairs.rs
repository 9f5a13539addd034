//! One pair of primitives, without a mesh.

use crate::answers::kind_of;
use crate::arrays::{Frames, with_frames};
use crate::errors::{self, InputError};
use crate::finder;
use numpy::Element;
use pyo3::prelude::*;
use selvedge::Scalar;
use selvedge::core::elementary::{ContactVerdict, Impact, advance, contact};
use selvedge::core::{Motion, PrimitivePair};

/// Builds a pair from rows: the vertex and the corners of the face, or the ends of both edges.
fn pair<S: Scalar + Element>(kind: u8, [start, end]: [&[[S; 3]]; 2]) -> PyResult<PrimitivePair<S>> {
    let kind = kind_of(kind)
        .ok_or_else(|| InputError::new_err(format!("{kind} is not a Kind: 0 is a vertex and a face, 1 two edges")))?;
    let (Ok(start), Ok(end)) = (<[_; 4]>::try_from(start), <[_; 4]>::try_from(end)) else {
        let text = format!(
            "a pair has four points, of shape (4, 3), not {} and {}",
            start.len(),
            end.len()
        );
        return Err(InputError::new_err(text));
    };
    for (name, points) in [("start", &start), ("end", &end)] {
        if points.iter().flatten().any(|coordinate| !coordinate.is_finite()) {
            return Err(InputError::new_err(format!("{name}: a coordinate is not a finite number")));
        }
    }
    let motion = |point: usize| Motion::new(start[point].into(), end[point].into());
    Ok(PrimitivePair::new(kind, [0, 1, 2, 3].map(motion)))
}

fn time_of<S: Scalar + Element>(
    kind: u8,
    frames: [&[[S; 3]]; 2],
    separation: f64,
    tolerance: Option<f64>,
    until: f64,
) -> PyResult<Option<f64>> {
    if !(0.0..=1.0).contains(&until) {
        return Err(InputError::new_err(format!(
            "until is {until}: it must be in [0, 1] of the step"
        )));
    }
    let limits = finder::limits(separation, tolerance).map_err(|error| errors::of_step(&error))?;
    let impact: Impact<S> = advance::time_of_impact(&pair(kind, frames)?, &limits);
    // A later time means no contact until then, since a time is never after the exact one.
    Ok(impact.time().map(S::to_f64).filter(|&time| time <= until))
}

#[doc = crate::stub!("time_of_impact")]
#[pyfunction]
#[pyo3(signature = (kind, start, end, *, separation=0.0, tolerance=None, until=1.0))]
pub(crate) fn time_of_impact(
    kind: u8,
    start: &Bound<'_, PyAny>,
    end: &Bound<'_, PyAny>,
    separation: f64,
    tolerance: Option<f64>,
    until: f64,
) -> PyResult<Option<f64>> {
    let frames = Frames::of([("start", start), ("end", end)])?;
    with_frames!(frames, [start, end] => time_of(kind, [start.rows()?, end.rows()?], separation, tolerance, until))
}

#[doc = crate::stub!("touches")]
#[pyfunction]
pub(crate) fn touches(kind: u8, start: &Bound<'_, PyAny>, end: &Bound<'_, PyAny>) -> PyResult<bool> {
    let frames = Frames::of([("start", start), ("end", end)])?;
    with_frames!(frames, [start, end] => Ok(contact(&pair(kind, [start.rows()?, end.rows()?])?) != ContactVerdict::Never))
}
