//! The state of a free rigid body, and its motion in a step.
//!
//! A body has the position of its centre of mass and a rotation, a velocity and an angular momentum. The angular momentum is kept
//! instead of the angular velocity, since it is what a body without load keeps: gyroscopic forces need no formula.

use libm::{atan2, cos, sin};
use selvedge_core::glam::{DMat3, DQuat, DVec3};
use std::ops::Range;
use std::sync::Arc;

/// The numbers of a [`RigidState`].
pub(crate) const NUMBERS: usize = 13;

/// The state of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RigidState {
    /// The rotation since rest, of length one.
    pub(crate) rotation: DQuat,
    /// The centre of mass, in m.
    pub(crate) centre: DVec3,
    /// Its velocity, in m/s.
    pub(crate) velocity: DVec3,
    /// The angular momentum about the centre of mass, in kg·m²/s.
    pub(crate) momentum: DVec3,
}

impl RigidState {
    pub(crate) fn numbers(&self) -> [f64; NUMBERS] {
        let [qx, qy, qz, qw] = self.rotation.to_array();
        let [[cx, cy, cz], [vx, vy, vz], [lx, ly, lz]] = [self.centre, self.velocity, self.momentum].map(|own| own.to_array());
        [qx, qy, qz, qw, cx, cy, cz, vx, vy, vz, lx, ly, lz]
    }

    pub(crate) fn from_numbers([qx, qy, qz, qw, cx, cy, cz, vx, vy, vz, lx, ly, lz]: [f64; NUMBERS]) -> Self {
        Self {
            rotation: DQuat::from_xyzw(qx, qy, qz, qw),
            centre: DVec3::new(cx, cy, cz),
            velocity: DVec3::new(vx, vy, vz),
            momentum: DVec3::new(lx, ly, lz),
        }
    }

    /// Returns the inertia about the centre of mass in the axes of the scene, from that in the axes of the body.
    pub(crate) fn turned(&self, inertia: &DMat3) -> DMat3 {
        turned(&DMat3::from_quat(self.rotation), inertia)
    }
}

/// Returns R·I·Rᵀ.
pub(crate) fn turned(rotation: &DMat3, inertia: &DMat3) -> DMat3 {
    *rotation * *inertia * rotation.transpose()
}

/// Returns the rotation by a vector: about its direction, by its length in radians.
pub(crate) fn rotation_by(vector: DVec3) -> DQuat {
    let angle = vector.length();
    if !(angle > 0.0) {
        return DQuat::IDENTITY;
    }
    // Functions of `libm` give the same bits on every platform.
    let along = vector * (sin(0.5 * angle) / angle);
    DQuat::from_xyzw(along.x, along.y, along.z, cos(0.5 * angle))
}

/// Returns the vector of a rotation, at most half a turn.
pub(crate) fn vector_of(rotation: DQuat) -> DVec3 {
    // A rotation has two quaternions; this one turns the shorter way.
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let along = rotation.xyz();
    let sine = along.length();
    if sine > 0.0 {
        along * (2.0 * atan2(sine, rotation.w) / sine)
    } else {
        DVec3::ZERO
    }
}

/// The axes of the scene along which and about which a body can move: 1 for a free axis, 0 for a locked one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Freedom {
    pub(crate) translation: DVec3,
    pub(crate) rotation: DVec3,
}

impl Freedom {
    /// All six.
    pub(crate) const ALL: Self = Self {
        translation: DVec3::ONE,
        rotation: DVec3::ONE,
    };

    /// Returns the inverse of an inertia for a body that turns about its free axes alone.
    pub(crate) fn inverse_inertia(&self, inertia: &DMat3) -> DMat3 {
        if self.rotation == DVec3::ONE {
            return inertia.inverse();
        }
        let [free, locked] = [self.rotation, DVec3::ONE - self.rotation].map(DMat3::from_diagonal);
        free * (free * *inertia * free + locked).inverse() * free
    }
}

/// The motion of a rigid body in a step: a displacement of its centre of mass, and a turn about it.
#[derive(Clone, Debug)]
pub(crate) struct RigidMotion {
    /// The body's vertices, as the scene numbers them.
    pub(crate) vertices: Range<usize>,
    /// The vertices of cloth that are pinned to the body.
    pub(crate) riders: Arc<[u32]>,
    /// Where its vertices and those are in the axes of the body, from its centre of mass.
    pub(crate) points: Arc<[DVec3]>,
    /// The mass, in kg.
    pub(crate) mass: f64,
    /// The start of the step.
    pub(crate) rotation: DQuat,
    pub(crate) centre: DVec3,
    /// The displacement of the centre of mass in m, and the vector of the turn in radians.
    pub(crate) displacement: DVec3,
    pub(crate) turn: DVec3,
}

