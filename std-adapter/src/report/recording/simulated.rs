//! Records a [`Simulation`].

use super::{About, FrameError, Knob, Part, PartKind, Recorder, Recording, SeriesKind};
use crate::report::number;
use crate::simulation::{ContactCounts, ContactSeconds, Simulation};
use selvedge_core::glam::DVec3;

/// What contact counts, in the order of the data flow.
const PAIRS: [&str; 4] = [
    "candidate pairs",
    "not settled by remembered directions",
    "pushed apart",
    "not free, repaired",
];
const EVENTS: [&str; 2] = ["vertices held", "steps cut in half"];
/// The stages that contact effects share.
const STAGES: [&str; 4] = [
    "candidate pairs",
    "contact set-up",
    "certificates",
    "repairs",
];

/// A [`Recorder`] of a simulation: its effects, and its contacts if it looks for them, are the series.
#[derive(Debug)]
pub struct SimulationRecorder(Recorder);

impl SimulationRecorder {
    /// Begins with the state that the simulation is in. `scene` is the text of its file.
    ///
    /// # Errors
    /// If a coordinate is no finite `f32`.
    pub fn new(
        simulation: &Simulation,
        scene: impl Into<String>,
        time_step: f64,
    ) -> Result<Self, FrameError> {
        let effects = simulation.effects().iter();
        let mut series: Vec<_> = effects
            .map(|effect| (effect.name, SeriesKind::Effect))
            .collect();
        if simulation.contact_counts().is_some() {
            series.extend(PAIRS.map(|name| (name, SeriesKind::Pairs)));
            series.extend(EVENTS.map(|name| (name, SeriesKind::Events)));
            series.extend(STAGES.map(|name| (name, SeriesKind::Stage)));
        }
        let about = About {
            name: simulation.name().to_owned(),
            scene: scene.into(),
            up: DVec3::Z,
            time_step,
            knobs: vec![Knob::new("time step", number::time(time_step))],
        };
        let recorder = Recorder::new(about, parts(simulation), &series, &readings(simulation));
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

/// The cloth, and all bodies.
fn parts(simulation: &Simulation) -> Vec<Part> {
    let first_body = simulation.cloth_vertices() as u32;
    let (cloth, bodies) = simulation
        .triangles()
        .split_at(simulation.cloth_triangles());
    let cloth = Part::new(
        "cloth",
        PartKind::Cloth,
        first_body as usize,
        cloth.to_vec(),
    );
    let body_vertices = simulation.positions().len() - first_body as usize;
    let of_bodies = |triangle: &[u32; 3]| triangle.map(|vertex| vertex - first_body);
    let bodies = (body_vertices > 0).then(|| {
        let triangles = bodies.iter().map(of_bodies).collect();
        Part::new("bodies", PartKind::Body, body_vertices, triangles)
    });
    [Some(cloth), bodies].into_iter().flatten().collect()
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
        let counted = [candidates, looked_at, pushed, violated, held, cuts];
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
