//! What a simulation looked like, frame by frame: for animations and reports.

use super::simulator::{EffectTime, Simulation};
use super::{ContactCounts, ContactSeconds};

/// One frame, and what happened since the one before.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// In seconds.
    pub time: f64,
    /// Of all vertices, the cloth's first.
    pub positions: Vec<[f32; 3]>,
    /// Steps since the frame before.
    pub steps: u64,
    /// What contact counted since then.
    pub contact: ContactCounts,
    /// Seconds that it took since then, effect by effect and then stage by stage, as [`Recording::timed`] names them.
    pub seconds: Vec<f64>,
}

/// A whole simulation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// The scene's name.
    pub name: String,
    /// The cloth's, then the bodies'.
    pub triangles: Vec<[u32; 3]>,
    /// How many of the triangles are the cloth's.
    pub cloth_triangles: usize,
    /// What took time: the scene's effects, then, if it has contact, the stages that contact effects share.
    pub timed: Vec<&'static str>,
    /// Whether an effect of the scene looks for contact.
    pub has_contact: bool,
    /// The start is the first.
    pub frames: Vec<Frame>,
    /// Totals at the last frame.
    last: Totals,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Totals {
    steps: u64,
    contact: ContactCounts,
    seconds: Vec<f64>,
}

/// The stages that contact effects share.
const STAGES: [&str; 4] = [
    "candidate pairs",
    "contact set-up",
    "certificates",
    "repairs",
];

impl Recording {
    /// Begins with the state that the simulation is in.
    #[must_use]
    pub fn new(simulation: &Simulation) -> Self {
        let effects = simulation.effects().iter().map(|effect| effect.name);
        let has_contact = simulation.contact_counts().is_some();
        let stages = STAGES.into_iter().filter(|_| has_contact);
        let mut recording = Self {
            name: simulation.name().to_owned(),
            triangles: simulation.triangles().to_vec(),
            cloth_triangles: simulation.cloth_triangles(),
            timed: effects.chain(stages).collect(),
            has_contact,
            frames: Vec::new(),
            last: totals(simulation),
        };
        recording.add(simulation);
        recording
    }

    /// Adds a frame.
    pub fn add(&mut self, simulation: &Simulation) {
        let now = totals(simulation);
        let seconds = now.seconds.iter().zip(&self.last.seconds);
        self.frames.push(Frame {
            time: simulation.time(),
            positions: simulation
                .positions()
                .iter()
                .map(|p| p.as_vec3().to_array())
                .collect(),
            steps: now.steps - self.last.steps,
            contact: now.contact.since(&self.last.contact),
            seconds: seconds.map(|(now, then)| now - then).collect(),
        });
        self.last = now;
    }

    /// What each entry of [`timed`](Self::timed) took in all frames.
    #[must_use]
    pub fn total_seconds(&self) -> Vec<f64> {
        let mut totals = vec![0.0; self.timed.len()];
        for frame in &self.frames {
            for (total, seconds) in totals.iter_mut().zip(&frame.seconds) {
                *total += seconds;
            }
        }
        totals
    }
}

fn totals(simulation: &Simulation) -> Totals {
    let effects = simulation
        .effects()
        .iter()
        .map(|effect: &EffectTime| effect.seconds);
    let stages = simulation.contact_seconds().map(|seconds| {
        let &ContactSeconds {
            candidates,
            rows,
            certificates,
            repairs,
        } = seconds;
        [candidates, rows, certificates, repairs]
    });
    Totals {
        steps: simulation.steps_done(),
        contact: simulation.contact_counts().copied().unwrap_or_default(),
        seconds: effects.chain(stages.into_iter().flatten()).collect(),
    }
}
