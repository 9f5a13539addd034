//! Bodies that deform: frames of vertices, or a figure that a skeleton moves.
//!
//! **No jumps.** The positions depend on the clock of bodies alone. They are exact at the start and at the end of a step, or of a
//! part of a step. In between every vertex moves straight, and the [certified pass](crate::contact) covers that motion. The clock
//! advances by at most a time step, and may wait. No vertex may be faster than [`FASTEST_VERTEX`]: a cut in the animation, or a
//! unit other than metres, is an error.

use crate::identity::{Identify, Identity};
use crate::input::{FREQUENCY, Field, LARGEST_COORDINATE, LARGEST_TIME, TIME, ValueError};
use crate::model::length::length;
use selvedge_core::glam::DVec3;
use selvedge_files::animation::Figure;
use selvedge_files::bytes::Fingerprint;
use std::fmt;
use std::sync::Arc;

/// The fastest speed of a vertex, in m/s: much faster than a hand, and slower than a figure that jumps elsewhere in the next
/// frame.
pub(crate) const FASTEST_VERTEX: f64 = 100.0;

pub(super) const RATE: Field = Field::new("frames_per_second", FREQUENCY, 1e-3, 1e5);
pub(super) const START: Field = Field::new("start", TIME, 0.0, LARGEST_TIME);

/// The position of each vertex of a body over time: [`BodyMotion::Animated`](crate::BodyMotion::Animated).
///
/// Vertices rest before the first key and after the last one.
///
/// ```
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Animation, Body};
///
/// // A triangle whose tip rises by 10 cm in half a second, from 1 s on.
/// let frame = |height| vec![DVec3::ZERO, DVec3::X, DVec3::new(0.0, 1.0, height)];
/// let animation = Animation::from_frames(vec![frame(0.0), frame(0.1)], 2.0)?.starting_at(1.0);
/// assert_eq!(animation.span(), [1.0, 1.5]);
/// assert_eq!(animation.positions_at(1.25)[2].z, 0.05);
/// let body = Body::animated("leaf", vec![[0, 1, 2]], animation);
/// assert_eq!(body.mesh.positions, frame(0.0));
///
/// let error = Animation::from_frames(vec![frame(0.0)], -1.0).unwrap_err();
/// assert_eq!(error.field, "frames_per_second");
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct Animation {
    source: Arc<Source>,
    /// The time of the first key, in seconds of the clock.
    start: f64,
}

#[derive(PartialEq)]
struct Source {
    shapes: Shapes,
    /// The time from the first to the last key, in seconds.
    length: f64,
    vertices: usize,
    fingerprint: u64,
    jumps: Jumps,
}

#[derive(PartialEq)]
enum Shapes {
    Frames { frames: Vec<Vec<DVec3>>, rate: f64 },
    Figure(Box<Figure>),
}

/// The fastest vertex and the longest jump, each with its time from the first key, and its vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Jumps {
    /// The speed, in m/s.
    speed: (f64, f64, usize),
    /// The length of a jump at one instant, in metres.
    length: (f64, f64, usize),
}

