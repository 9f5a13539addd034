//! Records in bounded memory.
//!
//! Frames and measurements are [thinned out](super::thinned). When a series has more than [`MOST_VALUES`] values, each two become
//! their mean. All stay evenly spread over a simulation of unknown length.

use super::thinned::Thinned;
use super::{About, Measure, MeasureKind, RecordedFrame, RecordedPart, Recording, Series, SeriesKind};
use selvedge_core::glam::DVec3;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The largest number of values of a series, which is more than a chart has pixels.
const MOST_VALUES: usize = 2048;
/// The limit of memory for positions, in bytes.
const BUDGET: usize = 64 << 20;

/// A frame that cannot be recorded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("step {step}: vertex {vertex} is at {position}, which f32 cannot hold")]
pub struct RecordingError {
    /// The frame's step.
    pub step: u64,
    /// The first such vertex.
    pub vertex: usize,
    /// Its position.
    pub position: DVec3,
}

/// Makes a [`Recording`], step by step.
#[derive(Clone, Debug)]
pub struct Recorder {
    /// The recording so far, without frames and without values of measures.
    recording: Recording,
    frames: Thinned<[f32; 3]>,
    measured: Thinned<f64>,
    /// The last readings of the counters.
    readings: Vec<f64>,
    /// The sums whose means become the values of each series.
    sums: Vec<Vec<f64>>,
}

/// A recording so far, as bytes have it.
#[derive(Serialize, Deserialize)]
struct Saved<'a> {
    seconds: f64,
    vertices: usize,
    /// The numbers of steps, of the first step, and of steps per value.
    steps: [u64; 3],
    frames: Cow<'a, Thinned<[f32; 3]>>,
    measured: Cow<'a, Thinned<f64>>,
    /// The name of each measure, its largest value and the step.
    measures: Vec<(String, f64, u64)>,
    series: Vec<SavedSeries>,
    remarks: Vec<String>,
}

#[derive(Serialize, Deserialize)]
struct SavedSeries {
    name: String,
    /// The last reading, the total, and the smallest and the largest value.
    numbers: [f64; 4],
    largest_step: u64,
    sums: Vec<f64>,
}

impl Recorder {
    /// Begins a recording of `parts`, whose vertices are numbered one part after the other.
    ///
    /// `readings` are the counters before the first recorded step, one for each series. That of a [gauge](SeriesKind::Gauge) is
    /// ignored.
    ///
    /// # Panics
    /// Panics if there are not as many readings as series.
    pub fn new(about: About, parts: Vec<RecordedPart>, series: &[(&str, SeriesKind)], readings: &[f64]) -> Self {
        assert_eq!(series.len(), readings.len(), "one reading for each series");
        let named = series.iter().map(|&(name, kind)| Series {
            name: name.to_owned(),
            kind,
            values: Vec::new(),
            total: 0.0,
            smallest: f64::INFINITY,
            largest: f64::NEG_INFINITY,
            largest_step: 0,
        });
        let recording = Recording {
            about,
            parts,
            frames: Vec::new(),
            steps: 0,
            first_step: 1,
            steps_per_value: 1,
            series: named.collect(),
            measured_steps: Vec::new(),
            measures: Vec::new(),
            wall_seconds: None,
            added: Vec::new(),
            remarks: Vec::new(),
        };
        Self {
            frames: Thinned::new(2),
            measured: Thinned::new(MOST_VALUES),
            readings: readings.to_vec(),
            sums: vec![Vec::new(); series.len()],
            recording,
        }
        .with_budget(BUDGET)
    }

    /// Adds quantities of the state that are measured at frames: see [`measure`](Self::measure).
    pub fn with_measures(mut self, measures: &[(&str, MeasureKind)]) -> Self {
        let named = measures.iter().map(|&(name, kind)| Measure {
            name: name.to_owned(),
            kind,
            values: Vec::new(),
            largest: f64::NEG_INFINITY,
            largest_step: 0,
        });
        self.recording.measures = named.collect();
        self
    }

    /// Keeps as many frames as fit into `bytes` of positions, 12 for each vertex, but never fewer than two. The default is 64
    /// MiB.
    pub fn with_budget(mut self, bytes: usize) -> Self {
        let frame = size_of::<[f32; 3]>() * self.recording.vertex_count().max(1);
        self.frames.set_most((bytes / frame).max(2));
        self
    }

