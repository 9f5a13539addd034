//! Rigid motions along keyframes.

use super::animation::FASTEST_VERTEX;
use super::motion::{Pose, turned};
use super::placement::TRANSLATION;
use crate::input::{
    ANGLE, ANGULAR_SPEED, Field, LARGEST_COORDINATE, LARGEST_TIME, LENGTH, RATIO, SceneError, TIME, Table, ValueError,
};
use selvedge_core::glam::DVec3;

/// The motion from one keyframe to the next.
///
/// The default is linear, since that is what most exported animations mean. It is the default of glTF, and tools write other
/// curves as dense keys. A motion that is steady in the tool stays steady, however many keys there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight and even. The velocity jumps at a keyframe.
    #[default]
    Linear,
    /// Straight, and at rest at each keyframe: the velocity rises from zero and falls to zero. It is 1.5 times its mean in
    /// between.
    Smooth,
    /// A curve through all keyframes, without a jump of the velocity. It is monotone cubic (Fritsch and Butland, 1984), so that
    /// no coordinate overshoots its keyframes.
    Spline,
}

const INTERPOLATIONS: [(&str, Interpolation); 3] = [
    ("linear", Interpolation::Linear),
    ("smooth", Interpolation::Smooth),
    ("spline", Interpolation::Spline),
];

/// A rigid motion: a rotation about an axis through a pivot, then a translation.
///
/// The body rests before the first keyframe and after the last, apart from a [spin](Self::spinning). In between, both follow the
/// [`Interpolation`].
///
/// ```
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Interpolation, Keyframe, KeyframeMotion};
///
/// // A door opens by a quarter turn within a second, and comes to rest.
/// let closed = Keyframe::default();
/// let open = Keyframe { time: 1.0, angle: std::f64::consts::FRAC_PI_2, ..closed };
/// let door = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![closed, open])?;
/// let door = door.interpolated(Interpolation::Smooth);
/// // A turntable turns for ever.
/// let table = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![])?.spinning(3.0);
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct KeyframeMotion {
    pivot: DVec3,
    axis: DVec3,
    keyframes: Vec<Keyframe>,
    interpolation: Interpolation,
    /// The rotation besides the keyframes', in radians per second.
    rate: f64,
}

crate::identify!(enum Interpolation { 0 => Linear, 1 => Smooth, 2 => Spline });
crate::identify!(KeyframeMotion {
    pivot,
    axis,
    keyframes,
    interpolation,
    rate
});
crate::identify!(Keyframe {
    time,
    angle,
    translation
});

/// The shortest time between keyframes, in seconds: far above the resolution of the clock.
const CLOSEST_KEYS: f64 = 1e-6;

/// The largest rotation in a time step, in radians: nearly a whole turn. Steps with contact are cut until a part turns by a
/// thousandth of that.
const FASTEST_TURN: f64 = 6.0;

/// The times between two keyframes at which speeds are measured, each in sixteenths.
const MEASURED: u32 = 16;

const PIVOT: Field = Field::vector("pivot", LENGTH, LARGEST_COORDINATE);
pub(super) const AXIS: Field = Field::vector("axis", RATIO, LARGEST_COORDINATE);
pub(crate) const KEY_TIME: Field = Field::new("time", TIME, 0.0, LARGEST_TIME);
pub(super) const KEY_ANGLE: Field = Field::new("angle", ANGLE, -1e4, 1e4);
const SPIN: Field = Field::new("rate", ANGULAR_SPEED, -1e4, 1e4);

/// A rigid motion at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Keyframe {
    /// The time in seconds of the simulation, zero or more.
    pub time: f64,
    /// The rotation since the start, in radians.
    pub angle: f64,
    /// The translation since the start, in metres.
    pub translation: DVec3,
}

/// Returns an axis of length one.
pub(super) fn unit_axis(axis: DVec3) -> Result<DVec3, ValueError> {
    let zero = || ValueError::new(AXIS.name, "`axis` must not be zero: it is the direction to turn about");
    axis.try_normalize().ok_or_else(zero)
}

/// Checks that a keyframe at `time`, in seconds, may follow one at the time `last`.
pub(crate) fn check_key_time(time: f64, last: Option<f64>) -> Result<(), ValueError> {
    KEY_TIME.check(time)?;
    if last.is_some_and(|last| time < last + CLOSEST_KEYS) {
        let message = "keyframes must be in order: each `time` at least a microsecond after the one before";
        return Err(ValueError::new(KEY_TIME.name, message));
    }
    Ok(())
}

