//! Records a simulation for readers: its animation, and numbers of every step.
//!
//! A [`Recording`] does not depend on any simulator. A [`Recorder`] makes one while the simulation runs, in bounded memory:
//!
//! ```
//! use selvedge::glam::DVec3;
//! use selvedge_laboratory::report::{About, Knob, RecordedPart, PartKind, Recorder, SeriesKind, gltf, page};
//!
//! let about = About {
//!     name: "falling triangle".to_owned(),
//!     scene: "duration = \"20 ms\"\n".to_owned(),
//!     up: DVec3::Z,
//!     time_step: 0.01,
//!     unit: "step",
//!     fabric: vec![Knob::new("weight", "150 g/m²")],
//!     knobs: vec![Knob::new("time step", "10 ms")],
//! };
//! let cloth = RecordedPart::new("cloth", PartKind::Cloth, 3, vec![[0, 1, 2]]);
//! let series = [("candidates", SeriesKind::Pairs), ("gravity", SeriesKind::Effect)];
//! // Counters may run already, as after a checkpoint: their readings now.
//! let mut recorder = Recorder::new(about, vec![cloth], &series, &[0.0, 0.0]);
//! let mut positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
//! recorder.frame(0, &positions)?;
//! for step in 1..=2 {
//!     positions.iter_mut().for_each(|p| p.z -= 0.001);
//!     // Counters so far: 5 pairs and 3 µs each step.
//!     recorder.step(&[5.0 * step as f64, 3e-6 * step as f64]);
//!     recorder.frame(step, &positions)?;
//! }
//! let recording = recorder.finish(Some(1e-5));
//! assert_eq!((recording.steps, recording.frames.len()), (2, 3));
//! assert_eq!(recording.series[0].total, 10.0);
//!
//! let html: String = page::html(&recording);
//! let glb: Vec<u8> = gltf::binary(&recording)?;
//! # assert!(html.len() + glb.len() > 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod recorder;
mod shown;
mod simulated;
#[cfg(test)]
mod tests;
mod thinned;

pub use recorder::{Recorder, RecordingError};
pub use simulated::{SimulationRecorder, Subject, costs_of_added_effects};

use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// A recorded simulation, for reports.
///
/// It holds only the parts and effects that took part. An effect without a series appears in no table, chart or legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The scene and its settings.
    pub about: About,
    /// The moving parts, in the order of the vertices.
    pub parts: Vec<RecordedPart>,
    /// The animation in the order of time: at least one frame. The last is the end of the simulation.
    pub frames: Vec<RecordedFrame>,
    /// The number of recorded steps.
    pub steps: u64,
    /// The number of the first recorded step. It is not 1 if the simulation resumed from a checkpoint.
    pub first_step: u64,
    /// The number of steps of which each value of a series is the mean. The last value may be of fewer.
    pub steps_per_value: u64,
    /// The numbers of every step.
    pub series: Vec<Series>,
    /// The steps after which measures were taken, in the order of time. These are all offered frames, thinned out evenly if there
    /// are many.
    pub measured_steps: Vec<u64>,
    /// The quantities of the state.
    pub measures: Vec<Measure>,
    /// The wall-clock time of the steps, in seconds, if it is known.
    pub wall_seconds: Option<f64>,
    /// The cost of a step with no effect, with the first one, with the first two, and so on, if it was measured.
    pub added: Vec<Added>,
    /// Further sentences for readers, such as that the simulation was blocked or interrupted.
    pub remarks: Vec<String>,
}

/// A simulated scene and its settings.
#[derive(Clone, Debug, PartialEq)]
pub struct About {
    /// The scene's name.
    pub name: String,
    /// The scene file's text; empty if there is none.
    pub scene: String,
    /// The direction up in pictures, of any length, against gravity. If it is zero or not finite, z is up.
    pub up: DVec3,
    /// The time step, in seconds.
    pub time_step: f64,
    /// The word for what is recorded as a step: "step", or "frame" in a scene whose frames take several steps each.
    pub unit: &'static str,
    /// The properties of the fabric.
    pub fabric: Vec<Knob>,
    /// The settings that trade time for accuracy.
    pub knobs: Vec<Knob>,
}

