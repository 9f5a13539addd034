//! Forces on vertices that the caller adds for one run, such as a hand's or a fan's.

use crate::model::step::TimeStep;
use selvedge_core::glam::DVec3;

/// The forces of the next run: vertices of cloth, each with a force in N. A vertex may occur several times.
#[derive(Debug, Default)]
pub(super) struct AddedForces(pub(super) Vec<(u32, DVec3)>);

impl AddedForces {
    /// Adds to velocities what the forces change in a step.
    pub(super) fn apply(&self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        for &(vertex, force) in &self.0 {
            velocities[vertex as usize] += force * (step.inverse_masses[vertex as usize] * step.h);
        }
    }

    /// Follows vertices to new numbers; `from` gives the old vertex of each vertex, or its original. Originals keep the force.
    pub(super) fn renumber(&mut self, from: &[u32]) {
        for (vertex, _) in &mut self.0 {
            let new = from.iter().position(|old| old == vertex);
            *vertex = new.map_or(*vertex, |new| new as u32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_follow_their_vertices_when_a_tear_changes_their_numbers() {
        let mut forces = AddedForces(vec![(1, DVec3::X), (2, DVec3::Y)]);
        // Vertex 1 has a copy, which comes after it.
        forces.renumber(&[0, 1, 1, 2]);
        assert_eq!(forces.0, [(1, DVec3::X), (3, DVec3::Y)]);
    }
}
