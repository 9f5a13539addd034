//! Reads the names and positions with which a caller moves bodies and pins.

use crate::arrays::{Frames, with_frames};
use crate::errors::InputError;
use pyo3::prelude::*;
use selvedge_cloth::glam::DVec3;

/// A body or a cloth, by its name or by its index.
#[derive(FromPyObject)]
pub(crate) enum Body {
    Name(String),
    Index(usize),
}

impl Body {
    pub(crate) fn index(&self, simulation: &selvedge_cloth::Simulation) -> PyResult<usize> {
        self.among(simulation.body_names(), "body")
    }

    /// Returns the index of the cloth that it names.
    pub(crate) fn index_of_cloth(&self, simulation: &selvedge_cloth::Simulation) -> PyResult<usize> {
        self.among(simulation.cloth_names(), "cloth")
    }

    fn among(&self, names: &[String], kind: &str) -> PyResult<usize> {
        let found = match self {
            Self::Name(name) => names.iter().position(|known| known == name),
            Self::Index(index) => (*index < names.len()).then_some(*index),
        };
        found.ok_or_else(|| match self {
            Self::Name(name) => InputError::new_err(format!("there is no {kind} '{name}'; the scene has {names:?}")),
            Self::Index(index) => InputError::new_err(format!("there is no {kind} {index}; the scene has {}", names.len())),
        })
    }
}

/// Converts positions of either format to those of the simulation.
pub(crate) fn copied(positions: &Bound<'_, PyAny>) -> PyResult<Vec<DVec3>> {
    with_frames!(Frames::of([("positions", positions)])?, [positions] => {
        let rows = positions.rows()?.iter();
        Ok(rows.map(|row| DVec3::from(row.map(f64::from))).collect())
    })
}
