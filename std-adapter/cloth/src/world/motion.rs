//! Motions of bodies and pins: along keyframes, as an [animation](super::animation), or [driven](super::driven) by the caller.

use super::Animation;
use super::placement::{Placement, TRANSLATION};
use crate::input::{ANGLE, Field, LARGEST_COORDINATE, LARGEST_TIME, LENGTH, RATIO, SceneError, TIME, Table, ValueError};
use libm::{cos, sin};
use selvedge_core::glam::DVec3;

/// The motion of a body or of pins.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyMotion {
    /// A rigid motion along keyframes.
    Keyframes(KeyframeMotion),
    /// A motion per vertex: a body that deforms.
    Animated(Animation),
    /// The caller moves the body from here. Without a call before a step it rests in that step. See
    /// [`Simulation::place_body`](crate::Simulation::place_body).
    Driven(Placement),
}

impl BodyMotion {
    /// # Errors
    /// Returns an error if a motion turns or jumps too far in a step, or has a number out of range or the wrong number of
    /// vertices.
    pub(crate) fn check(&self, vertices: usize, time_step: f64) -> Result<(), ValueError> {
        match self {
            Self::Keyframes(motion) => motion.check(time_step),
            Self::Animated(animation) => animation.check(vertices, time_step),
            Self::Driven(placement) => placement.checked().map(drop),
        }
    }
}

impl BodyMotion {
    /// Keys of a table that describes a motion.
    pub(crate) const KEYS: [&'static str; 4] = ["pivot", "axis", "keyframes", "driven"];

    /// Reads a motion: keyframes, or `driven` from the rest placement.
    pub(crate) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        if !table.flag("driven")? {
            return KeyframeMotion::read(table, time_step).map(Self::Keyframes);
        }
        match KeyframeMotion::KEYS.into_iter().find(|key| table.has(key)) {
            None => Ok(Self::Driven(Placement::default())),
            Some(key) => Err(table.error(key, format!("a driven motion has no `{key}`"))),
        }
    }
}

impl From<Animation> for BodyMotion {
    fn from(animation: Animation) -> Self {
        Self::Animated(animation)
    }
}

impl From<KeyframeMotion> for BodyMotion {
    fn from(motion: KeyframeMotion) -> Self {
        Self::Keyframes(motion)
    }
}

/// A rigid motion: a rotation about an axis through a pivot, then a translation.
///
/// Both are smooth between keyframes, with zero velocity at each keyframe. The body rests before the first keyframe and after the
/// last.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyframeMotion {
    pivot: DVec3,
    axis: DVec3,
    keyframes: Vec<Keyframe>,
}

/// The shortest time between keyframes, in seconds: far above the resolution of the clock.
const CLOSEST_KEYS: f64 = 1e-6;

/// The largest rotation in a time step, in radians: nearly a whole turn. Steps with contact are cut until a part turns by a
/// thousandth of that.
const FASTEST_TURN: f64 = 6.0;

const PIVOT: Field = Field::vector("pivot", LENGTH, LARGEST_COORDINATE);
pub(super) const AXIS: Field = Field::vector("axis", RATIO, LARGEST_COORDINATE);
pub(crate) const KEY_TIME: Field = Field::new("time", TIME, 0.0, LARGEST_TIME);
pub(super) const KEY_ANGLE: Field = Field::new("angle", ANGLE, -1e4, 1e4);

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
    fn check(&self, last: Option<&Self>, time_step: f64) -> Result<(), ValueError> {
        KEY_ANGLE.check(self.angle)?;
        TRANSLATION.check_vector(self.translation)?;
        check_key_time(self.time, last.map(|last| last.time))?;
        let Some(last) = last else {
            return Ok(());
        };
        // The angular velocity in the middle of a segment is 1.5 times the mean.
        let turn = (self.angle - last.angle).abs();
        let in_a_step = turn.min(1.5 * turn * time_step / (self.time - last.time));
        if in_a_step > FASTEST_TURN {
            let message = format!(
                "before this keyframe the motion turns by {in_a_step:.1} rad per time step, but the limit is {FASTEST_TURN}; choose a shorter `time_step` or a later keyframe"
            );
            return Err(ValueError::new(KEY_ANGLE.name, message));
        }
        Ok(())
    }
}

/// The placement of a moving body at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    /// A placement that is applied before everything else.
    base: Option<Placement>,
    pivot: DVec3,
    axis: DVec3,
    pub(crate) angle: f64,
    translation: DVec3,
    /// The progress along separate paths of all points. The other fields then have no meaning.
    pub(super) deformed: Option<f64>,
}

