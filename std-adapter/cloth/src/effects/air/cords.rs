//! The push of moving air on loose edges: each edge is pushed across itself.
//!
//! The force on an edge of length L and diameter d is ½ρ·c·d·L·|u|u, where u is the part across the edge of the air's relative
//! velocity. Flow along the edge has no effect (the cross-flow principle; Hoerner, Fluid-Dynamic Drag, 1965, chapter 3). With λ
//! the mass per length, the edge's own velocity across follows v′ = −k|v|v, k = ½ρcd/λ. The exact solution over a step is that of
//! [`Panels`](super::panels).

use super::drag::{Drag, share_taken, take};
use crate::model::step::TimeStep;
use crate::world::Cloth;
use crate::world::Incidence;
use selvedge::parallel;
use selvedge_core::glam::DVec3;

#[derive(Debug)]
pub(super) struct Cords {
    /// The factor k = ½ρcd/λ of the deceleration.
    factor: f64,
    edges: Vec<[u32; 2]>,
    /// The edges of each vertex, and the share of each in its mass.
    incidence: Incidence<(u32, f64)>,
    changes: Vec<DVec3>,
}

impl Cords {
    pub(super) fn new(cloth: &Cloth, air: Drag) -> Self {
        let edges: Vec<_> = cloth.topology.loose_edges().collect();
        let masses = cloth.masses();
        let ends = || {
            (0..).zip(&edges).flat_map(|(index, &edge)| {
                let [a, b] = edge.map(|vertex| cloth.mesh.positions[vertex as usize]);
                let half = 0.5 * cloth.linear_density * a.distance(b);
                edge.map(|vertex| (vertex, (index, half / masses[vertex as usize])))
            })
        };
        Self {
            factor: air.rope_diameter * air.over(cloth.linear_density),
            incidence: Incidence::new(masses.len(), ends),
            edges,
            changes: Vec::new(),
        }
    }

    /// Changes velocities. `air` returns the velocity of the air at an edge, given its ends.
    pub(super) fn push(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3], air: impl Fn(&[DVec3]) -> DVec3 + Sync) {
        let Self {
            factor,
            edges,
            incidence,
            changes,
        } = self;
        let read: &[DVec3] = velocities;
        parallel::fill(changes, edges, |edge| {
            let ends = edge.map(|vertex| step.start[vertex as usize]);
            let along = (ends[1] - ends[0]).normalize_or_zero();
            let [u, v] = edge.map(|vertex| read[vertex as usize]);
            let relative = air(&ends) - (u + v) / 2.0;
            let across = relative - along * relative.dot(along);
            across * share_taken(*factor * step.h * across.length())
        });
        take(step, velocities, incidence, changes);
    }
}
