//! The energy of a state, computed on request and never in a step.
//!
//! Kinematic vertices have no part in it, since their motion is prescribed. So a simulation's energy falls by friction, drag,
//! contacts, strain limits and the implicit steps. It rises by the work of moving bodies and pins, wind, and effects that report
//! no energy.

use selvedge_core::glam::DVec3;

/// The positions and masses for which effects compute their energy.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// Positions in metres: the cloth's vertices, then the bodies'.
    pub positions: &'a [DVec3],
    /// Inverse masses per vertex, in 1/kg; zero for kinematic vertices.
    pub inverse_masses: &'a [f64],
}

/// Energy that an effect stores and can return as motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StoredEnergy {
    /// Potential energy of weight, in J; zero at the scene's origin, and negative below it.
    Gravitational(f64),
    /// Energy of stretch, compression and bending, in J; zero at rest, never negative.
    Elastic(f64),
}

impl StoredEnergy {
    /// Returns the energy in J.
    #[must_use]
    pub const fn joules(self) -> f64 {
        match self {
            Self::Gravitational(joules) | Self::Elastic(joules) => joules,
        }
    }
}

/// The energy of a state of the cloth: see [`Simulation::energy`](crate::Simulation::energy).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Energy {
    /// The kinetic energy of free vertices, in J.
    pub kinetic: f64,
    /// The stored energy of each effect, by name, in the order in which effects run. Effects without stored energy are missing.
    pub stored: Vec<(&'static str, StoredEnergy)>,
}

impl Energy {
    /// Returns the kinetic energy of free vertices with these velocities, in m/s.
    pub(crate) fn of_motion(inverse_masses: &[f64], velocities: &[DVec3]) -> Self {
        let free = inverse_masses.iter().zip(velocities).filter(|(inverse, _)| **inverse > 0.0);
        let each = free.map(|(inverse, velocity)| 0.5 * velocity.length_squared() / inverse);
        Self {
            kinetic: each.sum(),
            stored: Vec::new(),
        }
    }

    pub(crate) fn add(&mut self, effect: &'static str, more: StoredEnergy) {
        use StoredEnergy::{Elastic, Gravitational};
        for (name, stored) in &mut self.stored {
            if let (Elastic(own), Elastic(more)) | (Gravitational(own), Gravitational(more)) = (stored, more)
                && *name == effect
            {
                *own += more;
                return;
            }
        }
        self.stored.push((effect, more));
    }

    /// Returns the potential energy of weight, in J; `None` if no effect reports any.
    #[must_use]
    pub fn gravitational(&self) -> Option<f64> {
        self.sum(|stored| matches!(stored, StoredEnergy::Gravitational(_)))
    }

    /// Returns the energy of stretch, compression and bending, in J; `None` if no effect reports any.
    #[must_use]
    pub fn elastic(&self) -> Option<f64> {
        self.sum(|stored| matches!(stored, StoredEnergy::Elastic(_)))
    }

    /// Returns the total energy, in J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.sum(|_| true).unwrap_or(0.0)
    }

    fn sum(&self, wanted: impl Fn(StoredEnergy) -> bool) -> Option<f64> {
        let stored = self.stored.iter().map(|&(_, stored)| stored);
        stored
            .filter(|&stored| wanted(stored))
            .map(StoredEnergy::joules)
            .reduce(|a, b| a + b)
    }
}
