//! Records a [`Simulation`].

use super::{About, FrameError, Knob, Part, PartKind, Recorder, Recording, SeriesKind};
use crate::mesh::Mesh;
use crate::report::number;
use crate::simulation::{ContactCounts, ContactSeconds, Scene, Simulation};
use toml::de::{DeTable, DeValue};

/// What contact counts, in the order of the data flow.
const PAIRS: [&str; 3] = [
    "candidate pairs",
    "not settled by remembered directions",
    "not free, repaired",
];
const EVENTS: [&str; 4] = [
    "pairs pushed apart",
    "vertices held",
    "steps cut in half",
    "steps blocked",
];
/// The stages that contact effects share.
const STAGES: [&str; 4] = [
    "candidate pairs",
    "contact set-up",
    "certificates",
    "repairs",
];
/// Settings of effects that trade time for accuracy.
const KNOBS: [&str; 3] = ["thickness", "separation", "sweeps"];

/// What a recording says of a scene, taken before a [`Simulation`] consumes it.
#[derive(Clone, Debug)]
pub struct Subject {
    about: About,
    parts: Vec<Part>,
}

impl Subject {
    /// The scene's text, its up direction, its cloth and its bodies, each a part of its own.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let about = About {
            name: scene.name.clone(),
            scene: scene.text.clone(),
            up: scene.up,
            time_step: scene.time_step,
            knobs: knobs(scene),
        };
        let part = |name: &str, kind, mesh: &Mesh| {
            Part::new(name, kind, mesh.positions.len(), mesh.triangles.clone())
        };
        let bodies = scene.bodies.iter();
        let bodies = bodies.map(|body| part(&body.name, PartKind::Body, &body.mesh));
        let mut parts = vec![part("cloth", PartKind::Cloth, &scene.cloth.mesh)];
        parts.extend(bodies);
        Self { about, parts }
    }
}

/// The time step, and settings of effects as the scene writes them.
fn knobs(scene: &Scene) -> Vec<Knob> {
    let mut knobs = vec![Knob::new("time step", number::time(scene.time_step))];
    let root = DeTable::parse(&scene.text);
    let effects = root
        .as_ref()
        .ok()
        .and_then(|root| root.get_ref().get("effects"));
    let Some(DeValue::Table(effects)) = effects.map(|effects| effects.get_ref()) else {
        return knobs;
    };
    for (effect, settings) in effects {
        let DeValue::Table(settings) = settings.get_ref() else {
            continue;
        };
        for name in KNOBS {
            let value = match settings.get(name).map(|value| value.get_ref()) {
                Some(DeValue::String(text)) => text.to_string(),
                Some(DeValue::Integer(number)) => number.to_string(),
                Some(DeValue::Float(number)) => number.to_string(),
                _ => continue,
            };
            knobs.push(Knob::new(format!("{}: {name}", effect.get_ref()), value));
        }
    }
    knobs
}

/// A [`Recorder`] of a simulation: its effects, and its contacts if it looks for them, are the series.
#[derive(Debug)]
pub struct SimulationRecorder(Recorder);

impl SimulationRecorder {
    /// Begins with the state and the counters that the simulation of `subject`'s scene has now.
    ///
    /// # Errors
    /// If a coordinate is no finite `f32`.
    ///
    /// # Panics
    /// If the simulation is of another scene, with another number of vertices.
    pub fn new(subject: Subject, simulation: &Simulation) -> Result<Self, FrameError> {
        let effects = simulation.effects().iter();
        let mut series: Vec<_> = effects
            .map(|effect| (effect.name, SeriesKind::Effect))
            .collect();
        if simulation.contact_counts().is_some() {
            series.extend(PAIRS.map(|name| (name, SeriesKind::Pairs)));
            series.extend(EVENTS.map(|name| (name, SeriesKind::Events)));
            series.extend(STAGES.map(|name| (name, SeriesKind::Stage)));
        }
        let Subject { about, parts } = subject;
        let recorder = Recorder::new(about, parts, &series, &readings(simulation));
        let mut recorder = Self(recorder);
        recorder.frame(simulation)?;
        Ok(recorder)
    }

    /// Records what the last step counted and took.
    pub fn step(&mut self, simulation: &Simulation) {
        self.0.step(&readings(simulation));
    }

    /// Offers the state as a frame.
    ///
    /// # Errors
    /// If a coordinate is no finite `f32`.
    pub fn frame(&mut self, simulation: &Simulation) -> Result<(), FrameError> {
        self.0
            .frame(simulation.steps_done(), simulation.positions())
    }

    /// Says something that a reader must know.
    pub fn remark(&mut self, sentence: impl Into<String>) {
        self.0.remark(sentence);
    }

    /// Ends the recording of steps that took `seconds` by the clock on the wall.
    #[must_use]
    pub fn finish(self, seconds: f64) -> Recording {
        self.0.finish(Some(seconds))
    }
}

/// The counters' readings, in the order of the series.
fn readings(simulation: &Simulation) -> Vec<f64> {
    let effects = simulation.effects().iter();
    let mut readings: Vec<f64> = effects.map(|effect| effect.seconds).collect();
    if let (Some(counts), Some(seconds)) =
        (simulation.contact_counts(), simulation.contact_seconds())
    {
        let &ContactCounts {
            candidates,
            looked_at,
            pushed,
            violated,
            held,
            cuts,
            ..
        } = counts;
        let blocked = simulation.blocked_steps();
        let counted = [candidates, looked_at, violated, pushed, held, cuts, blocked];
        readings.extend(counted.map(|count| count as f64));
        let &ContactSeconds {
            candidates,
            rows,
            certificates,
            repairs,
        } = seconds;
        readings.extend([candidates, rows, certificates, repairs]);
    }
    readings
}
