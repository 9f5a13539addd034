//! What a vertex is attached to, and where that is.
//!
//! The anchor of a vertex that follows a body is a point on one of its triangles, the nearest at the start, and so far from it: so that it goes with
//! bodies that change their shape as well.

use crate::model::step::{Carrier, TimeStep};
use selvedge_core::glam::DVec3;

/// What a vertex is attached to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    /// A point that a motion carries, where it is when not moved at all.
    Carried(Carrier, DVec3),
    /// A point of a triangle: shares of its sides from its first vertex, and how far in front of it.
    On([u32; 3], [f64; 3]),
}

impl Anchor {
    /// On the nearest of these triangles, by their middles.
    pub(super) fn on(triangles: &[[u32; 3]], positions: &[DVec3], point: DVec3) -> Self {
        let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
        let distance = |t: &[u32; 3]| (corners(t).iter().sum::<DVec3>() / 3.0).distance_squared(point);
        let nearest = triangles.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(triangle) = nearest else {
            return Self::On([0; 3], [0.0; 3]);
        };
        let [a, b, c] = corners(triangle);
        let ([first, second], way) = ([b - a, c - a], point - a);
        let normal = first.cross(second);
        let area = normal.length_squared();
        let share = |side: DVec3| if area > 0.0 { side.dot(normal) / area } else { 0.0 };
        let shares = [share(way.cross(second)), share(first.cross(way))];
        Self::On(*triangle, [shares[0], shares[1], way.dot(normal.normalize_or_zero())])
    }

    /// Where it is at the end of a step, with bodies where they are then.
    pub(super) fn at(&self, step: &TimeStep<'_>, positions: &[DVec3]) -> DVec3 {
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