impl Animation {
    /// Makes an animation from frames of all vertices, in metres. Between frames every vertex moves straight and evenly. The
    /// first frame is at time 0.
    ///
    /// # Errors
    /// Returns an error if there is no frame, the frames differ in their number of vertices, or the rate is invalid. Coordinates
    /// must be finite and within a kilometre.
    pub fn from_frames(frames: Vec<Vec<DVec3>>, frames_per_second: f64) -> Result<Self, ValueError> {
        RATE.check(frames_per_second)?;
        let wrong = |message: String| Err(ValueError::new("frames", message));
        let Some(first) = frames.first() else {
            return wrong("an animation needs at least one frame".to_owned());
        };
        let (vertices, mut fingerprint, mut jumps) = (first.len(), Fingerprint::default(), Jumps::default());
        fingerprint.take(&frames_per_second.to_le_bytes());
        for (index, frame) in frames.iter().enumerate() {
            if frame.len() != vertices {
                return wrong(format!(
                    "frame {index} has {} vertices, but the first has {vertices}",
                    frame.len()
                ));
            }
            check_reach(frame, || format!("frame {index}"))?;
            let numbers = frame.iter().flat_map(|position| position.to_array());
            numbers.for_each(|number| fingerprint.take(&number.to_le_bytes()));
            if let Some(before) = index.checked_sub(1) {
                let (length, vertex) = longest_move(&frames[before], frame);
                let time = before as f64 / frames_per_second;
                jumps.speed = larger(jumps.speed, (length * frames_per_second, time, vertex));
            }
        }
        let length = (frames.len() - 1) as f64 / frames_per_second;
        let rate = frames_per_second;
        Ok(Self::of(Source {
            shapes: Shapes::Frames { frames, rate },
            length,
            vertices,
            fingerprint: fingerprint.value(),
            jumps,
        }))
    }

    /// Makes an animation from a [figure](crate::files::animation) of a glTF file, in metres. Its keys are at the file's times,
    /// so that figures of one animation stay together.
    ///
    /// # Errors
    /// Returns an error if a vertex is beyond a kilometre, or not finite, at a key.
    pub fn from_figure(figure: Figure) -> Result<Self, ValueError> {
        let [first, last] = figure.span();
        let (mut before, mut at, mut jumps) = (Vec::new(), Vec::new(), Jumps::default());
        let mut last_key = first;
        for key in figure.key_times() {
            // These are the figure just before the key and the figure at the key; they differ where it jumps.
            if figure.has_steps() && key > first {
                std::mem::swap(&mut before, &mut at);
                figure.positions_at(key.next_down(), &mut at);
                jumps.take_speed(&before, &at, last_key - first, key - last_key);
                std::mem::swap(&mut before, &mut at);
                figure.positions_at(key, &mut at);
                let (length, vertex) = longest_move(&before, &at);
                jumps.length = larger(jumps.length, (length, key - first, vertex));
            } else {
                std::mem::swap(&mut before, &mut at);
                figure.positions_at(key, &mut at);
                if key > first {
                    jumps.take_speed(&before, &at, last_key - first, key - last_key);
                }
            }
            check_reach(&at, || format!("the figure at {key} s"))?;
            last_key = key;
        }
        let animation = Self::of(Source {
            length: last - first,
            vertices: figure.mesh().positions.len(),
            fingerprint: figure.fingerprint(),
            shapes: Shapes::Figure(Box::new(figure)),
            jumps,
        });
        Ok(animation.starting_at(first))
    }

    fn of(source: Source) -> Self {
        Self {
            source: Arc::new(source),
            start: 0.0,
        }
    }

    /// Moves the first key to a time of the simulation, in seconds from 0 to 100,000.
    #[must_use]
    pub fn starting_at(self, time: f64) -> Self {
        Self { start: time, ..self }
    }

