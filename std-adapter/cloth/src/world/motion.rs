//! Keyframed motion of bodies and pins.

use crate::input::{ANGLE, LARGEST_COORDINATE, LARGEST_TIME, LENGTH, RATIO, SceneError, TIME, Table};
use libm::{cos, sin};
use selvedge_core::glam::DVec3;

/// A rigid motion: turns about an axis through a pivot, then moves along. Between keyframes both go smoothly, at rest at each
/// keyframe; before the first and after the last nothing moves.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidMotion {
    pivot: DVec3,
    axis: DVec3,
    keys: Vec<Key>,
}

/// In seconds: far above the resolution of the clock.
const CLOSEST_KEYS: f64 = 1e-6;

/// In radians a time step, nearly a whole turn: steps with contact are cut until a part turns by a thousandth of it.
const FASTEST_TURN: f64 = 6.0;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Key {
    time: f64,
    angle: f64,
    translation: DVec3,
}

/// Where a rigid motion has taken everything at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pivot: DVec3,
    axis: DVec3,
    pub(crate) angle: f64,
    translation: DVec3,
}

impl RigidMotion {
    /// Keys of a table that describes a motion.
    pub(super) const KEYS: [&'static str; 3] = ["pivot", "axis", "keyframes"];

    /// No motion at all.
    #[must_use]
    pub const fn resting() -> Self {
        Self {
            pivot: DVec3::ZERO,
            axis: DVec3::Z,
            keys: Vec::new(),
        }
    }

    /// Reads `pivot`, `axis` and `[[keyframes]]`, each with a time and perhaps an angle and a translation.
    ///
    /// What turns by more than [`FASTEST_TURN`] in `time_step` seconds is refused.
    pub(crate) fn read(table: &Table<'_>, time_step: f64) -> Result<Self, SceneError> {
        let pivot = table.vector("pivot", LENGTH, LARGEST_COORDINATE)?.unwrap_or_default();
        let axis = table.vector("axis", RATIO, LARGEST_COORDINATE)?.unwrap_or(DVec3::Z);
        let Some(axis) = axis.try_normalize() else {
            let message = "`axis` must not be zero: it is the direction to turn about".to_owned();
            return Err(table.error("axis", message));
        };
        let mut keys: Vec<Key> = Vec::new();
        for key in table.tables("keyframes")? {
            key.expect_keys(&["time", "angle", "translation"])?;
            let time = key.required_number("time", TIME, 0.0..=LARGEST_TIME)?;
            if keys.last().is_some_and(|last| time < last.time + CLOSEST_KEYS) {
                let message = "keyframes must be in order: each `time` a microsecond or more later than the one before";
                return Err(key.error("time", message.to_owned()));
            }
            let next = Key {
                time,
                angle: key.number("angle", ANGLE, -1e4..=1e4)?.unwrap_or(0.0),
                translation: key.vector("translation", LENGTH, LARGEST_COORDINATE)?.unwrap_or_default(),
            };
            if let Some(last) = keys.last() {
                // Half-way it is half as fast again as on average.
                let turn = (next.angle - last.angle).abs();
                let in_a_step = turn.min(1.5 * turn * time_step / (next.time - last.time));
                if in_a_step > FASTEST_TURN {
                    let message = format!(
                        "up to this keyframe it turns by {in_a_step:.1} rad in a time step, but must not by more than {FASTEST_TURN}; take a shorter `time_step`, or more time"
                    );
                    return Err(key.error("angle", message));
                }
            }
            keys.push(next);
        }
        Ok(Self { pivot, axis, keys })
    }

    /// Where everything is at a time.
    pub(crate) fn pose(&self, time: f64) -> Pose {
        let next = self.keys.partition_point(|key| key.time <= time);
        let key = match (next.checked_sub(1).map(|k| self.keys[k]), self.keys.get(next)) {
            (None, None) => Key::default(),
            (Some(key), None) => key,
            (None, Some(&key)) => key,
            (Some(a), Some(b)) => {
                let s = (time - a.time) / (b.time - a.time);
                let s = s * s * (3.0 - 2.0 * s);
                Key {
                    time,
                    angle: a.angle + s * (b.angle - a.angle),
                    translation: a.translation + s * (b.translation - a.translation),
                }
            }
        };
        Pose {
            pivot: self.pivot,
            axis: self.axis,
            angle: key.angle,
            translation: key.translation,
        }
    }
}

impl Pose {
    /// Where a point of the body at rest is.
    pub(crate) fn apply(&self, point: DVec3) -> DVec3 {
        if self.angle == 0.0 {
            return point + self.translation;
        }
        self.pivot + turned(point - self.pivot, self.axis, self.angle) + self.translation
    }

    /// Where a point that is on the body now goes when the body takes the pose `later`.
    pub(crate) fn carry(&self, later: &Self, point: DVec3) -> DVec3 {
        if self == later {
            return point;
        }
        // Both poses belong to one motion: they share pivot and axis.
        let from_pivot = point - self.translation - self.pivot;
        let turned = turned(from_pivot, self.axis, later.angle - self.angle);
        self.pivot + turned + later.translation
    }
}

/// Turned about a unit axis (Rodrigues).
fn turned(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sine, cosine) = (sin(angle), cos(angle));
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn quarter_turn() -> RigidMotion {
        RigidMotion {
            pivot: DVec3::X,
            axis: DVec3::Z,
            keys: vec![
                Key {
                    time: 1.0,
                    ..Key::default()
                },
                Key {
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
