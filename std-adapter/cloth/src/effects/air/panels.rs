//! The push of moving air on triangles: each is pushed along its normal.
//!
//! The force on a triangle of area A is ½ρ·c·A·|u·n|(u·n)·n, where u is the air's relative velocity (Keller et al. 2003 use the
//! same normal term). The triangle's own normal velocity then follows v′ = −k|v|v, k = ½ρc/σ with σ the mass per area. The exact
//! solution over a step is v/(1 + k·h·|v|), so a step never overshoots the wind. Each vertex takes the changes of its triangles,
//! weighted by their shares in its mass, whose sum is at most one.

use super::drag::{Drag, share_taken, take};
use crate::model::membrane::triangles_around;
use crate::model::step::TimeStep;
use crate::world::Cloth;
use crate::world::Incidence;
use selvedge::parallel;
use selvedge_core::glam::DVec3;

#[derive(Debug)]
pub(super) struct Panels {
    /// The factor k = ½ρc/σ of the deceleration.
    factor: f64,
    triangles: Vec<[u32; 3]>,
    incidence: Incidence<(u32, f64)>,
    changes: Vec<DVec3>,
}

impl Panels {
    pub(super) fn new(cloth: &Cloth, air: Drag) -> Self {
        Self {
            factor: air.over(cloth.density),
            triangles: cloth.mesh.triangles.clone(),
            incidence: triangles_around(cloth),
            changes: Vec::new(),
        }
    }

    /// Changes velocities. `air` returns the velocity of the air at a triangle, given its corners.
    pub(super) fn push(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3], air: impl Fn(&[DVec3]) -> DVec3 + Sync) {
        let Self {
            factor,
            triangles,
            incidence,
            changes,
        } = self;
        let read: &[DVec3] = velocities;
        parallel::fill(changes, triangles, |triangle| {
            let corners = triangle.map(|v| step.start[v as usize]);
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let [u, v, w] = triangle.map(|v| read[v as usize]);
            let across = (air(&corners) - (u + v + w) / 3.0).dot(normal);
            normal * (across * share_taken(*factor * step.h * across.abs()))
        });
        take(step, velocities, incidence, changes);
    }
}
