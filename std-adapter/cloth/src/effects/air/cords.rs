//! What moving air does to loose edges: each is pushed across itself by the air that it stops.
//!
//! The force on an edge of length L and diameter d is ½ρ·c·d·L·|u|u, u the part across the edge of the air's velocity relative to it: what
//! flows along does nothing (the cross-flow principle; Hoerner, Fluid-Dynamic Drag, 1965, chapter 3). With λ its mass per length the edge's own
//! velocity across follows v′ = −k|v|v, k = ½ρcd/λ: as [`Panels`](super::panels) have it, with the same exact solution over a step.

use super::drag::{Drag, share_taken, take};
use crate::model::step::TimeStep;
use crate::world::Cloth;
use crate::world::Incidence;
use selvedge::parallel;
use selvedge_core::glam::DVec3;

/// The loose edges of a cloth, in the air.
#[derive(Debug)]
pub(super) struct Cords {
    /// k of the module.
    factor: f64,
    edges: Vec<[u32; 2]>,
    /// Of each vertex its edges, and the share of each in its mass.
    incidence: Incidence<(u32, f64)>,
    /// Of each edge's velocity.
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

    /// Changes velocities by air that moves as `air` says of an edge's ends.
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
