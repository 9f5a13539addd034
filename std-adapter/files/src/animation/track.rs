//! One property of a node over time.

use libm::{acos, sin};
use selvedge_core::glam::DQuat;

/// A property that a track changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AnimatedProperty {
    Translation,
    /// A quaternion: x, y, z, w.
    Rotation,
    Scale,
    /// The weight of each morph target.
    Weights,
}

/// The values between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interpolation {
    /// The earlier key.
    Step,
    /// The straight way, or for rotations the shorter arc.
    Linear,
    /// A cubic: each key has a tangent before, a value and a tangent after it.
    Cubic,
}

/// One property of one node, on keys.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Track {
    /// The node, or the part of the figure whose weights change.
    pub(super) node: usize,
    pub(super) property: AnimatedProperty,
    pub(super) interpolation: Interpolation,
    /// The times of the keys in seconds, one or more, ascending.
    pub(super) times: Vec<f64>,
    /// The values: [`width`](Self::width) numbers for each key, three times as many for cubics.
    pub(super) values: Vec<f64>,
    pub(super) width: usize,
}

impl Track {
    /// Replaces `values` by those at a time. They are constant before the first key and after the last.
    pub(super) fn sample(&self, time: f64, values: &mut Vec<f64>) {
        values.clear();
        let next = self.times.partition_point(|&key| key <= time);
        let last = self.times.len() - 1;
        match next.checked_sub(1) {
            None => values.extend_from_slice(self.value(0)),
            Some(before) if before == last || self.interpolation == Interpolation::Step => {
                values.extend_from_slice(self.value(before));
            }
            Some(before) => {
                let length = self.times[next] - self.times[before];
                let share = (time - self.times[before]) / length;
                self.between(before, share, length, values);
            }
        }
        if self.property == AnimatedProperty::Rotation {
            // Numbers of files are rounded, and a cubic may go through zero.
            let rotation = DQuat::from_slice(values);
            let length = rotation.length();
            let rotation = if length > 0.0 && length.is_finite() {
                rotation * length.recip()
            } else {
                DQuat::IDENTITY
            };
            values.copy_from_slice(&rotation.to_array());
        }
    }

    fn value(&self, key: usize) -> &[f64] {
        match self.interpolation {
            Interpolation::Cubic => self.part(3 * key + 1),
            _ => self.part(key),
        }
    }

    fn part(&self, index: usize) -> &[f64] {
        &self.values[index * self.width..][..self.width]
    }

    fn between(&self, key: usize, share: f64, length: f64, values: &mut Vec<f64>) {
        let (from, to) = (self.value(key), self.value(key + 1));
        if self.interpolation == Interpolation::Cubic {
            let (leaving, arriving) = (self.part(3 * key + 2), self.part(3 * key + 3));
            let [s, s2] = [share, share * share];
            let s3 = s2 * s;
            let weights = [2.0 * s3 - 3.0 * s2 + 1.0, (s3 - 2.0 * s2 + s) * length];
            let [to_weight, arriving_weight] = [3.0 * s2 - 2.0 * s3, (s3 - s2) * length];
            values.extend(
                (0..self.width)
                    .map(|k| weights[0] * from[k] + weights[1] * leaving[k] + to_weight * to[k] + arriving_weight * arriving[k]),
            );
        } else if self.property == AnimatedProperty::Rotation {
            values.extend(arc(DQuat::from_slice(from), DQuat::from_slice(to), share).to_array());
        } else {
            values.extend(from.iter().zip(to).map(|(from, to)| from + share * (to - from)));
        }
    }
}

/// Returns a rotation on the shorter arc from one to another.
fn arc(from: DQuat, to: DQuat, share: f64) -> DQuat {
    let cosine = from.dot(to);
    let (to, cosine) = if cosine < 0.0 { (-to, -cosine) } else { (to, cosine) };
    // The two are so close that the chord is the arc to the last digits, and sines would be divided by nearly zero.
    if cosine > 1.0 - 1e-9 {
        return from + (to - from) * share;
    }
    // These functions have the same bits on every platform; glam's own may use the system's sines.
    let angle = acos(cosine.min(1.0));
    let [first, second] = [sin((1.0 - share) * angle), sin(share * angle)];
    (from * first + to * second) * sin(angle).recip()
}