#[cfg(test)]
impl About {
    /// Describes a scene without a file, without fabric and settings.
    pub(super) fn test(name: &str, up: DVec3, time_step: f64) -> Self {
        let (name, scene, fabric, knobs) = (name.to_owned(), String::new(), Vec::new(), Vec::new());
        Self {
            name,
            scene,
            up,
            time_step,
            unit: "step",
            fabric,
            knobs,
        }
    }
}

/// The cost of a step with some of the effects.
#[derive(Clone, Debug, PartialEq)]
pub struct Added {
    /// The effect added last, or "no effect" at first.
    pub name: String,
    /// The seconds per step, with all effects up to this one.
    pub seconds: f64,
}

/// A setting that trades time for accuracy, such as the time step, a thickness or a tolerance; or a property of the fabric.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Knob {
    /// Its name.
    pub name: String,
    /// Its value, with its unit.
    pub value: String,
}

impl Knob {
    /// Makes a setting from its name and its value, with its unit.
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            value: value.into(),
        }
    }
}

/// The kind of a [`RecordedPart`], which decides its look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartKind {
    /// A thin surface that is seen from both sides.
    Cloth,
    /// An obstacle.
    Body,
}

/// A moving mesh: a cloth or a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordedPart {
    name: String,
    kind: PartKind,
    vertex_count: usize,
    triangles: Vec<[u32; 3]>,
}

impl RecordedPart {
    /// Makes a mesh of `vertex_count` vertices, which its triangles number from 0.
    ///
    /// # Panics
    /// Panics if a triangle names a vertex that does not exist.
    pub fn new(name: impl Into<String>, kind: PartKind, vertex_count: usize, triangles: Vec<[u32; 3]>) -> Self {
        let is_there = |&vertex: &u32| (vertex as usize) < vertex_count;
        assert!(
            triangles.iter().flatten().all(is_there),
            "a triangle names a vertex that is not among the {vertex_count} of the part"
        );
        Self {
            name: name.into(),
            kind,
            vertex_count,
            triangles,
        }
    }

    /// Returns the name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the kind.
    pub fn kind(&self) -> PartKind {
        self.kind
    }

    /// Returns the number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// Returns the triangles; vertices count from 0 in each part.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
}

/// All positions at the end of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedFrame {
    /// The step, 0 for the start. The time is this many time steps.
    pub step: u64,
    /// Finite positions, rounded to f32, which suffices for pictures and glTF.
    pub positions: Vec<[f32; 3]>,
}

/// The kind of a [`Series`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesKind {
    /// The pairs that a stage leaves. The series has the name of the stage; series are in the order of the data flow.
    Pairs,
    /// Other counts: pairs repaired, vertices held, steps cut.
    Events,
    /// The seconds of an effect.
    Effect,
    /// The seconds of a stage that several effects share.
    Stage,
    /// The wall-clock seconds of the whole step.
    Step,
    /// A quantity of the state, such as the least distance or the largest strain, in this unit. The unit is empty for a pure
    /// number.
    Gauge(&'static str),
}

/// One number of every step.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name: that of the effect or the stage.
    pub name: String,
    /// Its kind.
    pub kind: SeriesKind,
    /// The means over [`steps_per_value`](Recording::steps_per_value) steps each.
    pub values: Vec<f32>,
    /// The sum over all steps.
    pub total: f64,
    /// The smallest value of any step; infinite without steps.
    pub smallest: f64,
    /// The largest value of any step; negative infinity without steps.
    pub largest: f64,
    /// The first step with the largest value.
    pub largest_step: u64,
}

/// The kind of a [`Measure`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeasureKind {
    /// A kind of energy, in J.
    Energy,
    /// The energy that an effect stores, in J, named after the effect.
    EffectEnergy,
    /// The lengths of edges relative to those at rest.
    Stretch,
    /// The force of the cloth on a body or on a group of pins or attachments, in N: the mean of the last step, or of the last
    /// frame in a scene by frames.
    Load,
}

