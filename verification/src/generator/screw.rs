//! Bodies in screw motion, as numbers.

use super::Choices;
use selvedge_core::glam::DVec3;
use selvedge_core::paths::RigidMotion;
use std::f64::consts::{PI, TAU};

/// A body that turns by an angle about an axis, which moves on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// A point of the axis.
    pub centre: DVec3,
    /// Along it, of any length.
    pub axis: DVec3,
    /// In radians.
    pub angle: f64,
    /// Of the axis.
    pub translation: DVec3,
}

/// In [-1, 1].
fn unit(choices: &mut Choices<'_>) -> f64 {
    choices.word() as f64 / u64::MAX as f64 * 2.0 - 1.0
}

/// A point of the cube from −1 to 1.
pub fn vector(choices: &mut Choices<'_>) -> DVec3 {
    let [x, y, z] = [(); 3].map(|()| unit(choices));
    DVec3::new(x, y, z)
}

impl Screw {
    /// Angles that the usual choice is made from: at most this share of each, either way.
    pub const ANGLES: [f64; 8] = [0.0, 1e-9, 0.01, 1.0, PI, TAU, 20.0, 1e6];

    /// Near and far from the origin, with axes of any length.
    pub fn choose(angles: &[f64], choices: &mut Choices<'_>) -> Self {
        let [centre, axis, translation] = [(); 3].map(|()| vector(choices));
        let angle = unit(choices) * choices.pick(angles);
        let axis = choices.pick(&[axis, DVec3::Z, axis * 1e-12, axis * 1e200]);
        Self {
            centre: centre * choices.pick(&[0.0, 1.0, 1e3, 1e6]),
            axis: if axis == DVec3::ZERO { DVec3::X } else { axis },
            angle,
            translation: translation * choices.pick(&[0.0, 1.0, 1e3]),
        }
    }

    /// As core has it.
    ///
    /// # Panics
    /// If a number is not finite, or the angle is beyond what a body may turn.
    #[must_use]
    pub fn motion(&self) -> RigidMotion {
        RigidMotion::new(self.centre, self.axis, self.angle, self.translation).expect("numbers in range")
    }
}