    /// Returns the times of the first and the last key, in seconds of the simulation, if bodies never have to wait.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        [self.start, self.start + self.source.length]
    }

    /// Returns the number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.source.vertices
    }

    /// Returns all positions, in metres, at a time of the simulation, in seconds, if bodies never have to wait.
    #[must_use]
    pub fn positions_at(&self, time: f64) -> Vec<DVec3> {
        let mut positions = Vec::new();
        self.sample(time, &mut positions);
        positions
    }

    /// Clamps a time of the clock to the keys.
    pub(crate) fn key(&self, clock: f64) -> f64 {
        (clock - self.start).clamp(0.0, self.source.length)
    }

    /// Replaces `positions` by those at a time of the clock. All of them are finite.
    pub(crate) fn sample(&self, clock: f64, positions: &mut Vec<DVec3>) {
        let time = self.key(clock);
        match &self.source.shapes {
            Shapes::Frames { frames, rate } => {
                let place = time * rate;
                // The last frame has no successor.
                let before = (place as usize).min(frames.len() - 1);
                let share = place - before as f64;
                positions.clear();
                match frames.get(before + 1).filter(|_| share > 0.0) {
                    None => positions.extend_from_slice(&frames[before]),
                    Some(after) => {
                        let moves = frames[before].iter().zip(after);
                        positions.extend(moves.map(|(&from, &to)| from + (to - from) * share));
                    }
                }
            }
            Shapes::Figure(figure) => {
                figure.positions_at(figure.span()[0] + time, positions);
                // A cubic may leave this range between its keys.
                let farthest = DVec3::splat(LARGEST_COORDINATE);
                for position in positions.iter_mut().filter(|position| !is_within_reach(position)) {
                    let nearest = if position.is_nan() { DVec3::ZERO } else { *position };
                    *position = nearest.clamp(-farthest, farthest);
                }
            }
        }
    }

    pub(super) fn check(&self, vertices: usize, time_step: f64) -> Result<(), ValueError> {
        START.check(self.start)?;
        if self.source.vertices != vertices {
            let message = format!("the animation has {} vertices, but it moves {vertices}", self.source.vertices);
            return Err(ValueError::new("animation", message));
        }
        let Jumps { speed, length } = self.source.jumps;
        let fastest = larger(speed, (length.0 / time_step, length.1, length.2));
        let (speed, time, vertex) = fastest;
        if speed > FASTEST_VERTEX {
            let unit = [("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6)]
                .into_iter()
                .find(|(_, unit)| speed * unit <= FASTEST_VERTEX);
            let remedy = unit.map_or(String::new(), |(name, _)| {
                format!(" If the file is not in metres, add `unit = \"{name}\"`.")
            });
            let message = format!(
                "vertex {vertex} moves at {speed:.0} m/s from {time:.3} s of the animation on, but must not be faster than {FASTEST_VERTEX} m/s; is there a cut in the animation?{remedy}"
            );
            return Err(ValueError::new("animation", message));
        }
        Ok(())
    }
}

impl Identify for Animation {
    fn identify(&self, identity: &mut Identity) {
        self.span().identify(identity);
        self.source.vertices.identify(identity);
        self.source.fingerprint.identify(identity);
    }
}

/// Shows what identifies the animation, not all of its frames.
impl fmt::Debug for Animation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("Animation");
        debug.field("vertices", &self.source.vertices).field("span", &self.span());
        debug.field("fingerprint", &self.source.fingerprint).finish_non_exhaustive()
    }
}

impl Jumps {
    /// Takes a motion of all vertices in `seconds` into account.
    fn take_speed(&mut self, from: &[DVec3], to: &[DVec3], begin: f64, seconds: f64) {
        let (length, vertex) = longest_move(from, to);
        self.speed = larger(self.speed, (length / seconds, begin, vertex));
    }
}

fn longest_move(from: &[DVec3], to: &[DVec3]) -> (f64, usize) {
    let moves = from.iter().zip(to).map(|(from, to)| length(*from - *to)).enumerate();
    let longest = moves.max_by(|a, b| a.1.total_cmp(&b.1));
    longest.map_or((0.0, 0), |(vertex, longest)| (longest, vertex))
}

fn larger(a: (f64, f64, usize), b: (f64, f64, usize)) -> (f64, f64, usize) {
    if b.0 > a.0 { b } else { a }
}

fn is_within_reach(position: &DVec3) -> bool {
    position.abs().cmple(DVec3::splat(LARGEST_COORDINATE)).all()
}

fn check_reach(positions: &[DVec3], whose: impl Fn() -> String) -> Result<(), ValueError> {
    match positions.iter().position(|position| !is_within_reach(position)) {
        None => Ok(()),
        Some(vertex) => {
            let (whose, at) = (whose(), positions[vertex]);
            let message = format!("{whose} has vertex {vertex} at {at}, which is not within {LARGEST_COORDINATE} metres");
            Err(ValueError::new("frames", message))
        }
    }
}
