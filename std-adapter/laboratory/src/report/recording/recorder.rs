//! Records in bounded memory.
//!
//! When frames take more than their budget, every other one is dropped, and from then on every other one is not kept; when
//! values of a series are more than [`MOST_VALUES`], each two become their mean. So both stay evenly spread over a
//! simulation whose end nobody knows.

use super::{About, Frame, Part, Recording, Series, SeriesKind};
use selvedge_core::glam::DVec3;
use selvedge_files::bytes::{Reader, put_block};

/// More than a chart has pixels.
const MOST_VALUES: usize = 2048;
/// Bytes of positions.
const BUDGET: usize = 64 << 20;

/// A frame that cannot be recorded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("step {step}: vertex {vertex} is at {position}, which f32 cannot hold")]
pub struct FrameError {
    /// The frame's step.
    pub step: u64,
    /// The first such vertex.
    pub vertex: usize,
    /// Where it is.
    pub position: DVec3,
}

/// Makes a [`Recording`], step by step.
#[derive(Clone, Debug)]
pub struct Recorder {
    recording: Recording,
    /// Frames that may be kept: at least two.
    most_frames: usize,
    /// One frame in this many is kept…
    stride: u64,
    /// … of those offered so far.
    offered: u64,
    /// The last frame offered, if it was not kept.
    skipped: Option<Frame>,
    /// What the counters read last.
    readings: Vec<f64>,
    /// For each series, the sums that its values are the means of.
    sums: Vec<Vec<f64>>,
}

impl Recorder {
    /// Begins a recording of `parts`, whose vertices are numbered one part after the other.
    ///
    /// `readings` are the counters' before the first recorded step, one for each series; that of a
    /// [gauge](SeriesKind::Gauge) is ignored.
    ///
    /// # Panics
    /// If there are not as many readings as series.
    #[must_use]
    pub fn new(about: About, parts: Vec<Part>, series: &[(&str, SeriesKind)], readings: &[f64]) -> Self {
        assert_eq!(series.len(), readings.len(), "one reading for each series");
        let named = series.iter().map(|&(name, kind)| Series {
            name: name.to_owned(),
            kind,
            values: Vec::new(),
            total: 0.0,
            smallest: f64::INFINITY,
            largest: f64::NEG_INFINITY,
        });
        let recording = Recording {
            about,
            parts,
            frames: Vec::new(),
            steps: 0,
            first_step: 1,
            steps_per_value: 1,
            series: named.collect(),
            wall_seconds: None,
            added: Vec::new(),
            remarks: Vec::new(),
        };
        Self {
            stride: 1,
            offered: 0,
            skipped: None,
            readings: readings.to_vec(),
            sums: vec![Vec::new(); series.len()],
            recording,
            most_frames: 2,
        }
        .with_budget(BUDGET)
    }

    /// Keeps as many frames as have at most `bytes` of positions, 12 for each vertex, but never fewer than two. 64 MiB if this is
    /// not called.
    #[must_use]
    pub fn with_budget(mut self, bytes: usize) -> Self {
        let frame = size_of::<[f32; 3]>() * self.recording.vertex_count().max(1);
        self.most_frames = (bytes / frame).max(2);
        self
    }

    /// Whether a frame offered now would be kept, or is only remembered in case that it is the last.
    #[must_use]
    pub fn wants_frame(&self) -> bool {
        self.offered.is_multiple_of(self.stride)
    }

    /// Offers the state after `step` steps, 0 for the start: after more steps than all states offered before, or after as many as
    /// the last one, which it then replaces.
    ///
    /// # Errors
    /// If a coordinate is not finite as an f32. Then nothing is recorded.
    ///
    /// # Panics
    /// If there is not one position for each vertex.
    pub fn frame(&mut self, step: u64, positions: &[DVec3]) -> Result<(), FrameError> {
        assert_eq!(positions.len(), self.recording.vertex_count(), "one position for each vertex");
        if let Some(vertex) = positions.iter().position(|&p| !is_finite(rounded(p))) {
            return Err(FrameError {
                step,
                vertex,
                position: positions[vertex],
            });
        }
        let last = self.skipped.as_mut().or(self.recording.frames.last_mut());
        if let Some(last) = last.filter(|last| last.step == step) {
            for (place, &position) in last.positions.iter_mut().zip(positions) {
                *place = rounded(position);
            }
            return Ok(());
        }
        // Its memory is used again.
        let mut frame = self.skipped.take().unwrap_or_default();
        frame.step = step;
        frame.positions.clear();
        frame.positions.extend(positions.iter().map(|&p| rounded(p)));
        if self.offered == 0 {
            self.recording.first_step = step + 1;
        }
        if !self.wants_frame() {
            self.skipped = Some(frame);
        } else if self.recording.frames.len() < self.most_frames {
            self.recording.frames.push(frame);
        } else {
            keep_every_other(&mut self.recording.frames);
            self.stride *= 2;
            if self.wants_frame() {
                self.recording.frames.push(frame);
            } else {
                self.skipped = Some(frame);
            }
        }
        self.offered += 1;
        Ok(())
    }