impl RigidMotion {
    /// Returns whether another motion of the same body leads to the same place.
    pub(crate) fn leads_where(&self, other: &Self) -> bool {
        self.displacement == other.displacement && self.turn == other.turn
    }

    /// Returns the rotation since rest at the end of the step.
    pub(crate) fn end_rotation(&self) -> DQuat {
        if self.turn == DVec3::ZERO {
            self.rotation
        } else {
            (rotation_by(self.turn) * self.rotation).normalize()
        }
    }

    /// Returns the centre of mass at the end of the step.
    pub(crate) fn end_centre(&self) -> DVec3 {
        self.centre + self.displacement
    }

    /// Returns all vertices that move with the body: its own, and those of cloth that are pinned to it.
    pub(crate) fn members(&self) -> impl Iterator<Item = usize> + Clone + use<'_> {
        let riders = self.riders.iter().map(|&vertex| vertex as usize);
        self.vertices.clone().chain(riders)
    }

    /// Returns whether a vertex is one of its [members](Self::members).
    pub(crate) fn moves(&self, vertex: u32) -> bool {
        self.vertices.contains(&(vertex as usize)) || self.riders.contains(&vertex)
    }

    /// Returns the vertices of cloth that are pinned to the body, and where they are in its axes.
    pub(crate) fn rider_points(&self) -> impl Iterator<Item = (usize, DVec3)> + use<'_> {
        let points = self.points[self.vertices.len()..].iter();
        { self.riders.iter() }
            .zip(points)
            .map(|(&vertex, &point)| (vertex as usize, point))
    }

    /// Writes the positions of all [members](Self::members) at the end of the step.
    pub(crate) fn put(&self, positions: &mut [DVec3]) {
        let (rotation, centre) = (DMat3::from_quat(self.end_rotation()), self.end_centre());
        for (vertex, &point) in self.members().zip(&*self.points) {
            positions[vertex] = rotation * point + centre;
        }
    }

    /// Returns the motion that lies so far between this one and another one of the same body.
    pub(crate) fn between(&self, other: &Self, share: f64) -> Self {
        Self {
            displacement: self.displacement.lerp(other.displacement, share),
            turn: self.turn.lerp(other.turn, share),
            ..self.clone()
        }
    }
}

/// Returns the sum of the diagonal.
pub(crate) const fn trace(matrix: DMat3) -> f64 {
    matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z
}

/// Returns a·bᵀ.
pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_turn_up_to_half_a_turn_is_that_of_its_rotation(vector in prop::array::uniform3(-1.7..1.7_f64)) {
            let vector = DVec3::from(vector);
            prop_assert!((vector_of(rotation_by(vector)) - vector).length() < 1e-12);
            prop_assert!((vector_of(-rotation_by(vector)) - vector).length() < 1e-12);
        }
    }

    #[test]
    fn a_body_with_one_free_axis_has_the_inertia_about_it_alone() {
        let inertia = DMat3::from_cols(
            DVec3::new(3.0, 0.5, 0.2),
            DVec3::new(0.5, 2.0, 0.1),
            DVec3::new(0.2, 0.1, 4.0),
        );
        let door = Freedom {
            rotation: DVec3::Z,
            ..Freedom::ALL
        };
        let spin = door.inverse_inertia(&inertia) * DVec3::new(7.0, 8.0, 2.0);
        assert!(spin.distance(DVec3::Z * 0.5) < 1e-15, "{spin}");
        assert_eq!(Freedom::ALL.inverse_inertia(&inertia), inertia.inverse());
    }

    #[test]
    fn a_motion_without_a_turn_is_a_translation_and_half_a_motion_has_half_of_both() {
        let points: Arc<[DVec3]> = Arc::new([DVec3::X, DVec3::Y]);
        let motion = RigidMotion {
            vertices: 1..3,
            riders: Arc::new([]),
            points,
            mass: 1.0,
            rotation: DQuat::IDENTITY,
            centre: DVec3::Z,
            displacement: DVec3::Z,
            turn: DVec3::ZERO,
        };
        let mut positions = [DVec3::ZERO; 4];
        motion.put(&mut positions);
        assert_eq!(
            positions,
            [DVec3::ZERO, DVec3::new(1.0, 0.0, 2.0), DVec3::new(0.0, 1.0, 2.0), DVec3::ZERO]
        );
        let quarter = RigidMotion {
            turn: DVec3::Z * std::f64::consts::FRAC_PI_2,
            displacement: DVec3::ZERO,
            ..motion.clone()
        };
        motion.between(&quarter, 1.0).put(&mut positions);
        assert!(positions[1].distance(DVec3::new(0.0, 1.0, 1.0)) < 1e-15);
        let half = motion.between(&quarter, 0.5);
        assert_eq!((half.displacement, half.turn), (DVec3::Z * 0.5, quarter.turn * 0.5));
    }
}
