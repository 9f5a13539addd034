//! Bodies in screw motion, as numbers.

use super::Choices;
use selvedge_core::glam::DVec3;
use selvedge_core::paths::RigidMotion;
use std::f64::consts::{PI, TAU};

/// A body that rotates by an angle about an axis, while it translates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// A point of the axis.
    pub centre: DVec3,
    /// The direction of the axis, of any length.
    pub axis: DVec3,
    /// The angle, in radians.
    pub angle: f64,
    pub translation: DVec3,
}

/// Returns a number in [-1, 1].
fn unit(choices: &mut Choices<'_>) -> f64 {
    choices.word() as f64 / u64::MAX as f64 * 2.0 - 1.0
}

/// Returns a point of the cube from −1 to 1.
pub fn vector(choices: &mut Choices<'_>) -> DVec3 {
    let [x, y, z] = [(); 3].map(|()| unit(choices));
    DVec3::new(x, y, z)
}

impl Screw {
    /// Chooses a motion, near or far from the origin, with an axis of any length.
    pub fn choose(choices: &mut Choices<'_>) -> Self {
        let [centre, axis, translation] = [(); 3].map(|()| vector(choices));
        let angle = unit(choices) * choices.pick(&[0.0, 1e-9, 0.01, 1.0, PI, TAU, 20.0, 1e6]);
        let axis = choices.pick(&[axis, DVec3::Z, axis * 1e-12, axis * 1e200]);
        Self {
            centre: centre * choices.pick(&[0.0, 1.0, 1e3, 1e6]),
            axis: if axis == DVec3::ZERO { DVec3::X } else { axis },
            angle,
            translation: translation * choices.pick(&[0.0, 1.0, 1e3]),
        }
    }

    /// Returns the motion in core's form.
    ///
    /// # Panics
    /// Panics if a number is not finite, or the angle is larger than a body may rotate.
    pub fn motion(&self) -> RigidMotion {
        RigidMotion::new(self.centre, self.axis, self.angle, self.translation).expect("numbers in range")
    }
}