    /// Records a step: what each series' counter reads after it, in the order of the series. The difference to the reading before
    /// is the step's; a [gauge](SeriesKind::Gauge) is recorded as it is.
    ///
    /// # Panics
    /// If there are not as many readings as series.
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
                SeriesKind::Gauge(_) => readings[index],
                _ => readings[index] - self.readings[index],
            };
            series.total += value;
            series.smallest = series.smallest.min(value);
            series.largest = series.largest.max(value);
            match self.sums[index].last_mut() {
                Some(sum) if !opens => *sum += value,
                _ => self.sums[index].push(value),
            }
        }
        self.readings.clear();
        self.readings.extend_from_slice(readings);
        recording.steps += 1;
    }

    /// All that has been recorded in `seconds` by the clock on the wall, as bytes, to go on with after an interruption: see
    /// [`restore`](Self::restore).
    #[must_use]
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
            self.stride,
            self.offered,
        ];
        bytes.extend(numbers.into_iter().flat_map(u64::to_le_bytes));
        for frames in [&recording.frames[..], self.skipped.as_slice()] {
            bytes.extend((frames.len() as u64).to_le_bytes());
            for frame in frames {
                bytes.extend(frame.step.to_le_bytes());
                let coordinates = frame.positions.iter().flatten();
                bytes.extend(coordinates.flat_map(|x| x.to_le_bytes()));
            }
        }
        for (index, series) in recording.series.iter().enumerate() {
            put_block(&mut bytes, series.name.as_bytes());
            let numbers = [self.readings[index], series.total, series.smallest, series.largest];
            bytes.extend(numbers.into_iter().flat_map(f64::to_le_bytes));
            bytes.extend((self.sums[index].len() as u64).to_le_bytes());
            bytes.extend(self.sums[index].iter().flat_map(|sum| sum.to_le_bytes()));
        }
        bytes.extend((recording.remarks.len() as u64).to_le_bytes());
        for remark in &recording.remarks {
            put_block(&mut bytes, remark.as_bytes());
        }
        bytes
    }

    /// Goes on with what another recorder of the same parts and series has [saved](Self::save); returns its seconds. Counters must read
    /// what they read then. `None`, and nothing has changed, if the bytes are damaged, or of other parts or series.
    #[must_use]
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
        self.stride = reader.u64()?;
        self.offered = reader.u64()?;
        recording.frames = read_frames(reader, vertices)?;
        self.skipped = read_frames(reader, vertices)?.pop();
        for (index, series) in recording.series.iter_mut().enumerate() {
            (reader.block()? == series.name.as_bytes()).then_some(())?;
            self.readings[index] = reader.f64()?;
            series.total = reader.f64()?;
            series.smallest = reader.f64()?;
            series.largest = reader.f64()?;
            let count = reader.count(size_of::<f64>())?;
            self.sums[index] = (0..count).map(|_| reader.f64()).collect::<Option<_>>()?;
        }
        recording.remarks.clear();
        for _ in 0..reader.count(1)? {
            let remark = String::from_utf8(reader.block()?.to_vec()).ok()?;
            recording.remarks.push(remark);
        }
        let values = self.sums.iter().all(|sums| sums.len() <= MOST_VALUES);
        let positive = recording.steps_per_value > 0 && self.stride > 0;
        (values && positive && reader.0.is_empty()).then_some(seconds)
    }

    /// Says something that a reader must know.
    pub fn remark(&mut self, sentence: impl Into<String>) {
        self.recording.remarks.push(sentence.into());
    }

    /// Ends the recording. `wall_seconds` is how long the steps took by the clock on the wall, if it is known.
    ///
    /// # Panics
    /// If there was no frame.
    #[must_use]
    pub fn finish(self, wall_seconds: Option<f64>) -> Recording {
        let mut recording = self.recording;
        recording.frames.extend(self.skipped);
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

fn read_frames(reader: &mut Reader<'_>, vertices: usize) -> Option<Vec<Frame>> {
    let frames = reader.count(size_of::<u64>())?;
    let frame = |_| {
        let step = reader.u64()?;
        let position = |_| {
            let position = [reader.f32()?, reader.f32()?, reader.f32()?];
            is_finite(position).then_some(position)
        };
        let positions = (0..vertices).map(position).collect::<Option<_>>()?;
        Some(Frame { step, positions })
    };
    (0..frames).map(frame).collect()
}

fn rounded(position: DVec3) -> [f32; 3] {
    position.to_array().map(|coordinate| coordinate as f32)
}

fn is_finite(position: [f32; 3]) -> bool {
    position.iter().all(|coordinate| coordinate.is_finite())
}

/// The first, the third, and so on.
fn keep_every_other(frames: &mut Vec<Frame>) {
    let mut index = 0;
    frames.retain(|_| {
        index += 1;
        index % 2 == 1
    });
}
