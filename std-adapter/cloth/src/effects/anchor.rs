//! The anchor of an attached vertex.
//!
//! The anchor on a body is a point of its nearest triangle at the start, with its distance in front of the triangle. So it
//! follows bodies that deform as well.

use crate::model::step::{Carrier, TimeStep};
use selvedge_core::glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    /// A point that a motion carries, given without any motion.
    Carried(Carrier, DVec3),
    /// A point of a triangle: its coordinates along the two sides from the first vertex, and its distance in front of the
    /// triangle.
    On([u32; 3], [f64; 3]),
}

impl Anchor {
    /// Makes an anchor on the nearest of these triangles, by their centres.
    pub(super) fn on(triangles: &[[u32; 3]], positions: &[DVec3], point: DVec3) -> Self {
        let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
        let distance = |t: &[u32; 3]| (corners(t).iter().sum::<DVec3>() / 3.0).distance_squared(point);
        let nearest = triangles.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(triangle) = nearest else {
            return Self::On([0; 3], [0.0; 3]);
        };
        let [a, b, c] = corners(triangle);
        let ([first, second], offset) = ([b - a, c - a], point - a);
        let normal = first.cross(second);
        let area = normal.length_squared();
        let share = |side: DVec3| if area > 0.0 { side.dot(normal) / area } else { 0.0 };
        let shares = [share(offset.cross(second)), share(first.cross(offset))];
        Self::On(*triangle, [shares[0], shares[1], offset.dot(normal.normalize_or_zero())])
    }

    /// Returns a vertex of the body that it is on.
    pub(super) fn vertex_of_body(&self) -> Option<u32> {
        match self {
            Self::Carried(..) => None,
            Self::On([vertex, ..], _) => Some(*vertex),
        }
    }

    /// Returns the position at the end of a step, where bodies are then.
    pub(super) fn end_position(&self, step: &TimeStep<'_>, positions: &[DVec3]) -> DVec3 {
        match *self {
            Self::Carried(carrier, point) => step.poses[carrier as usize][1].apply(point),
            Self::On(triangle, [u, v, height]) => {
                let [a, b, c] = triangle.map(|v| positions[v as usize]);
                let (first, second) = (b - a, c - a);
                a + first * u + second * v + first.cross(second).normalize_or_zero() * height
            }
        }
    }
}