impl Keyframe {
    /// Checks the keyframe, and that it may follow `last`.
    fn check(&self, last: Option<&Self>) -> Result<(), ValueError> {
        KEY_ANGLE.check(self.angle)?;
        TRANSLATION.check_vector(self.translation)?;
        check_key_time(self.time, last.map(|last| last.time))
    }

    /// The angle and the coordinates of the translation.
    fn values(&self) -> [f64; 4] {
        let [x, y, z] = self.translation.to_array();
        [self.angle, x, y, z]
    }
}

/// A cubic between two keyframes, one for the angle and for each coordinate.
struct Segment {
    seconds: f64,
    from: [f64; 4],
    to: [f64; 4],
    /// The velocities at both ends.
    velocities: [[f64; 4]; 2],
}

impl Segment {
    /// Returns the values at a share of the time, from 0 to 1.
    fn at(&self, s: f64) -> [f64; 4] {
        let back = 1.0 - s;
        std::array::from_fn(|k| {
            let [m, n] = self.velocities.map(|velocities| self.seconds * velocities[k]);
            let change = self.to[k] - self.from[k];
            // The ends are exact, and an even motion stays even.
            self.from[k] + s * change + s * back * (back * (m - change) - s * (n - change))
        })
    }

    /// Returns the velocities at a share of the time.
    fn velocity(&self, s: f64) -> [f64; 4] {
        std::array::from_fn(|k| {
            let [m, n] = self.velocities.map(|velocities| velocities[k]);
            let mean = (self.to[k] - self.from[k]) / self.seconds;
            let (m, n) = (m - mean, n - mean);
            mean + m * (1.0 - s) * (1.0 - 3.0 * s) + n * s * (3.0 * s - 2.0)
        })
    }
}

/// Returns the velocity of a monotone cubic at a keyframe between ways of so many seconds and such mean velocities.
fn between([before, after]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    if a * b <= 0.0 {
        return 0.0;
    }
    let [first, second] = [2.0 * after + before, after + 2.0 * before];
    (first + second) / (first / a + second / b)
}

/// Returns the velocity at the first or last keyframe. The nearest way comes first.
fn at_end([near, far]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    let velocity = ((2.0 * near + far) * a - near * b) / (near + far);
    if velocity * a <= 0.0 {
        0.0
    } else if a * b <= 0.0 && velocity.abs() > 3.0 * a.abs() {
        3.0 * a
    } else {
        velocity
    }
}

