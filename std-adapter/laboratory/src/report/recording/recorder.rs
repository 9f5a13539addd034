//! Records in bounded memory.
//!
//! Frames and measurements are [thinned out](super::thinned). When a series has more than [`MOST_VALUES`] values, each two become
//! their mean. All stay evenly spread over a simulation of unknown length.

use super::thinned::Thinned;
use super::{About, Measure, MeasureKind, RecordedFrame, RecordedPart, Recording, Series, SeriesKind};
use selvedge_core::glam::DVec3;
use selvedge_files::bytes::{Reader, put_block};

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
        let mut bytes = Vec::new();
        bytes.extend((recording.vertex_count() as u64).to_le_bytes());
        bytes.extend((recording.series.len() as u64).to_le_bytes());
        bytes.extend(seconds.to_le_bytes());
        let numbers = [
            recording.steps,
            recording.first_step,
            recording.steps_per_value,
            recording.measures.len() as u64,
        ];
        bytes.extend(numbers.into_iter().flat_map(u64::to_le_bytes));
        self.frames.save(&mut bytes, |position, bytes| {
            bytes.extend(position.iter().flat_map(|x| x.to_le_bytes()));
        });
        self.measured
            .save(&mut bytes, |value, bytes| bytes.extend(value.to_le_bytes()));
        for measure in &recording.measures {
            put_block(&mut bytes, measure.name.as_bytes());
            bytes.extend(measure.largest.to_le_bytes());
            bytes.extend(measure.largest_step.to_le_bytes());
        }
        for (index, series) in recording.series.iter().enumerate() {
            put_block(&mut bytes, series.name.as_bytes());
            let numbers = [self.readings[index], series.total, series.smallest, series.largest];
            bytes.extend(numbers.into_iter().flat_map(f64::to_le_bytes));
            bytes.extend(series.largest_step.to_le_bytes());
            bytes.extend((self.sums[index].len() as u64).to_le_bytes());
            bytes.extend(self.sums[index].iter().flat_map(|sum| sum.to_le_bytes()));
        }
        bytes.extend((recording.remarks.len() as u64).to_le_bytes());
        for remark in &recording.remarks {
            put_block(&mut bytes, remark.as_bytes());
        }
        bytes
    }

    /// Continues a recording that another recorder of the same parts and series has [saved](Self::save), and returns its seconds.
    /// Counters must have the readings of that time. Returns `None`, and changes nothing, if the bytes are damaged or belong to
    /// other parts or series.
    pub fn restore(&mut self, bytes: &[u8]) -> Option<f64> {
        let mut restored = self.clone();
        let seconds = restored.read(&mut Reader(bytes))?;
        *self = restored;
        Some(seconds)
    }

    fn read(&mut self, reader: &mut Reader<'_>) -> Option<f64> {
        let vertices = self.recording.vertex_count();
        let same = |found: u64, own: usize| (found == own as u64).then_some(());
        same(reader.u64()?, vertices)?;
        same(reader.u64()?, self.recording.series.len())?;
        let seconds = reader.f64()?;
        let recording = &mut self.recording;
        recording.steps = reader.u64()?;
        recording.first_step = reader.u64()?;
        recording.steps_per_value = reader.u64()?;
        same(reader.u64()?, recording.measures.len())?;
        self.frames.restore(reader, vertices, |reader| {
            let position = [reader.f32()?, reader.f32()?, reader.f32()?];
            is_finite(position).then_some(position)
        })?;
        let measures = recording.measures.len();
        self.measured.restore(reader, measures, |reader| reader.f64())?;
        for measure in &mut recording.measures {
            (reader.block()? == measure.name.as_bytes()).then_some(())?;
            measure.largest = reader.f64()?;
            measure.largest_step = reader.u64()?;
        }
        for (index, series) in recording.series.iter_mut().enumerate() {
            (reader.block()? == series.name.as_bytes()).then_some(())?;
            self.readings[index] = reader.f64()?;
            series.total = reader.f64()?;
            series.smallest = reader.f64()?;
            series.largest = reader.f64()?;
            series.largest_step = reader.u64()?;
            let count = reader.count(size_of::<f64>())?;
            self.sums[index] = (0..count).map(|_| reader.f64()).collect::<Option<_>>()?;
        }
        recording.remarks.clear();
        for _ in 0..reader.count(1)? {
            let remark = String::from_utf8(reader.block()?.to_vec()).ok()?;
            recording.remarks.push(remark);
        }
        let values = self.sums.iter().all(|sums| sums.len() <= MOST_VALUES);
        (values && recording.steps_per_value > 0 && reader.0.is_empty()).then_some(seconds)
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