impl KeyframeMotion {
    /// Keys of a table that describes keyframes.
    const KEYS: [&'static str; 3] = ["pivot", "axis", "keyframes"];

    /// Returns a motion at rest.
    #[must_use]
    pub const fn resting() -> Self {
        Self {
            pivot: DVec3::ZERO,
            axis: DVec3::Z,
            keyframes: Vec::new(),
        }
    }

    /// Makes a rotation about `axis`, of any length but zero, through `pivot`, in metres, and a translation, as given by
    /// `keyframes`.
    ///
    /// # Errors
    /// Returns an error if the axis is zero. [`Scene::check`](crate::Scene::check) finds all other errors.
    pub fn new(pivot: DVec3, axis: DVec3, keyframes: Vec<Keyframe>) -> Result<Self, ValueError> {
        let axis = unit_axis(axis)?;
        Ok(Self { pivot, axis, keyframes })
    }

    fn check(&self, time_step: f64) -> Result<(), ValueError> {
        PIVOT.check_vector(self.pivot)?;
        let before = std::iter::once(None).chain(self.keyframes.iter().map(Some));
        before
            .zip(&self.keyframes)
            .try_for_each(|(last, key)| key.check(last, time_step))
    }

    /// Reads `pivot`, `axis` and `[[keyframes]]`, each with a time and optionally an angle and a translation.
    ///
    /// Refuses rotations of more than [`FASTEST_TURN`] in `time_step` seconds.
    fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let pivot = table.vector(&PIVOT)?.unwrap_or_default();
        let axis = table.vector(&AXIS)?.unwrap_or(DVec3::Z);
        let mut motion = Self::new(pivot, axis, Vec::new()).map_err(|error| table.placed(&error))?;
        for key in table.tables("keyframes")? {
            key.expect_keys(&["time", "angle", "translation"])?;
            let next = Keyframe {
                time: key.required_number(&KEY_TIME)?,
                angle: key.number(&KEY_ANGLE)?.unwrap_or(0.0),
                translation: key.vector(&TRANSLATION)?.unwrap_or_default(),
            };
            let checked = next.check(motion.keyframes.last(), time_step);
            checked.map_err(|error| key.placed(&error))?;
            motion.keyframes.push(next);
        }
        Ok(motion)
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
                let s = s * s * (3.0 - 2.0 * s);
                Keyframe {
                    time,
                    angle: a.angle + s * (b.angle - a.angle),
                    translation: a.translation + s * (b.translation - a.translation),
                }
            }
        };
        Pose {
            base: None,
            pivot: self.pivot,
            axis: self.axis,
            angle: key.angle,
            translation: key.translation,
            deformed: None,
        }
    }
}

impl Pose {
    /// Returns the pose of a body at this placement.
    pub(super) fn standing(placement: Placement) -> Self {
        Self {
            base: Some(placement),
            pivot: placement.translation,
            axis: DVec3::Z,
            angle: 0.0,
            translation: DVec3::ZERO,
            deformed: None,
        }
    }

    /// Adds a rotation about an axis through the body's origin, and a translation.
    pub(super) fn turned_and_moved(self, axis: DVec3, angle: f64, translation: DVec3) -> Self {
        Self {
            axis,
            angle,
            translation,
            ..self
        }
    }

    /// Returns the pose of points on separate paths, at the progress `along`.
    pub(super) fn deformed(along: f64) -> Self {
        Self {
            deformed: Some(along),
            ..Self::standing(Placement::default())
        }
    }

    pub(crate) fn is_rigid(&self) -> bool {
        self.deformed.is_none()
    }

    /// Returns the fixed point of the rotation, if the pose is [rigid](Self::is_rigid).
    pub(crate) fn centre(&self) -> DVec3 {
        self.pivot + self.translation
    }

    /// Maps a point of the body at rest to its position, if the pose is [rigid](Self::is_rigid).
    pub(crate) fn apply(&self, point: DVec3) -> DVec3 {
        let point = self.base.map_or(point, |base| base.apply(point));
        if self.angle == 0.0 {
            return point + self.translation;
        }
        self.pivot + turned(point - self.pivot, self.axis, self.angle) + self.translation
    }

    /// Maps a point that moves with the body to its position when the pose becomes `later`, if both are [rigid](Self::is_rigid).
    pub(crate) fn carry(&self, later: &Self, point: DVec3) -> DVec3 {
        if self == later {
            return point;
        }
        // Both poses belong to one motion: they share everything but angle and translation.
        let from_pivot = point - self.translation - self.pivot;
        let turned = turned(from_pivot, self.axis, later.angle - self.angle);
        self.pivot + turned + later.translation
    }
}

/// Rotates a vector about a unit axis (Rodrigues).
fn turned(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sine, cosine) = (sin(angle), cos(angle));
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
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
        }
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
