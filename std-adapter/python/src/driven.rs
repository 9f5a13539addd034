//! Reads the names, vertices and positions with which a caller addresses cloths, bodies and pins.

use crate::arrays::{Frames, indices, with_frames};
use crate::errors::InputError;
use numpy::PyUntypedArrayMethods;
use pyo3::prelude::*;
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{BroughtBody, Placement};

/// A body or a cloth, by its name or by its index.
#[derive(FromPyObject)]
pub(crate) enum Body {
    Name(String),
    Index(usize),
}

impl Body {
    pub(crate) fn index(&self, names: &[String]) -> PyResult<usize> {
        match self {
            Self::Name(name) => named("body", name, names),
            Self::Index(index) => numbered("body", *index, names),
        }
    }

    pub(crate) fn indices(bodies: &[Self], names: &[String]) -> PyResult<Vec<usize>> {
        bodies.iter().map(|body| body.index(names)).collect()
    }
}

/// A cloth, by its name or by its index.
#[derive(FromPyObject)]
pub(crate) enum Cloth {
    Name(String),
    Index(usize),
}

impl Cloth {
    pub(crate) fn index(&self, names: &[String]) -> PyResult<usize> {
        match self {
            Self::Name(name) => named("cloth", name, names),
            Self::Index(index) => numbered("cloth", *index, names),
        }
    }

    pub(crate) fn indices(cloths: &[Self], names: &[String]) -> PyResult<Vec<usize>> {
        cloths.iter().map(|cloth| cloth.index(names)).collect()
    }
}

fn named(what: &str, name: &str, names: &[String]) -> PyResult<usize> {
    let found = names.iter().position(|known| known == name);
    found.ok_or_else(|| InputError::new_err(format!("there is no {what} '{name}'; the scene has {names:?}")))
}

fn numbered(what: &str, index: usize, names: &[String]) -> PyResult<usize> {
    let count = names.len();
    (index < count)
        .then_some(index)
        .ok_or_else(|| InputError::new_err(format!("there is no {what} {index}; the scene has {count}")))
}

/// A placement: a quaternion (x, y, z, w), then a translation.
pub(crate) fn placement(translation: [f64; 3], rotation: [f64; 4]) -> Placement {
    Placement::new(DQuat::from_array(rotation), translation.into())
}

pub(crate) fn brought_to(placement: Placement, velocity: [f64; 3], spin: [f64; 3]) -> BroughtBody {
    BroughtBody {
        placement,
        velocity: velocity.into(),
        spin: spin.into(),
    }
}

/// Converts positions of either format to those of the simulation.
pub(crate) fn copied(positions: &Bound<'_, PyAny>) -> PyResult<Vec<DVec3>> {
    copied_as(positions, "positions")
}

/// Converts positions like [`copied`]; messages name them `name`.
pub(crate) fn copied_as(positions: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<DVec3>> {
    with_frames!(Frames::of([(name, positions)])?, [positions] => {
        let rows = positions.rows()?.iter();
        Ok(rows.map(|row| DVec3::from(row.map(f64::from))).collect())
    })
}

/// Converts vertices: their numbers, or one truth value for each of `count` vertices.
pub(crate) fn whole_numbers(vertices: &Bound<'_, PyAny>, name: &str, count: usize) -> PyResult<Vec<u32>> {
    if let Ok(mask) = vertices.cast::<numpy::PyArray1<bool>>() {
        if mask.len() != count {
            let text = format!("{name}: the mask has {} entries for {count} vertices", mask.len());
            return Err(InputError::new_err(text));
        }
        let mask = numpy::PyArrayMethods::to_vec(mask)?;
        return Ok((0..)
            .zip(mask)
            .filter_map(|(vertex, is_in)| is_in.then_some(vertex))
            .collect());
    }
    Ok(indices::<1>(vertices, name)?.into_iter().map(|[vertex]| vertex).collect())
}