    /// Offers the state after `step` steps, 0 for the start. Steps must increase; a second state after the same step replaces the
    /// first.
    ///
    /// # Errors
    /// Returns an error if a coordinate is not finite as an f32. Nothing is recorded then.
    ///
    /// # Panics
    /// Panics if there is not one position for each vertex.
    pub fn frame(&mut self, step: u64, positions: &[DVec3]) -> Result<(), RecordingError> {
        assert_eq!(positions.len(), self.recording.vertex_count(), "one position for each vertex");
        if let Some(vertex) = positions.iter().position(|&p| !is_finite(rounded(p))) {
            return Err(RecordingError {
                step,
                vertex,
                position: positions[vertex],
            });
        }
        if self.frames.is_empty() {
            self.recording.first_step = step + 1;
        }
        self.frames.offer(step, positions.iter().map(|&p| rounded(p)));
        Ok(())
    }

    /// Adds vertices to a part behind its own, each a copy of an earlier one, and replaces its triangles, as tearing does. In
    /// earlier frames the copies are at the places of their originals, so that these frames look unchanged.
    ///
    /// # Panics
    /// Panics if there is no such part, a copy is of no earlier vertex, or a triangle names a vertex that does not exist.
    pub fn split(&mut self, part: usize, copied: &[u32], triangles: Vec<[u32; 3]>) {
        let parts = &mut self.recording.parts;
        let first: usize = parts[..part].iter().map(RecordedPart::vertex_count).sum();
        let torn = &parts[part];
        let end = first + torn.vertex_count;
        self.frames.change(|positions| {
            for (place, &vertex) in copied.iter().enumerate() {
                let of = first + vertex as usize;
                assert!(of < end + place, "a copy is of a vertex before it");
                positions.insert(end + place, positions[of]);
            }
        });
        parts[part] = RecordedPart::new(torn.name.clone(), torn.kind, torn.vertex_count + copied.len(), triangles);
    }

    /// Records the values of all measures after `step` steps, in their order. Steps are as for [`frame`](Self::frame).
    ///
    /// # Panics
    /// Panics if there are not as many values as measures.
    pub fn measure(&mut self, step: u64, values: &[f64]) {
        let measures = &mut self.recording.measures;
        assert_eq!(values.len(), measures.len(), "one value for each measure");
        for (measure, &value) in measures.iter_mut().zip(values) {
            if value > measure.largest {
                (measure.largest, measure.largest_step) = (value, step);
            }
        }
        self.measured.offer(step, values.iter().copied());
    }

    /// Records a step: the reading of each series' counter after it, in the order of the series. The step's value is the
    /// difference to the last reading. A [gauge](SeriesKind::Gauge) and the time of a [step](SeriesKind::Step) are recorded as
    /// they are.
    ///
    /// # Panics
    /// Panics if there are not as many readings as series.
    pub fn step(&mut self, readings: &[f64]) {
        let recording = &mut self.recording;
        assert_eq!(readings.len(), recording.series.len(), "one reading for each series");
        if recording.steps == MOST_VALUES as u64 * recording.steps_per_value {
            for sums in &mut self.sums {
                *sums = sums.chunks(2).map(|two| two.iter().sum()).collect();
            }
            recording.steps_per_value *= 2;
        }
        let opens = recording.steps.is_multiple_of(recording.steps_per_value);
        for (index, series) in recording.series.iter_mut().enumerate() {
            let value = match series.kind {
                SeriesKind::Gauge(_) | SeriesKind::Step => readings[index],
                _ => readings[index] - self.readings[index],
            };
            series.total += value;
            series.smallest = series.smallest.min(value);
            if value > series.largest {
                (series.largest, series.largest_step) = (value, recording.first_step + recording.steps);
            }
            match self.sums[index].last_mut() {
                Some(sum) if !opens => *sum += value,
                _ => self.sums[index].push(value),
            }
        }
        self.readings.clear();
        self.readings.extend_from_slice(readings);
        recording.steps += 1;
    }

