//! What a simulation leaves behind for people to look at: its animation, and figures of every step.
//!
//! A [`Recording`] knows nothing of any simulator. A [`Recorder`] makes one while the simulation runs, in bounded memory:
//!
//! ```
//! use selvedge::glam::DVec3;
//! use selvedge_laboratory::report::{About, Knob, Part, PartKind, Recorder, SeriesKind, gltf, page};
//!
//! let about = About {
//!     name: "falling triangle".to_owned(),
//!     scene: "duration = \"20 ms\"\n".to_owned(),
//!     up: DVec3::Z,
//!     time_step: 0.01,
//!     fabric: vec![Knob::new("weight", "150 g/m²")],
//!     knobs: vec![Knob::new("time step", "10 ms")],
//! };
//! let cloth = Part::new("cloth", PartKind::Cloth, 3, vec![[0, 1, 2]]);
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

pub use recorder::{FrameError, Recorder};
pub use simulated::{SimulationRecorder, Subject, costs_of_added_effects};

use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// A simulation, as it is remembered for reports.
///
/// Whatever did not take part is not in it: an effect without a series is in no table, no chart and no legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// What was simulated.
    pub about: About,
    /// What moves, in the order of the vertices.
    pub parts: Vec<Part>,
    /// The animation, at least one frame, in the order of time; the last is where the simulation ended.
    pub frames: Vec<Frame>,
    /// How many steps were recorded.
    pub steps: u64,
    /// The number of the first recorded step; not 1 if the simulation went on from a checkpoint.
    pub first_step: u64,
    /// How many steps each value of a series is the mean of. The last value may be of fewer.
    pub steps_per_value: u64,
    /// Figures of every step.
    pub series: Vec<Series>,
    /// After which steps measures were taken, in the order of time: at all frames that were offered, thinned out evenly if there are many.
    pub measured_steps: Vec<u64>,
    /// Quantities of the state.
    pub measures: Vec<Measure>,
    /// How long the steps took by the clock on the wall, in seconds, if it is known.
    pub wall_seconds: Option<f64>,
    /// What a step costs with the first of the effects, with the first two, and so on, if that was measured.
    pub added: Vec<Added>,
    /// What else a reader must know, a sentence each: where the simulation was blocked, that it was interrupted.
    pub remarks: Vec<String>,
}

/// What was simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct About {
    /// The scene's name.
    pub name: String,
    /// The scene file's text; empty if there is none.
    pub scene: String,
    /// The direction that is up in the pictures, of any length: against gravity. Where it has none (zero, not finite), z is up.
    pub up: DVec3,
    /// The time step, in seconds.
    pub time_step: f64,
    /// What the cloth is made of.
    pub fabric: Vec<Knob>,
    /// What trades time for accuracy.
    pub knobs: Vec<Knob>,
}

/// What a step costs with some of the effects.
#[derive(Clone, Debug, PartialEq)]
pub struct Added {
    /// The effect that was added last; "no effect" to begin with.
    pub name: String,
    /// Seconds a step, with all up to this one.
    pub seconds: f64,
}

/// A setting: one that trades time for accuracy, such as the time step, a thickness or a tolerance; or a property of the fabric.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Knob {
    /// What it is called.
    pub name: String,
    /// Its value, with its unit.
    pub value: String,
}

impl Knob {
    /// A setting and its value, with its unit.
    #[must_use]
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            value: value.into(),
        }
    }
}

/// What a [`Part`] is, which decides on its looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartKind {
    /// Thin, seen from both sides.
    Cloth,
    /// What the cloth meets.
    Body,
}

/// A mesh that moves: the cloth, or a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    name: String,
    kind: PartKind,
    vertex_count: usize,
    triangles: Vec<[u32; 3]>,
}

impl Part {
    /// A mesh of `vertex_count` vertices; its triangles number them from 0.
    ///
    /// # Panics
    /// If a triangle names a vertex that does not exist.
    #[must_use]
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

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is.
    #[must_use]
    pub fn kind(&self) -> PartKind {
        self.kind
    }

    /// How many vertices it has.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// Its triangles; vertices count from 0 in each part.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
}

/// All positions at the end of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// The step, 0 for the start. Its time is this many time steps.
    pub step: u64,
    /// Finite; rounded to f32, which is what pictures and glTF need.
    pub positions: Vec<[f32; 3]>,
}

/// What a [`Series`] counts or measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesKind {
    /// Pairs that a stage leaves, named after the stage; in the order of the data flow.
    Pairs,
    /// What else is counted: pairs repaired, vertices held, steps cut.
    Events,
    /// Seconds of an effect.
    Effect,
    /// Seconds of a stage that several effects share.
    Stage,
    /// Seconds of the whole step, by the clock on the wall.
    Step,
    /// A quantity of the state, in this unit (empty for a pure number): the least distance, the largest strain.
    Gauge(&'static str),
}