impl KeyframeMotion {
    /// Keys of a table that describes keyframes.
    pub(super) const KEYS: [&'static str; 5] = ["pivot", "axis", "keyframes", "interpolation", "rate"];

    /// Returns a motion at rest.
    #[must_use]
    pub const fn resting() -> Self {
        Self {
            pivot: DVec3::ZERO,
            axis: DVec3::Z,
            keyframes: Vec::new(),
            interpolation: Interpolation::Linear,
            rate: 0.0,
        }
    }

    /// Makes a rotation about `axis`, of any length but zero, through `pivot`, in metres, and a translation, as given by
    /// `keyframes`.
    ///
    /// # Errors
    /// Returns an error if the axis is zero. [`Scene::check`](crate::Scene::check) finds all other errors.
    pub fn new(pivot: DVec3, axis: DVec3, keyframes: Vec<Keyframe>) -> Result<Self, ValueError> {
        let axis = unit_axis(axis)?;
        Ok(Self {
            pivot,
            axis,
            keyframes,
            ..Self::resting()
        })
    }

    /// Sets the motion between keyframes.
    #[must_use]
    pub fn interpolated(self, interpolation: Interpolation) -> Self {
        Self { interpolation, ..self }
    }

    /// Adds a steady rotation about the axis, in radians per second, from the start to the end of the simulation.
    #[must_use]
    pub fn spinning(self, rate: f64) -> Self {
        Self { rate, ..self }
    }

    /// Checks the motion of points, given at rest.
    pub(super) fn check(&self, points: &[DVec3], time_step: f64) -> Result<(), ValueError> {
        PIVOT.check_vector(self.pivot)?;
        SPIN.check(self.rate)?;
        let before = std::iter::once(None).chain(self.keyframes.iter().map(Some));
        for (place, (last, key)) in before.zip(&self.keyframes).enumerate() {
            key.check(last)?;
            self.check_turn(place, time_step)?;
        }
        self.check_speed(points)
    }

    /// Checks the rotation in a time step before a keyframe.
    fn check_turn(&self, place: usize, time_step: f64) -> Result<(), ValueError> {
        let Some(before) = place.checked_sub(1) else {
            return Ok(());
        };
        let turn = (self.keyframes[place].angle - self.keyframes[before].angle).abs();
        let segment = self.segment(before);
        let fastest = shares().map(|s| segment.velocity(s)[0].abs()).fold(0.0, f64::max);
        let in_a_step = turn.min(fastest * time_step) + self.rate.abs() * time_step;
        if in_a_step > FASTEST_TURN {
            let message = format!(
                "before this keyframe the motion turns by {in_a_step:.1} rad per time step, but the limit is {FASTEST_TURN}; choose a shorter `time_step` or a later keyframe"
            );
            return Err(ValueError::new(KEY_ANGLE.name, message));
        }
        Ok(())
    }

    /// Checks that no point is faster than [`FASTEST_VERTEX`].
    pub(crate) fn check_speed(&self, points: &[DVec3]) -> Result<(), ValueError> {
        let from_axis = |point: &DVec3| self.axis.cross(*point - self.pivot).length();
        let radius = points.iter().map(from_axis).fold(0.0, f64::max);
        // The spin goes on without keyframes.
        let alone = (self.rate.abs() * radius, 0.0);
        let mut fastest = alone;
        for before in 0..self.keyframes.len().saturating_sub(1) {
            let (segment, begin) = (self.segment(before), self.keyframes[before].time);
            for s in shares() {
                let [turning, x, y, z] = segment.velocity(s);
                let (turning, moving) = (turning + self.rate, DVec3::new(x, y, z));
                if moving.length() + turning.abs() * radius <= FASTEST_VERTEX {
                    continue;
                }
                let time = begin + s * segment.seconds;
                let angle = segment.at(s)[0] + self.rate * time;
                let speed = |point: &DVec3| {
                    let arm = turned(*point - self.pivot, self.axis, angle);
                    (moving + self.axis.cross(arm) * turning).length()
                };
                let speed = points.iter().map(speed).fold(0.0, f64::max);
                if speed > fastest.0 {
                    fastest = (speed, begin);
                }
            }
        }
        let (speed, time) = fastest;
        if speed <= FASTEST_VERTEX {
            return Ok(());
        }
        let field = if fastest == alone { SPIN.name } else { "keyframes" };
        let message = format!(
            "a vertex moves at {speed:.0} m/s from {time:.3} s on, but must not be faster than {FASTEST_VERTEX} m/s; \
             keyframes are for motions, and code can jump with `Simulation::teleport`"
        );
        Err(ValueError::new(field, message))
    }

    /// Reads `pivot`, `axis`, `rate`, `interpolation` and `keyframes`, each with a time and optionally an angle and a
    /// translation.
    ///
    /// Refuses rotations of more than [`FASTEST_TURN`] in `time_step` seconds.
    pub(super) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let pivot = table.vector(&PIVOT)?.unwrap_or_default();
        let axis = table.vector(&AXIS)?.unwrap_or(DVec3::Z);
        let interpolation = table.choice("interpolation", &INTERPOLATIONS)?;
        let motion = Self::new(pivot, axis, Vec::new()).map_err(|error| table.placed(&error))?;
        let motion = motion.interpolated(interpolation.unwrap_or_default());
        let mut motion = motion.spinning(table.number(&SPIN)?.unwrap_or(0.0));
        for key in table.tables("keyframes")? {
            key.expect_keys(&["time", "angle", "translation"])?;
            let next = Keyframe {
                time: key.required_number(&KEY_TIME)?,
                angle: key.number(&KEY_ANGLE)?.unwrap_or(0.0),
                translation: key.vector(&TRANSLATION)?.unwrap_or_default(),
            };
            let checked = next.check(motion.keyframes.last());
            checked.map_err(|error| key.placed(&error))?;
            motion.keyframes.push(next);
            let turn = motion.check_turn(motion.keyframes.len() - 1, time_step);
            turn.map_err(|error| key.placed(&error))?;
        }
        if interpolation.is_some() && motion.keyframes.is_empty() {
            let message = "`interpolation` is for keyframes, but there is none".to_owned();
            return Err(table.error("interpolation", message));
        }
        Ok(motion)
    }

    /// Returns the motion from a keyframe to the next one.
    fn segment(&self, before: usize) -> Segment {
        let [a, b] = [&self.keyframes[before], &self.keyframes[before + 1]];
        let (from, to, seconds) = (a.values(), b.values(), b.time - a.time);
        let mean = std::array::from_fn(|k| (to[k] - from[k]) / seconds);
        let velocities = match self.interpolation {
            Interpolation::Linear => [mean; 2],
            Interpolation::Smooth => [[0.0; 4]; 2],
            Interpolation::Spline => [self.velocity_at(before, mean), self.velocity_at(before + 1, mean)],
        };
        Segment {
            seconds,
            from,
            to,
            velocities,
        }
    }

