//! A simulation that advances at the pace of its conditions.

use super::conditions::{Conditions, Pace};
use super::{Failure, Sample};
use selvedge_cloth::{Scene, Simulation};
use std::ops::{Deref, DerefMut};

const SAMPLES: u32 = 20;

/// A simulation and its pace. It remembers the lengths of its steps.
pub(super) struct Run {
    simulation: Simulation,
    pace: Pace,
    steps: Vec<f64>,
}

impl Deref for Run {
    type Target = Simulation;

    fn deref(&self) -> &Simulation {
        &self.simulation
    }
}

impl DerefMut for Run {
    fn deref_mut(&mut self) -> &mut Simulation {
        &mut self.simulation
    }
}

impl Run {
    /// Sets up a scene on one thread.
    pub(super) fn new(mut scene: Scene, conditions: &Conditions) -> Result<Self, Failure> {
        scene.time_step = conditions.pace.time_step();
        scene.accuracy = conditions.accuracy;
        Ok(Self {
            simulation: Simulation::new(scene, 1)?,
            pace: conditions.pace,
            steps: Vec::new(),
        })
    }

    /// Makes a step or a frame.
    pub(super) fn tick(&mut self) -> Result<(), Failure> {
        match self.pace {
            Pace::Steps(seconds) => {
                self.simulation.step()?;
                self.steps.push(seconds);
            }
            Pace::Frames => {
                let steps = self.simulation.advance(Pace::FRAME)?.steps;
                let step = Pace::FRAME / f64::from(steps);
                self.steps.extend((0..steps).map(|_| step));
            }
        }
        Ok(())
    }

    /// Returns the lengths of all steps so far, in seconds.
    pub(super) fn steps(&self) -> &[f64] {
        &self.steps
    }

    /// Advances to about a time, in seconds.
    pub(super) fn advance_to(&mut self, time: f64) -> Result<(), Failure> {
        self.watch_to(time, |_| ())
    }

    /// Advances to about a time, in seconds. Calls `see` with every state that a user sees on the way.
    pub(super) fn watch_to(&mut self, time: f64, mut see: impl FnMut(&Simulation)) -> Result<(), Failure> {
        while self.time() < time - 0.5 * self.pace.seconds() {
            self.tick()?;
            see(&self.simulation);
        }
        Ok(())
    }

    /// Advances by about `span` seconds, and returns twenty samples. `answer` takes the run, and the time since the call.
    pub(super) fn over_time(&mut self, span: f64, mut answer: impl FnMut(&Self, f64) -> Sample) -> Result<Vec<Sample>, Failure> {
        let start = self.time();
        let mut samples = Vec::with_capacity(SAMPLES as usize);
        for k in 1..=SAMPLES {
            self.advance_to(start + span * f64::from(k) / f64::from(SAMPLES))?;
            let time = self.time() - start;
            samples.push(Sample {
                at: time,
                ..answer(self, time)
            });
        }
        Ok(samples)
    }
}