/// One figure of every step.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is called: the name of the effect or the stage.
    pub name: String,
    /// What it counts or measures.
    pub kind: SeriesKind,
    /// Means over [`steps_per_value`](Recording::steps_per_value) steps each.
    pub values: Vec<f32>,
    /// The sum over all steps.
    pub total: f64,
    /// The smallest of any step; infinite if there was none.
    pub smallest: f64,
    /// The largest of any step; negative infinity if there was none.
    pub largest: f64,
    /// In which step it was the largest, first.
    pub largest_step: u64,
}

/// What a [`Measure`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeasureKind {
    /// A kind of energy, in J.
    Energy,
    /// The energy that an effect holds, in J, named after the effect.
    EffectEnergy,
    /// Lengths of edges over those at rest.
    Stretch,
}

/// The length that 99 % of the edges do not exceed, over that at rest.
pub(super) const EDGES_99: &str = "99 % of the edges";
/// Of the edge that is stretched most.
pub(super) const LONGEST_EDGE: &str = "longest edge";
/// Energy of weight.
pub(super) const GRAVITATIONAL: &str = "gravitational";

/// A quantity of the state, which takes too long to work out to be asked for in each step.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// What it is called.
    pub name: String,
    /// What it is.
    pub kind: MeasureKind,
    /// After each of the [`measured_steps`](Recording::measured_steps).
    pub values: Vec<f64>,
    /// The largest that was ever measured; negative infinity if none was.
    pub largest: f64,
    /// After which step it was the largest, first.
    pub largest_step: u64,
}

impl Recording {
    /// The cloth's vertices and the bodies'.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.parts.iter().map(Part::vertex_count).sum()
    }

    /// The time of a frame, in seconds.
    #[must_use]
    pub fn time(&self, frame: &Frame) -> f64 {
        self.end_of(frame.step)
    }

    /// The frame that is nearest to a time, in seconds: the first of two.
    ///
    /// # Panics
    /// If the recording has no frames, which a [`Recorder`] does not make.
    #[must_use]
    pub fn frame_at(&self, seconds: f64) -> usize {
        let away = |&frame: &usize| (self.time(&self.frames[frame]) - seconds).abs();
        let frames = 0..self.frames.len();
        frames
            .min_by(|a, b| away(a).total_cmp(&away(b)))
            .expect("a recording has frames")
    }

    /// How long the recorded steps are together, in simulated seconds.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.steps as f64 * self.about.time_step
    }

    /// Each part with the number of its first vertex among all.
    pub fn placed_parts(&self) -> impl Iterator<Item = (usize, &Part)> {
        let mut next = 0;
        self.parts.iter().map(move |part| {
            let first = next;
            next += part.vertex_count;
            (first, part)
        })
    }

    /// All parts in one frame as one mesh, to be written with [`mesh::write`](selvedge_files::mesh::write()).
    ///
    /// # Panics
    /// If there is no such frame.
    #[must_use]
    pub fn mesh(&self, frame: usize) -> Mesh {
        let positions = self.frames[frame].positions.iter();
        let triangles = self.placed_parts().flat_map(|(first, part)| {
            let placed = move |triangle: &[u32; 3]| triangle.map(|vertex| first as u32 + vertex);
            part.triangles.iter().map(placed)
        });
        Mesh {
            positions: positions.map(|p| DVec3::from(p.map(f64::from))).collect(),
            triangles: triangles.collect(),
        }
    }

    /// The direction that is up, of length one.
    pub(super) fn up(&self) -> DVec3 {
        self.about.up.try_normalize().unwrap_or(DVec3::Z)
    }

    /// The measure of this name.
    pub(super) fn measure(&self, name: &str) -> Option<&Measure> {
        self.measures.iter().find(|measure| measure.name == name)
    }

    /// The measures of a kind, in their order.
    pub(super) fn measures_of(&self, wanted: MeasureKind) -> impl Iterator<Item = &Measure> {
        self.measures.iter().filter(move |measure| measure.kind == wanted)
    }

    /// The time of a step's end, in seconds.
    pub(super) fn end_of(&self, step: u64) -> f64 {
        step as f64 * self.about.time_step
    }

    /// The times of the whole steps, if they were recorded.
    pub(super) fn step_times(&self) -> Option<&Series> {
        self.series_of(|kind| kind == SeriesKind::Step)
            .next()
            .filter(|_| self.steps > 0)
    }

    /// The series of a kind, in their order.
    pub(super) fn series_of(&self, wanted: impl Fn(SeriesKind) -> bool) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(move |series| wanted(series.kind))
    }
}
