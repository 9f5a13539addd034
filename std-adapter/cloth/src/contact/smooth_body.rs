//! Capsules and balls, from which cloth keeps its exact distance, so that it slides on a smooth surface.
//!
//! Vertices keep the thickness from the smooth surface. The pairs with the body's mesh keep edges and faces of the cloth off it,
//! and aim at [half of it](OF_MESH): a mesh lies inside of the surface, and the edge between two vertices on it as well. If both
//! aimed at all of it, they would press in turn, with friction of their own. Then a rope slides around a cylinder in jerks: law
//! of the capstan.

use crate::model::length::length;
use crate::world::Pose;
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// The share of the thickness at which pairs with the mesh of a smooth body aim. The rest is room for edges of the cloth, whose
/// middle is nearer than their ends. The law of the capstan pins it: with 1 its error is up to 48 %.
pub(crate) const OF_MESH: f64 = 0.5;

/// A capsule or a ball, and the cloth that it meets.
#[derive(Clone, Debug)]
pub(crate) struct SmoothBody {
    pub(crate) carrier: usize,
    /// The ends of the axis at rest.
    pub(crate) ends: [DVec3; 2],
    pub(crate) radius: f64,
    pub(crate) thickness: f64,
    /// The vertices of the cloth, as the scene numbers them.
    pub(crate) vertices: Range<usize>,
}

impl SmoothBody {
    /// Returns the ends of the axis at a pose.
    pub(crate) fn axis(&self, pose: &Pose) -> [DVec3; 2] {
        self.ends.map(|end| pose.apply(end))
    }
}

/// Returns the vector to a point from the nearest point of an axis.
#[inline(always)]
pub(crate) fn from_axis([from, to]: [DVec3; 2], point: DVec3) -> DVec3 {
    let (axis, offset) = (to - from, point - from);
    let squared = axis.length_squared();
    if squared > 0.0 {
        offset - axis * (offset.dot(axis) / squared).clamp(0.0, 1.0)
    } else {
        offset
    }
}

/// Returns the direction of length one away from an axis, and the distance.
#[inline(always)]
pub(crate) fn away(axis: [DVec3; 2], point: DVec3) -> (DVec3, f64) {
    let offset = from_axis(axis, point);
    let distance = length(offset);
    (if distance > 0.0 { offset / distance } else { DVec3::ZERO }, distance)
}
