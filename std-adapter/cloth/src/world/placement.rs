//! The placement of a rigid body.

use crate::input::{Field, LARGEST_COORDINATE, LENGTH, ValueError};
use libm::{atan2, cos, sin};
use selvedge_core::glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

pub(super) const TRANSLATION: Field = Field::vector("translation", LENGTH, LARGEST_COORDINATE);

/// A rigid placement: points are rotated about the origin, then moved.
///
/// ```
/// use selvedge_cloth::Placement;
/// use selvedge_cloth::glam::{DQuat, DVec3};
///
/// let placement = Placement { rotation: DQuat::from_rotation_z(std::f64::consts::PI), translation: DVec3::X };
/// assert!(placement.apply(DVec3::X).length() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    /// A unit quaternion. A simulation normalises it, and refuses only zero.
    pub rotation: DQuat,
    /// The translation, in metres.
    pub translation: DVec3,
}

crate::identify!(Placement { rotation, translation });

impl Placement {
    /// Returns a placement with a rotation, then a translation in metres.
    #[must_use]
    pub const fn new(rotation: DQuat, translation: DVec3) -> Self {
        Self { rotation, translation }
    }

    /// Returns a placement without rotation; `translation` is in metres.
    #[must_use]
    pub const fn at(translation: DVec3) -> Self {
        Self::new(DQuat::IDENTITY, translation)
    }

    /// Maps a point of the body at rest to its position.
    #[must_use]
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// Maps a position to the point at rest. Without rotation and translation the bits are the same.
    pub(crate) fn apply_inverse(&self, place: DVec3) -> DVec3 {
        self.rotation.inverse() * (place - self.translation)
    }

    /// Returns the placement after `first` and then this one.
    pub(crate) fn after(&self, first: &Self) -> Self {
        Self {
            rotation: self.rotation * first.rotation,
            translation: self.apply(first.translation),
        }
    }

    pub(crate) fn checked(&self) -> Result<Self, ValueError> {
        TRANSLATION.check_vector(self.translation)?;
        let length = self.rotation.length();
        if !(length > 0.0 && length.is_finite()) {
            let message = format!("`rotation` must be a quaternion of length one, but its length is {length}");
            return Err(ValueError::new("rotation", message));
        }
        Ok(Self {
            rotation: self.rotation * length.recip(),
            ..*self
        })
    }

    /// Returns the axis and the angle, at most half a turn, of the rotation to `later`.
    pub(super) fn turn_to(&self, later: &Self) -> (DVec3, f64) {
        let turn = later.rotation * self.rotation.inverse();
        // A rotation has two quaternions; this one turns the shorter way.
        let turn = if turn.w < 0.0 { -turn } else { turn };
        let along = turn.xyz();
        // Functions of `libm` give the same bits on every platform.
        (along.normalize_or(DVec3::Z), 2.0 * atan2(along.length(), turn.w))
    }

    pub(super) fn turned_and_moved(&self, axis: DVec3, angle: f64, translation: DVec3) -> Self {
        let [sine, cosine] = [sin(0.5 * angle), cos(0.5 * angle)];
        let turn = DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine);
        Self {
            rotation: (turn * self.rotation).normalize(),
            translation: self.translation + translation,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_by_the_way_to_another_placement_leads_there() {
        let from = Placement::new(DQuat::from_rotation_x(0.3), DVec3::X);
        for angle in [0.0, 1e-9, 0.5, 3.0, 4.0, -2.0] {
            let to = Placement::new(DQuat::from_rotation_y(angle) * from.rotation, DVec3::Y);
            let (axis, turn) = from.turn_to(&to);
            assert!((0.0..=std::f64::consts::PI + 1e-12).contains(&turn));
            let there = from.turned_and_moved(axis, turn, to.translation - from.translation);
            let point = DVec3::new(0.3, -0.5, 0.7);
            assert!(there.apply(point).distance(to.apply(point)) < 1e-14, "{angle}");
        }
    }

    #[test]
    fn what_is_no_rotation_is_refused_and_any_length_is_made_one() {
        let of = |rotation| Placement {
            rotation,
            ..Placement::default()
        };
        for length in [0.0, f64::NAN, f64::INFINITY] {
            let error = of(DQuat::IDENTITY * length).checked().unwrap_err();
            assert_eq!(error.field, "rotation");
        }
        assert_eq!(of(DQuat::IDENTITY * 3.0).checked(), Ok(Placement::default()));
        assert!(Placement::at(DVec3::splat(f64::NAN)).checked().is_err());
    }
}
