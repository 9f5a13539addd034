//! Ranges of numbers. Code and scene files share them; scene files add the place to an error.

use super::quantity::Quantity;
use selvedge_core::glam::DVec3;

/// A value that is out of range or contradicts another one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{message}", if .of.is_empty() { String::new() } else { format!("{}: ", .of) })]
pub struct ValueError {
    /// The owner of the value: the name of an effect or a body, or `cloth`. Empty for the scene itself.
    pub of: String,
    /// The name of the value in scene files.
    pub field: &'static str,
    /// The error and its remedy, with units.
    pub message: String,
}

impl ValueError {
    /// Returns an error about a field. [`Scene::check`](crate::Scene::check) adds the owner.
    pub fn new(field: &'static str, message: impl Into<String>) -> Self {
        Self {
            of: String::new(),
            field,
            message: message.into(),
        }
    }

    pub(crate) fn with_owner(self, of: &str) -> Self {
        Self {
            of: of.to_owned(),
            ..self
        }
    }
}

/// A number with a name, a unit and a range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) quantity: Quantity,
    pub(crate) least: f64,
    pub(crate) most: f64,
    /// The end of the message about a value out of range.
    hint: &'static str,
}

impl Field {
    pub(crate) const fn new(name: &'static str, quantity: Quantity, least: f64, most: f64) -> Self {
        Self {
            name,
            quantity,
            least,
            most,
            hint: "",
        }
    }

    /// Adds a remedy to the message about a value out of range.
    pub(crate) const fn with_hint(self, hint: &'static str) -> Self {
        Self { hint, ..self }
    }

    /// Returns a field of three components, each at most `largest` in magnitude.
    pub(crate) const fn vector(name: &'static str, quantity: Quantity, largest: f64) -> Self {
        Self::new(name, quantity, -largest, largest)
    }

    /// Returns an error if the value is outside the range. NaN is in no range.
    pub(crate) fn check(&self, value: f64) -> Result<(), ValueError> {
        if (self.least..=self.most).contains(&value) {
            return Ok(());
        }
        let written = |value| self.quantity.written(value);
        let [is, least, most] = [value, self.least, self.most].map(written);
        let message = format!("`{}` is {is}, but must be from {least} to {most}{}", self.name, self.hint);
        Err(ValueError::new(self.name, message))
    }

    pub(crate) fn check_vector(&self, vector: DVec3) -> Result<(), ValueError> {
        vector.to_array().into_iter().try_for_each(|component| self.check(component))
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Count {
    pub(crate) name: &'static str,
    pub(crate) least: u32,
    pub(crate) most: u32,
}

impl Count {
    pub(crate) const fn new(name: &'static str, least: u32, most: u32) -> Self {
        Self { name, least, most }
    }

    pub(crate) fn check(&self, value: u32) -> Result<(), ValueError> {
        if (self.least..=self.most).contains(&value) {
            return Ok(());
        }
        Err(ValueError::new(self.name, self.complaint(&value.to_string())))
    }

    pub(crate) fn complaint(&self, found: &str) -> String {
        format!("`{}` is {found}, but must be from {} to {}", self.name, self.least, self.most)
    }
}
