//! The energy of a state. It is worked out when somebody asks, never in a step.
//!
//! What moves with a body or a pin has no part in it: its motion is given, and whatever drives it has as much energy as it takes.
//! So a simulation's energy falls by what friction, drag, contacts, strain limits and the implicit steps take, and rises by the work that
//! moving bodies and pins, wind, and effects that tell no energy do on the cloth.

use selvedge_core::glam::DVec3;

/// Where everything is, for whoever tells an energy by it.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// In metres: the cloth's vertices, then the bodies'.
    pub positions: &'a [DVec3],
    /// Per vertex, in 1/kg; zero where it is kinematic.
    pub inverse_masses: &'a [f64],
}

/// Energy that an effect holds, and gives back as motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StoredEnergy {
    /// Of weight, in J; zero at the scene's origin, and negative below it.
    Gravitational(f64),
    /// Of what is stretched, bent or pressed together, in J; not negative, and zero at rest.
    Elastic(f64),
}

impl StoredEnergy {
    /// In J.
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
    /// Of the motion of its free vertices, in J.
    pub kinetic: f64,
    /// What effects hold, by their names, in the order in which they run. Effects that hold none are not in it.
    pub stored: Vec<(&'static str, StoredEnergy)>,
}

impl Energy {
    /// Of free vertices with these velocities, in m/s.
    pub(crate) fn of_motion(inverse_masses: &[f64], velocities: &[DVec3]) -> Self {
        let free = inverse_masses.iter().zip(velocities).filter(|(inverse, _)| **inverse > 0.0);
        let each = free.map(|(inverse, velocity)| 0.5 * velocity.length_squared() / inverse);
        Self {
            kinetic: each.sum(),
            stored: Vec::new(),
        }
    }

    /// Adds what an effect holds, to what it was said to hold already.
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

    /// Of weight, in J; `None` if no effect tells any.
    #[must_use]
    pub fn gravitational(&self) -> Option<f64> {
        self.sum(|stored| matches!(stored, StoredEnergy::Gravitational(_)))
    }

    /// Of all that is stretched, bent or pressed together, in J; `None` if no effect tells any.
    #[must_use]
    pub fn elastic(&self) -> Option<f64> {
        self.sum(|stored| matches!(stored, StoredEnergy::Elastic(_)))
    }

    /// All of it, in J.
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
