//! The cloth simulation against laws with known answers: closed forms, and one published experiment.
//!
//! Each [`Law`] is a scene, its exact answer and the simulated one. [`measure`] runs it on a mesh with a time step. Where the
//! error of the time stepping is known in closed form too, samples have the value that the method must give, so that the rest of
//! the error shows.

mod bending;
mod blowing;
mod carrying;
mod conditions;
mod falling;
mod forms;
mod inflating;
mod limiting;
mod membranes;
mod pinching;
mod resting;
mod run;
mod setting;
mod sliding;
mod stepping;
mod swinging;
#[cfg(test)]
mod tests;

pub use conditions::{Conditions, Grid, PACES, Pace};

use selvedge_cloth::Accuracy;
use std::error::Error;
use std::time::Instant;

type Failure = Box<dyn Error + Send + Sync>;

/// All laws, in the order of reports.
pub const LAWS: &[&Law] = &[
    &falling::FREE_FALL,
    &falling::TERMINAL_SPEED,
    &falling::MOMENTUM,
    &swinging::SPRING,
    &swinging::ENERGY,
    &swinging::PENDULUM,
    &membranes::HANGING_CHAIN,
    &membranes::CATENARY,
    &membranes::OWN_WEIGHT,
    &inflating::BALLOON,
    &inflating::LIGHT_BALLOON,
    &inflating::FOIL_BALLOON,
    &inflating::LATEX_BALLOON,
    &inflating::BALLOON_SPEED,
    &inflating::GAS,
    &inflating::PILLOW,
    &inflating::HALF_BALLOON,
    &blowing::SAIL,
    &blowing::AIR_SPEED,
    &carrying::CORD_LOAD,
    &carrying::CORD_SWING,
    &carrying::CORD_PERIOD,
    &carrying::HEAVY_STRIP,
    &carrying::HEAVY_PATCH,
    &limiting::STRAIN_LIMIT,
    &limiting::LONGEST_EDGE,
    &limiting::JERK,
    &limiting::TAUT,
    &limiting::JERK_ON_LIMIT,
    &bending::CANTILEVER,
    &bending::PLATE,
    &bending::DRAPE,
    &sliding::INCLINED_PLANE,
    &sliding::COULOMB,
    &sliding::CAPSTAN,
    &resting::LANDING,
    &resting::STACK_HEIGHT,
    &resting::STACK_SPEED,
    &resting::TALL_STACK_HEIGHT,
    &resting::TALL_STACK_SPEED,
    &resting::BAG_SPEED,
    &pinching::PINCH,
    &pinching::PINCH_SPEED,
];

/// A law, and the scene that must obey it. Scenes use default settings.
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
    /// The meaning of a mesh's number.
    pub mesh: &'static str,
    /// The meshes at which the law is measured, from coarse to fine.
    pub meshes: &'static [Grid],
    /// The reason for the error, as far as it is known.
    pub remark: &'static str,
    simulate: fn(&Conditions) -> Result<Outcome, Failure>,
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
    /// The conditions of the run.
    pub conditions: Conditions,
    /// The samples, in the order of the first axis. There are none if the run failed.
    pub samples: Vec<Sample>,
    /// The reason why the run did not reach its end, if it did not.
    pub failure: Option<String>,
    /// The time of the run on one thread, in seconds.
    pub seconds: f64,
    scale: f64,
}

impl Measured {
    /// Returns the largest difference between the simulation and the law, in the law's [unit](Law::error). It is NaN if the run
    /// failed, or if its result is not a number.
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
        errors.reduce(|a, b| if a >= b || a.is_nan() { a } else { b })
    }
}

/// Runs a law under conditions on one thread.
#[must_use]
pub fn measure(law: &Law, conditions: Conditions) -> Measured {
    let begin = Instant::now();
    let (outcome, failure) = match (law.simulate)(&conditions) {
        Ok(outcome) => (outcome, None),
        Err(failure) => {
            let (samples, scale) = (Vec::new(), 1.0);
            (Outcome { samples, scale }, Some(failure.to_string()))
        }
    };
    Measured {
        conditions,
        samples: outcome.samples,
        failure,
        seconds: begin.elapsed().as_secs_f64(),
        scale: outcome.scale,
    }
}

/// The runs to make of each law.
#[derive(Clone, Debug)]
pub struct Extent {
    /// The paces.
    pub paces: Vec<Pace>,
    /// The accuracies.
    pub accuracies: Vec<Accuracy>,
    /// Whether each law has its coarsest mesh only.
    pub is_coarse: bool,
}

impl Extent {
    /// Returns the meshes of a law, from coarse to fine.
    #[must_use]
    pub fn meshes(&self, law: &Law) -> &'static [Grid] {
        &law.meshes[..if self.is_coarse { 1 } else { law.meshes.len() }]
    }

    /// Returns the number of runs of a law.
    #[must_use]
    pub fn runs(&self, law: &Law) -> usize {
        self.meshes(law).len() * self.accuracies.len() * self.paces.len()
    }
}

/// A law, and its runs: for each mesh, from coarse to fine, each accuracy at each pace.
#[derive(Clone, Debug)]
pub struct LawRuns {
    /// The law.
    pub law: &'static Law,
    /// The runs.
    pub runs: Vec<Measured>,
    paces: usize,
    accuracies: usize,
}

impl LawRuns {
    /// Runs a law. Calls `progress` with the number of finished runs after each.
    pub fn measure(law: &'static Law, extent: &Extent, progress: &mut dyn FnMut(usize)) -> Self {
        let mut runs = Vec::with_capacity(extent.runs(law));
        for &grid in extent.meshes(law) {
            for &accuracy in &extent.accuracies {
                for &pace in &extent.paces {
                    runs.push(measure(law, Conditions { grid, accuracy, pace }));
                    progress(runs.len());
                }
            }
        }
        Self {
            law,
            runs,
            paces: extent.paces.len(),
            accuracies: extent.accuracies.len(),
        }
    }

    /// Returns the runs on each mesh, from coarse to fine.
    pub fn by_mesh(&self) -> impl DoubleEndedIterator<Item = &[Measured]> {
        self.runs.chunks(self.paces * self.accuracies)
    }

    /// Returns the runs on each mesh at each accuracy: one at each pace.
    pub fn by_accuracy(&self) -> impl Iterator<Item = &[Measured]> {
        self.runs.chunks(self.paces)
    }
}
