//! Records a [`Simulation`].

use super::{About, Added, FrameError, Knob, Part, PartKind, Recorder, Recording, SeriesKind};
use crate::study::EffectCost;
use selvedge::Mesh;
use selvedge_cloth::{Scene, Simulation};

/// What a recording says of a scene, taken before a [`Simulation`] consumes it.
#[derive(Clone, Debug)]
pub struct Subject {
    about: About,
    parts: Vec<Part>,
}

/// What a step costs with each effect added, as measured: for a [`Recording`]'s `added`.
#[must_use]
pub fn costs_of_added_effects(costs: &[EffectCost]) -> Vec<Added> {
    let named = |cost: &EffectCost| Added {
        name: cost.added.unwrap_or("no effect").to_owned(),
        seconds: cost.seconds,
    };
    costs.iter().map(named).collect()
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
            knobs: { scene.settings().into_iter() }
                .map(|(name, value)| Knob::new(name, value))
                .collect(),
        };
        let part = |name: &str, kind, mesh: &Mesh| Part::new(name, kind, mesh.positions.len(), mesh.triangles.clone());
        let bodies = scene.bodies.iter();
        let bodies = bodies.map(|body| part(&body.name, PartKind::Body, &body.mesh));
        let mut parts = vec![part("cloth", PartKind::Cloth, scene.cloth.mesh())];
        parts.extend(bodies);
        Self { about, parts }
    }
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
        let counters = counters(simulation);
        let series: Vec<_> = counters.iter().map(|&(name, kind, _)| (name, kind)).collect();
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
        self.0.frame(simulation.steps_done(), simulation.positions())
    }

    /// All that has been recorded in `seconds` by the clock on the wall, as bytes.
    #[must_use]
    pub fn save(&self, seconds: f64) -> Vec<u8> {
        self.0.save(seconds)
    }

    /// Goes on with what another recorder of the same simulation has [saved](Self::save); returns its seconds. `None`, and nothing has
    /// changed, if the bytes are damaged, or of other series or another number of vertices.
    #[must_use]
    pub fn restore(&mut self, bytes: &[u8]) -> Option<f64> {
        self.0.restore(bytes)
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

/// All that a simulation counts and measures: a series each.
fn counters(simulation: &Simulation) -> Vec<(&'static str, SeriesKind, f64)> {
    let effects = simulation.effects().iter();
    let mut counters: Vec<_> = effects
        .map(|effect| (effect.name, SeriesKind::Effect, effect.seconds))
        .collect();
    let mut add = |kind, named: &[(&'static str, f64)]| {
        counters.extend(named.iter().map(|&(name, reading)| (name, kind, reading)));
    };
    let number = |(name, count)| (name, count as f64);
    if let Some(counts) = simulation.contact_counts() {
        add(SeriesKind::Pairs, &counts.pairs().map(number));
        add(SeriesKind::Events, &counts.events().map(number));
        let blocked = ("steps blocked", simulation.blocked_steps());
        add(SeriesKind::Events, &[blocked].map(number));
    }
    if let Some(seconds) = simulation.contact_seconds() {
        add(SeriesKind::Stage, &seconds.stages());
    }
    counters
}

/// In the order of the series.
fn readings(simulation: &Simulation) -> Vec<f64> {
    let counters = counters(simulation).into_iter();
    counters.map(|(_, _, reading)| reading).collect()
}
