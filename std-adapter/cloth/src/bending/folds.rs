//! Folds that stay: what was bent too far does not go back all the way.
//!
//! A hinge has a rest of its own, c₀ along the normal n between its triangles, and costs ½(αD/A)·|C − c₀n|². C is parallel to n but for
//! what is stretched, so that this varies with C·n alone: forces are −Q·x and (αD/A)·c₀·K·n on its vertices, which sum to zero and do not turn
//! it. The second part, the loads, is added in each stage of a step, with the normals at its start: as n lags behind what turns, it slows it
//! down a little.
//!
//! **Yield.** C·n/A is a curvature, c₀/A that of the fold at rest. Where they differ by more than κ when a step is made, the fold creeps: of
//! what is beyond κ it takes 1 − exp(−h/τ), all of it at once if τ is zero. That is perfect plasticity, the model of Narain, Pfaff and O'Brien
//! (2013) without hardening, of fold angles instead of curvatures of triangles.

use super::hinge::Hinge;
use crate::schedule::On;
use crate::step::{Memory, TimeStep};
use libm::exp;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;

/// When folds stay.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Yield {
    /// κ of the module, in 1/m.
    pub(crate) curvature: f64,
    /// τ, in s.
    pub(crate) creep: f64,
}

#[derive(Debug)]
pub(super) struct Folds {
    when: Yield,
    hinges: Vec<Fold>,
    /// On each vertex, in N.
    loads: Vec<DVec3>,
}

#[derive(Debug)]
struct Fold {
    vertices: [u32; 4],
    hinge: Hinge,
    /// c₀ of the module, in m.
    rest: f64,
}

impl Fold {
    /// C, and the normal between the two triangles.
    fn bent(&self, positions: &[DVec3]) -> [DVec3; 2] {
        let x = self.vertices.map(|v| positions[v as usize]);
        let [a, b, c, d] = x;
        let first = (b - a).cross(c - a).normalize_or_zero();
        let second = (a - b).cross(d - b).normalize_or_zero();
        [self.hinge.bent(x), (first + second).normalize_or_zero()]
    }
}

impl Folds {
    /// All flat.
    pub(super) fn new(hinges: &[On<Hinge, 4>], vertex_count: usize, when: Yield) -> Self {
        let fold = |&(vertices, hinge): &On<Hinge, 4>| Fold {
            vertices,
            hinge,
            rest: 0.0,
        };
        Self {
            when,
            hinges: hinges.iter().map(fold).collect(),
            loads: vec![DVec3::ZERO; vertex_count],
        }
    }

    /// What folds add to the force on each vertex, with everything at these positions, in N.
    pub(super) fn loads(&mut self, positions: &[DVec3]) -> &[DVec3] {
        self.loads.fill(DVec3::ZERO);
        for fold in self.hinges.iter().filter(|fold| fold.rest != 0.0) {
            let [_, normal] = fold.bent(positions);
            let pull = normal * (fold.hinge.coefficient * fold.rest);
            for (&vertex, weight) in fold.vertices.iter().zip(fold.hinge.weights) {
                self.loads[vertex as usize] += pull * weight;
            }
        }
        &self.loads
    }

    /// What is to be added to ½x·Q·x for the energy, in J.
    pub(super) fn energy(&self, positions: &[DVec3]) -> f64 {
        let of = |fold: &Fold| {
            let [bent, normal] = fold.bent(positions);
            fold.hinge.coefficient * fold.rest * (0.5 * fold.rest - bent.dot(normal))
        };
        self.hinges.iter().filter(|fold| fold.rest != 0.0).map(of).sum()
    }
}

impl Memory for Folds {
    fn settle(&mut self, step: &TimeStep<'_>, positions: &[DVec3]) {
        let Yield { curvature, creep } = self.when;
        let share = if creep > 0.0 { 1.0 - exp(-step.h / creep) } else { 1.0 };
        parallel::for_each(&mut self.hinges, |_, fold| {
            let [bent, normal] = fold.bent(positions);
            let elastic = bent.dot(normal) - fold.rest;
            let beyond = elastic.abs() - curvature * fold.hinge.area;
            if beyond > 0.0 {
                fold.rest += (share * beyond).copysign(elastic);
            }
        });
    }

    /// The rest of each fold, in m.
    fn numbers(&self) -> Vec<f64> {
        self.hinges.iter().map(|fold| fold.rest).collect()
    }

    fn recall(&mut self, numbers: &[f64]) {
        for (fold, &rest) in self.hinges.iter_mut().zip(numbers) {
            fold.rest = rest;
        }
    }
}
