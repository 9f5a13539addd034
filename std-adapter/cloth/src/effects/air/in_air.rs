//! The common part of [wind](super::Wind) and [wind fields](super::WindField): a cloth in moving air.

use super::cords::Cords;
use super::drag::Drag;
use super::panels::Panels;
use crate::model::step::TimeStep;
use crate::world::Cloth;
use selvedge_core::glam::DVec3;

#[derive(Debug)]
pub(super) struct InAir {
    panels: Option<Panels>,
    cords: Option<Cords>,
}

impl InAir {
    pub(super) fn new(cloth: &Cloth, air: Drag) -> Self {
        Self {
            panels: cloth.has_triangles().then(|| Panels::new(cloth, air)),
            cords: (air.rope_diameter > 0.0 && cloth.has_loose_edges()).then(|| Cords::new(cloth, air)),
        }
    }

    /// Changes velocities. `air` returns the velocity of the air, given a triangle's corners or an edge's ends.
    pub(super) fn push(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3], air: impl Fn(&[DVec3]) -> DVec3 + Sync) {
        if let Some(panels) = &mut self.panels {
            panels.push(step, velocities, &air);
        }
        if let Some(cords) = &mut self.cords {
            cords.push(step, velocities, &air);
        }
    }
}
