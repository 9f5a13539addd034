//! Motions of bodies and pins: along keyframes, as an [animation](super::animation), or [driven](super::driven) by the caller.

use super::Animation;
use super::free::FreeMotion;
use super::keyframes::KeyframeMotion;
use super::placement::Placement;
use crate::input::{SceneError, Table, ValueError};
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
    /// Gravity, contact and friction move the body.
    Free(FreeMotion),
}

crate::identify!(enum BodyMotion { 0 => Keyframes(motion), 1 => Animated(animation), 2 => Driven(placement), 3 => Free(motion) });

impl BodyMotion {
    /// Checks the motion of points, given at rest.
    ///
    /// # Errors
    /// Returns an error if a motion turns too far in a step, moves a point too fast, or has a number out of range or the wrong
    /// number of vertices.
    pub(crate) fn check(&self, points: &[DVec3], time_step: f64) -> Result<(), ValueError> {
        match self {
            Self::Keyframes(motion) => motion.check(points, time_step),
            Self::Animated(animation) => animation.check(points.len(), time_step),
            Self::Driven(placement) => placement.checked().map(drop),
            Self::Free(_) => Err(ValueError::new("mass", "only bodies move freely")),
        }
    }
}

impl BodyMotion {
    /// Keys of a table that describes a motion.
    pub(crate) const KEYS: [&'static str; 6] = ["pivot", "axis", "keyframes", "interpolation", "rate", "driven"];

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

impl From<FreeMotion> for BodyMotion {
    fn from(motion: FreeMotion) -> Self {
        Self::Free(motion)
    }
}

impl From<KeyframeMotion> for BodyMotion {
    fn from(motion: KeyframeMotion) -> Self {
        Self::Keyframes(motion)
    }
}

/// The kinematic motion of a vertex: its index among the motions.
pub(crate) type Carrier = u32;
/// The carrier of vertices without such a motion, which the solver moves.
pub(crate) const FREE: Carrier = u32::MAX;

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

impl Pose {
    /// Returns the pose after a rotation about an axis through a pivot, then a translation.
    pub(super) fn moved(pivot: DVec3, axis: DVec3, angle: f64, translation: DVec3) -> Self {
        Self {
            base: None,
            pivot,
            axis,
            angle,
            translation,
            deformed: None,
        }
    }

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

    /// Lets the rotation be one about another point.
    pub(crate) fn about(self, pivot: DVec3) -> Self {
        Self { pivot, ..self }
    }

    /// Adds a rotation about an axis through the body's origin, and a translation.
    pub(crate) fn turned_and_moved(self, axis: DVec3, angle: f64, translation: DVec3) -> Self {
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

    /// Returns the rotation vector by which the body turns until `later`, if both are [rigid](Self::is_rigid).
    pub(crate) fn turn_until(&self, later: &Self) -> DVec3 {
        self.axis * (later.angle - self.angle)
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
pub(super) fn turned(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sine, cosine) = (sin(angle), cos(angle));
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
}
