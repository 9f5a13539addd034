//! The cloth simulation against laws with known answers: closed forms, and one published experiment.
//!
//! Each [`Law`] is a scene, its exact answer and the simulated one. [`measure`] runs it on a mesh with a time step. Where the
//! error of the time stepping is known in closed form too, samples have the value that the method must give, so that the rest of
//! the error shows.

mod bending;
mod falling;
mod membranes;
mod pinching;
mod resting;
mod setting;
mod sliding;
mod swinging;
#[cfg(test)]
mod tests;

use std::error::Error;
use std::time::Instant;

type Failure = Box<dyn Error + Send + Sync>;

/// The time steps at which laws are measured, in seconds.
pub const STEPS: [f64; 3] = [1e-3, 2e-3, 4e-3];

/// All laws, in the order of reports.
pub const LAWS: [&Law; 21] = [
    &falling::FREE_FALL,
    &falling::TERMINAL_SPEED,
    &falling::MOMENTUM,
    &swinging::SPRING,
    &swinging::ENERGY,
    &swinging::PENDULUM,
    &membranes::HANGING_CHAIN,
    &membranes::CATENARY,
    &membranes::OWN_WEIGHT,
    &membranes::BALLOON,
    &bending::CANTILEVER,
    &bending::PLATE,
    &bending::DRAPE,
    &sliding::INCLINED_PLANE,
    &sliding::COULOMB,
    &sliding::CAPSTAN,
    &resting::LANDING,
    &resting::STACK_HEIGHT,
    &resting::STACK_SPEED,
    &pinching::PINCH,
    &pinching::PINCH_SPEED,
];

/// A law, and the scene that must obey it.
#[derive(Debug)]
pub struct Law {
    /// The name on the command line: lower case with underscores.
    pub name: &'static str,
    /// The law in words, and its formula.
    pub statement: &'static str,
    /// The names of the two axes of samples, with units.
    pub axes: [&'static str; 2],
    /// The quantity that errors are a share of, or the unit of absolute errors.
    pub error: ErrorUnit,
    /// The meaning of the mesh's number.
    pub mesh: &'static str,
    /// The meshes at which the law is measured, from coarse to fine.
    pub meshes: &'static [u32],
    /// The reason for the error, as far as it is known.
    pub remark: &'static str,
    simulate: fn(u32, f64) -> Result<Outcome, Failure>,
}

/// The meaning of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorUnit {
    /// A share of this quantity.
    Of(&'static str),
    /// An absolute error in this unit, where the exact value is zero.
    In(&'static str),
}

/// The two answers at one place of a law's first axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// The place on the first axis.
    pub at: f64,
    /// The law's value.
    pub exact: f64,
    /// The value that the time stepping must give on this mesh, if a closed form is known.
    pub predicted: Option<f64>,
    /// The simulation's value.
    pub simulated: f64,
    /// The simulated motion across the direction of the law, whose exact value is zero.
    pub aside: f64,
}

/// The samples of a run, and the size of its errors' unit.
#[derive(Debug)]
struct Outcome {
    samples: Vec<Sample>,
    scale: f64,
}

/// One run of a law.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The mesh's number.
    pub mesh: u32,
    /// The time step in seconds.
    pub step: f64,
    /// The samples, in the order of the first axis.
    pub samples: Vec<Sample>,
    /// The time of the run on one thread, in seconds.
    pub seconds: f64,
    scale: f64,
}

impl Measured {
    /// Returns the largest difference between the simulation and the law, in the law's [unit](Law::error).
    #[must_use]
    pub fn error(&self) -> f64 {
        self.largest(|sample| Some(sample.exact)).unwrap_or(f64::NAN)
    }

    /// Returns the largest difference between the simulation and the known values of its time stepping, if they are known.
    #[must_use]
    pub fn unpredicted(&self) -> Option<f64> {
        self.largest(|sample| sample.predicted)
    }

    /// Returns the sample with the largest error.
    #[must_use]
    pub fn worst(&self) -> Sample {
        let error = |sample: &Sample| (sample.simulated - sample.exact).hypot(sample.aside);
        let worst = self.samples.iter().max_by(|a, b| error(a).total_cmp(&error(b)));
        worst.copied().unwrap_or_default()
    }

    fn largest(&self, expected: impl Fn(&Sample) -> Option<f64>) -> Option<f64> {
        let errors = self.samples.iter().filter_map(|sample| {
            let along = sample.simulated - expected(sample)?;
            Some(along.hypot(sample.aside) / self.scale)
        });
        errors.reduce(|a, b| if a >= b { a } else { b })
    }
}

/// Runs a law on one mesh with one time step, in seconds, on one thread.
///
/// # Errors
/// Returns an error if the law's scene cannot be set up, or if a step is blocked.
pub fn measure(law: &Law, mesh: u32, step: f64) -> Result<Measured, Failure> {
    let begin = Instant::now();
    let Outcome { samples, scale } = (law.simulate)(mesh, step)?;
    Ok(Measured {
        mesh,
        step,
        samples,
        seconds: begin.elapsed().as_secs_f64(),
        scale,
    })
}

/// A law, and its runs: for each mesh, from coarse to fine, each of [`STEPS`].
#[derive(Clone, Debug)]
pub struct LawRuns {
    /// The law.
    pub law: &'static Law,
    /// The runs.
    pub runs: Vec<Measured>,
}

impl LawRuns {
    /// Runs a law on all its meshes with all [`STEPS`]. Calls `progress` with the number of finished runs after each.
    ///
    /// # Errors
    /// As [`measure`].
    pub fn measure(law: &'static Law, progress: &mut dyn FnMut(usize)) -> Result<Self, Failure> {
        let mut runs = Vec::with_capacity(law.runs());
        for &mesh in law.meshes {
            for step in STEPS {
                runs.push(measure(law, mesh, step).map_err(|error| format!("{}: {error}", law.name))?);
                progress(runs.len());
            }
        }
        Ok(Self { law, runs })
    }

    /// Returns the runs on each mesh, from coarse to fine.
    pub fn by_mesh(&self) -> impl DoubleEndedIterator<Item = &[Measured]> {
        self.runs.chunks(STEPS.len())
    }
}

impl Law {
    /// Returns the number of runs of [`LawRuns::measure`].
    #[must_use]
    pub const fn runs(&self) -> usize {
        self.meshes.len() * STEPS.len()
    }
}