/// The 99th percentile of edge lengths relative to those at rest.
pub(super) const EDGES_99: &str = "99 % of the edges";
/// The length of the most stretched edge relative to that at rest.
pub(super) const LONGEST_EDGE: &str = "longest edge";
pub(super) const GRAVITATIONAL: &str = "gravitational";

/// A quantity of the state that takes too long to compute in each step.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// The name.
    pub name: String,
    /// The kind.
    pub kind: MeasureKind,
    /// A value after each of the [`measured_steps`](Recording::measured_steps).
    pub values: Vec<f64>,
    /// The largest value ever measured; negative infinity without measurements.
    pub largest: f64,
    /// The first step with the largest value.
    pub largest_step: u64,
}

impl Recording {
    /// Returns the number of vertices of cloths and bodies.
    pub fn vertex_count(&self) -> usize {
        self.parts.iter().map(RecordedPart::vertex_count).sum()
    }

    /// Returns the time of a frame, in seconds.
    pub fn time(&self, frame: &RecordedFrame) -> f64 {
        self.end_of(frame.step)
    }

    /// Returns the frame nearest to a time, in seconds, or the first of two equally near ones.
    ///
    /// # Panics
    /// Panics if the recording has no frames. A [`Recorder`] never makes such a recording.
    pub fn frame_at(&self, seconds: f64) -> usize {
        let away = |&frame: &usize| (self.time(&self.frames[frame]) - seconds).abs();
        let frames = 0..self.frames.len();
        frames
            .min_by(|a, b| away(a).total_cmp(&away(b)))
            .expect("a recording has frames")
    }

    /// Returns the simulated duration of the recorded steps, in seconds.
    pub fn duration(&self) -> f64 {
        self.steps as f64 * self.about.time_step
    }

    /// Returns each part with the number of its first vertex among all.
    pub fn placed_parts(&self) -> impl Iterator<Item = (usize, &RecordedPart)> {
        let mut next = 0;
        self.parts.iter().map(move |part| {
            let first = next;
            next += part.vertex_count;
            (first, part)
        })
    }

    /// Returns all parts in one frame as one mesh, for [`mesh::write`](selvedge_files::mesh::write()).
    ///
    /// # Panics
    /// Panics if there is no such frame.
    pub fn mesh(&self, frame: usize) -> Mesh {
        let positions = self.frames[frame].positions.iter();
        let triangles = self.placed_parts().flat_map(|(first, part)| {
            let placed = move |triangle: &[u32; 3]| triangle.map(|vertex| first as u32 + vertex);
            part.triangles.iter().map(placed)
        });
        Mesh::new(
            positions.map(|p| DVec3::from(p.map(f64::from))).collect(),
            triangles.collect(),
        )
    }

    /// Returns the direction that is up, of length one.
    pub(super) fn up(&self) -> DVec3 {
        self.about.up.try_normalize().unwrap_or(DVec3::Z)
    }

    pub(super) fn measure(&self, name: &str) -> Option<&Measure> {
        self.measures.iter().find(|measure| measure.name == name)
    }

    /// Returns the measures of a kind, in their order.
    pub(super) fn measures_of(&self, wanted: MeasureKind) -> impl Iterator<Item = &Measure> {
        self.measures.iter().filter(move |measure| measure.kind == wanted)
    }

    /// Returns the time of a step's end, in seconds.
    pub(super) fn end_of(&self, step: u64) -> f64 {
        step as f64 * self.about.time_step
    }

    /// Returns the times of the whole steps, if they were recorded.
    pub(super) fn step_times(&self) -> Option<&Series> {
        self.series_of(|kind| kind == SeriesKind::Step)
            .next()
            .filter(|_| self.steps > 0)
    }

    /// Returns the series of a kind, in their order.
    pub(super) fn series_of(&self, wanted: impl Fn(SeriesKind) -> bool) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(move |series| wanted(series.kind))
    }
}