    /// Returns the recording so far as bytes, to continue after an interruption: see [`restore`](Self::restore). `seconds` is the
    /// wall-clock time so far.
    pub fn save(&self, seconds: f64) -> Vec<u8> {
        let recording = &self.recording;
        let measures = recording.measures.iter();
        let series = recording.series.iter();
        let saved = Saved {
            seconds,
            vertices: recording.vertex_count(),
            steps: [recording.steps, recording.first_step, recording.steps_per_value],
            frames: Cow::Borrowed(&self.frames),
            measured: Cow::Borrowed(&self.measured),
            measures: measures
                .map(|own| (own.name.clone(), own.largest, own.largest_step))
                .collect(),
            series: { series.zip(&self.readings).zip(&self.sums) }
                .map(|((own, &reading), sums)| SavedSeries {
                    name: own.name.clone(),
                    numbers: [reading, own.total, own.smallest, own.largest],
                    largest_step: own.largest_step,
                    sums: sums.clone(),
                })
                .collect(),
            remarks: recording.remarks.clone(),
        };
        postcard::to_allocvec(&saved).expect("all lengths are known, and a list of bytes has room")
    }

    /// Continues a recording that another recorder of the same parts and series has [saved](Self::save), and returns its seconds.
    /// Counters must have the readings of that time. Returns `None`, and changes nothing, if the bytes are damaged or belong to
    /// other parts or series.
    pub fn restore(&mut self, bytes: &[u8]) -> Option<f64> {
        let mut restored = self.clone();
        let (saved, rest) = postcard::take_from_bytes(bytes).ok()?;
        let seconds = restored.go_on(saved).filter(|_| rest.is_empty())?;
        *self = restored;
        Some(seconds)
    }

    fn go_on(&mut self, saved: Saved<'_>) -> Option<f64> {
        let vertices = self.recording.vertex_count();
        let recording = &mut self.recording;
        let lengths = [saved.vertices, saved.measures.len(), saved.series.len()];
        (lengths == [vertices, recording.measures.len(), recording.series.len()]).then_some(())?;
        [recording.steps, recording.first_step, recording.steps_per_value] = saved.steps;
        self.frames
            .restore(saved.frames.into_owned(), vertices, |&position| is_finite(position))?;
        self.measured
            .restore(saved.measured.into_owned(), recording.measures.len(), |_| true)?;
        for (measure, (name, largest, step)) in recording.measures.iter_mut().zip(saved.measures) {
            (name == measure.name).then_some(())?;
            (measure.largest, measure.largest_step) = (largest, step);
        }
        for (index, (series, saved)) in recording.series.iter_mut().zip(saved.series).enumerate() {
            (saved.name == series.name && saved.sums.len() <= MOST_VALUES).then_some(())?;
            [self.readings[index], series.total, series.smallest, series.largest] = saved.numbers;
            series.largest_step = saved.largest_step;
            self.sums[index] = saved.sums;
        }
        recording.remarks = saved.remarks;
        (recording.steps_per_value > 0).then_some(saved.seconds)
    }

    /// Adds a sentence for readers.
    pub fn remark(&mut self, sentence: impl Into<String>) {
        self.recording.remarks.push(sentence.into());
    }

    /// Ends the recording. `wall_seconds` is the wall-clock time of the steps, if it is known.
    ///
    /// # Panics
    /// Panics if there was no frame.
    pub fn finish(self, wall_seconds: Option<f64>) -> Recording {
        let mut recording = self.recording;
        let frames = self.frames.finish().into_iter();
        recording.frames = frames.map(|(step, positions)| RecordedFrame { step, positions }).collect();
        for (step, values) in self.measured.finish() {
            recording.measured_steps.push(step);
            for (measure, value) in recording.measures.iter_mut().zip(values) {
                measure.values.push(value);
            }
        }
        assert!(
            !recording.frames.is_empty(),
            "a recording has a frame, were it only the start"
        );
        recording.wall_seconds = wall_seconds;
        let (steps, each) = (recording.steps, recording.steps_per_value);
        for (series, sums) in recording.series.iter_mut().zip(self.sums) {
            let mean = |(index, sum): (usize, f64)| {
                let before = index as u64 * each;
                (sum / each.min(steps - before) as f64) as f32
            };
            series.values = sums.into_iter().enumerate().map(mean).collect();
        }
        recording
    }
}

fn rounded(position: DVec3) -> [f32; 3] {
    position.to_array().map(|coordinate| coordinate as f32)
}

fn is_finite(position: [f32; 3]) -> bool {
    position.iter().all(|coordinate| coordinate.is_finite())
}