    /// Returns the velocity of a spline at a keyframe; `only` is that of a motion with two keyframes.
    fn velocity_at(&self, place: usize, only: [f64; 4]) -> [f64; 4] {
        let keys = &self.keyframes;
        let span = |before: usize| {
            let [a, b] = [&keys[before], &keys[before + 1]];
            let (from, to, seconds) = (a.values(), b.values(), b.time - a.time);
            (seconds, std::array::from_fn::<f64, 4, _>(|k| (to[k] - from[k]) / seconds))
        };
        let last = keys.len() - 1;
        let (is_end, spans) = match place {
            _ if last == 1 => return only,
            0 => (true, [span(0), span(1)]),
            _ if place == last => (true, [span(last - 1), span(last - 2)]),
            _ => (false, [span(place - 1), span(place)]),
        };
        let joined = if is_end { at_end } else { between };
        let [(near, a), (far, b)] = spans;
        std::array::from_fn(|k| joined([near, far], [a[k], b[k]]))
    }

    pub(crate) fn pose(&self, time: f64) -> Pose {
        let keys = &self.keyframes;
        let next = keys.partition_point(|key| key.time <= time);
        let key = match (next.checked_sub(1).map(|k| keys[k]), keys.get(next)) {
            (None, None) => Keyframe::default(),
            (Some(key), None) => key,
            (None, Some(&key)) => key,
            (Some(a), Some(b)) => {
                let s = (time - a.time) / (b.time - a.time);
                let straight = |s: f64| Keyframe {
                    time,
                    angle: a.angle + s * (b.angle - a.angle),
                    translation: a.translation + s * (b.translation - a.translation),
                };
                match self.interpolation {
                    Interpolation::Linear => straight(s),
                    Interpolation::Smooth => straight(s * s * (3.0 - 2.0 * s)),
                    Interpolation::Spline => {
                        let [angle, x, y, z] = self.segment(next - 1).at(s);
                        let translation = DVec3::new(x, y, z);
                        Keyframe {
                            time,
                            angle,
                            translation,
                        }
                    }
                }
            }
        };
        let angle = if self.rate == 0.0 {
            key.angle
        } else {
            key.angle + self.rate * time
        };
        Pose::moved(self.pivot, self.axis, angle, key.translation)
    }
}

