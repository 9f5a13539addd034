//! An effect on one of several cloths: it sees the vertices of that cloth alone.

use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Constraint, Force, Memory, Release, TimeStep, Touches};
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// A force or constraint on one of several cloths.
#[derive(Debug)]
pub(crate) struct OfCloth<T> {
    /// The cloth's vertices among the scene's.
    vertices: Range<usize>,
    /// The held vertices of the cloth.
    held: Vec<(u32, f64)>,
    action: T,
}

impl<T> OfCloth<T> {
    pub(crate) const fn new(vertices: Range<usize>, action: T) -> Self {
        Self {
            vertices,
            held: Vec::new(),
            action,
        }
    }

    fn step<'a>(&self, step: &TimeStep<'a>) -> TimeStep<'a> {
        TimeStep {
            start: &step.start[self.vertices.clone()],
            inverse_masses: &step.inverse_masses[self.vertices.clone()],
            held: &[],
            ..*step
        }
    }

    fn configuration<'a>(&self, now: &Configuration<'a>) -> Configuration<'a> {
        Configuration {
            positions: &now.positions[self.vertices.clone()],
            inverse_masses: &now.inverse_masses[self.vertices.clone()],
        }
    }
}

impl<T: Force> Force for OfCloth<T> {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let step = self.step(step);
        self.action.apply(&step, &mut velocities[self.vertices.clone()]);
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        self.action.energy(&self.configuration(now))
    }

    fn set_wind(&mut self, velocity: DVec3) -> bool {
        self.action.set_wind(velocity)
    }
}

impl<T: Constraint> Constraint for OfCloth<T> {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        self.held.clear();
        let own = step
            .held
            .iter()
            .filter(|(vertex, _)| self.vertices.contains(&(*vertex as usize)));
        let first = self.vertices.start as u32;
        self.held.extend(own.map(|&(vertex, mass)| (vertex - first, mass)));
        let step = TimeStep {
            held: &self.held,
            ..self.step(step)
        };
        let before = touches.list.len();
        self.action.project(&step, &mut positions[self.vertices.clone()], touches);
        for touch in &mut touches.list[before..] {
            touch.vertices = touch.vertices.map(|vertex| first + vertex);
        }
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        self.action.energy(&self.configuration(now))
    }

    fn is_inner(&self) -> bool {
        self.action.is_inner()
    }

    fn joints(&self) -> Vec<[u32; 2]> {
        let first = self.vertices.start as u32;
        let own = self.action.joints().into_iter();
        own.map(|joint| joint.map(|vertex| first + vertex)).collect()
    }

    fn acts_among_contacts(&self) -> bool {
        self.action.acts_among_contacts()
    }

    fn over_limit(&self, positions: &[DVec3]) -> Option<f64> {
        self.action.over_limit(&positions[self.vertices.clone()])
    }

    fn is_undone(&self, positions: &[DVec3]) -> Option<bool> {
        self.action.is_undone(&positions[self.vertices.clone()])
    }

    fn memory(&self) -> Option<&dyn Memory> {
        self.action.memory().is_some().then_some(self)
    }

    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        if self.action.memory().is_some() { Some(self) } else { None }
    }
}

impl<T: Constraint> Memory for OfCloth<T> {
    fn settle(&mut self, step: &TimeStep<'_>, positions: &[DVec3]) {
        let step = self.step(step);
        if let Some(memory) = self.action.memory_mut() {
            memory.settle(&step, &positions[self.vertices.clone()]);
        }
    }

    fn numbers(&self) -> Vec<f64> {
        self.action.memory().map_or_else(Vec::new, Memory::numbers)
    }

    fn recall(&mut self, numbers: &[f64]) {
        if let Some(memory) = self.action.memory_mut() {
            memory.recall(numbers);
        }
    }

    fn keys(&self) -> Vec<[u32; 4]> {
        self.action.memory().map_or_else(Vec::new, Memory::keys)
    }

    fn released(&self) -> Vec<Release> {
        let mut released = self.action.memory().map_or_else(Vec::new, Memory::released);
        released
            .iter_mut()
            .for_each(|release| release.vertex += self.vertices.start as u32);
        released
    }
}