/// The shares of a way at which speeds are measured.
fn shares() -> impl Iterator<Item = f64> {
    (0..=MEASURED).map(|share| f64::from(share) / f64::from(MEASURED))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn quarter_turn() -> KeyframeMotion {
        KeyframeMotion {
            pivot: DVec3::X,
            axis: DVec3::Z,
            keyframes: vec![
                Keyframe {
                    time: 1.0,
                    ..Keyframe::default()
                },
                Keyframe {
                    time: 2.0,
                    angle: FRAC_PI_2,
                    translation: DVec3::Z,
                },
            ],
            ..KeyframeMotion::resting()
        }
    }

    fn at(times: &[(f64, f64)], interpolation: Interpolation) -> KeyframeMotion {
        let key = |&(time, x): &(f64, f64)| Keyframe {
            time,
            angle: -x,
            translation: DVec3::X * x,
        };
        let keyframes = times.iter().map(key).collect();
        let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keyframes).unwrap();
        motion.interpolated(interpolation)
    }

    #[test]
    fn a_steady_motion_stays_steady_however_densely_it_is_keyed() {
        let keys: Vec<(f64, f64)> = (0..=30).map(|k| f64::from(k) / 30.0).map(|time| (time, 2.0 * time)).collect();
        for interpolation in [Interpolation::Linear, Interpolation::Spline] {
            let motion = at(&keys, interpolation);
            for time in (0..=1000).map(|k| f64::from(k) / 1000.0) {
                let pose = motion.pose(time);
                assert!((pose.centre().x - 2.0 * time).abs() < 1e-14, "{interpolation:?} at {time}");
                assert!((pose.angle + 2.0 * time).abs() < 1e-14);
            }
        }
        let smooth = at(&keys, Interpolation::Smooth);
        let speed = |time: f64| (smooth.pose(time + 1e-6).centre().x - smooth.pose(time).centre().x) / 1e-6;
        assert!(speed(0.5) < 1e-3 && speed(0.5 + 1.0 / 60.0) > 2.9);
    }

    proptest::proptest! {
        #[test]
        fn a_spline_goes_through_its_keyframes_without_a_jump_of_its_velocity_and_never_beyond_them(
            steps in proptest::collection::vec((0.01_f64..2.0, -3.0_f64..3.0), 2..8),
        ) {
            let mut time = 0.0;
            let keys: Vec<(f64, f64)> = steps.iter().map(|&(step, x)| { time += step; (time, x) }).collect();
            let motion = at(&keys, Interpolation::Spline);
            for (place, pair) in keys.windows(2).enumerate() {
                let [(begin, a), (end, b)] = [pair[0], pair[1]];
                proptest::prop_assert_eq!(motion.pose(begin).centre().x, a);
                let segment = motion.segment(place);
                for s in shares() {
                    let x = motion.pose(begin + s * (end - begin)).centre().x;
                    proptest::prop_assert!(x >= a.min(b) - 1e-12 && x <= a.max(b) + 1e-12, "{} beyond {} and {}", x, a, b);
                    let near = if s < 0.5 { s + 1e-6 } else { s - 1e-6 };
                    let measured = (segment.at(near)[1] - segment.at(s)[1]) / ((near - s) * segment.seconds);
                    let scale = 1.0 + ((b - a) / segment.seconds).abs();
                    proptest::prop_assert!((measured - segment.velocity(s)[1]).abs() < 1e-4 * scale);
                }
                if place > 0 {
                    let before = motion.segment(place - 1);
                    proptest::prop_assert_eq!(before.velocities[1], segment.velocities[0]);
                }
            }
        }
    }

    #[test]
    fn a_spin_is_added_to_the_keyframes_and_does_not_end() {
        let motion = at(&[(1.0, 0.0), (2.0, -1.0)], Interpolation::Linear).spinning(3.0);
        assert_eq!([0.5, 1.5, 3.0].map(|time| motion.pose(time).angle), [1.5, 5.0, 10.0]);
    }

    #[test]
    fn a_motion_with_a_point_above_the_fastest_speed_is_refused() {
        let message = |motion: &KeyframeMotion, points: &[DVec3]| motion.check(points, 1e-3).map_err(|error| error.message);
        let jump = at(&[(0.0, 0.0), (0.2, 0.0), (0.201, 2.0)], Interpolation::Linear);
        let error = message(&jump, &[DVec3::ZERO]).unwrap_err();
        assert!(
            error.starts_with("a vertex moves at 2000 m/s from 0.200 s on, but must not be faster than 100 m/s"),
            "{error}"
        );
        // A wheel: its rim is fast, its hub is not.
        let wheel = KeyframeMotion::new(DVec3::X, DVec3::Z, Vec::new()).unwrap().spinning(90.0);
        assert_eq!(message(&wheel, &[DVec3::X, 2.0 * DVec3::X]), Ok(()));
        assert!(
            message(&wheel, &[3.0 * DVec3::X])
                .unwrap_err()
                .starts_with("a vertex moves at 180 m/s")
        );
        // The rotation and the translation cancel out.
        let back = Keyframe {
            time: 1.0,
            angle: 80.0,
            translation: DVec3::Y * -80.0,
        };
        let turned = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![Keyframe::default(), back]).unwrap();
        assert_eq!(message(&turned, &[DVec3::X * 1e-3]), Ok(()));
        assert!(message(&turned, &[DVec3::X]).is_err());
    }

    #[test]
    fn poses_go_from_key_to_key_and_rest_outside() {
        let motion = quarter_turn();
        let point = DVec3::new(3.0, 0.0, 0.0);
        assert_eq!(motion.pose(0.0).apply(point), point);
        assert_eq!(motion.pose(1.0).apply(point), point);
        let end = DVec3::new(1.0, 2.0, 1.0);
        assert!(motion.pose(2.0).apply(point).distance(end) < 1e-15);
        assert_eq!(motion.pose(9.0), motion.pose(2.0));
        assert_eq!(motion.pose(1.5).angle, 0.5 * FRAC_PI_2);
    }

    #[test]
    fn carrying_a_point_is_moving_the_body_under_it() {
        let motion = quarter_turn();
        let point = DVec3::new(0.3, -2.0, 0.7);
        let [a, b] = [motion.pose(1.2), motion.pose(1.7)];
        assert!(a.carry(&b, a.apply(point)).distance(b.apply(point)) < 1e-14);
        assert_eq!(a.carry(&a, point), point);
    }
}
