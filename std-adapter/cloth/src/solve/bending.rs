//! Bending of cloth: the quadratic energy of [hinges](crate::model::bending), with permanent folds.
//!
//! Its second derivative is constant and has no directions, so the [matrix](super::matrix) holds one number for each pair of
//! vertices. A fold adds a load that is constant within a step.

use super::matrix::Matrix;
use super::term::{Prediction, Term};
use crate::model::bending::{Folds, PlacedHinge, Yield};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Memory, TimeStep};
use selvedge_core::glam::DVec3;

/// The bending of a cloth.
#[derive(Debug)]
pub(crate) struct Bending {
    hinges: Vec<PlacedHinge>,
    folds: Option<Folds>,
    /// The loads of folds in this step, and the first vertex that they act on.
    loads: Vec<DVec3>,
    first_vertex: usize,
}

impl Bending {
    /// Makes the term of hinges that number vertices as the scene does. `folds` has the point at which folds become permanent,
    /// and the sources of the last vertices of the cloth, which are copies.
    pub(crate) fn new(hinges: &[PlacedHinge], first_vertex: u32, vertex_count: usize, folds: Option<(Yield, &[u32])>) -> Self {
        let placed = hinges
            .iter()
            .map(|(own, hinge)| (own.map(|vertex| vertex + first_vertex), *hinge));
        Self {
            hinges: placed.collect(),
            folds: folds.map(|(when, copied)| Folds::new(hinges, first_vertex, vertex_count, copied, when)),
            loads: Vec::new(),
            first_vertex: first_vertex as usize,
        }
    }

    /// Returns the vertices, the weights and the stiffness of each hinge.
    pub(crate) fn constant(&self) -> impl Iterator<Item = ([u32; 4], [f64; 4], f64)> {
        self.hinges
            .iter()
            .map(|(vertices, hinge)| (*vertices, hinge.weights, hinge.coefficient))
    }
}

impl Term for Bending {
    fn begin(&mut self, step: &TimeStep<'_>, _: &Prediction, _: &[DVec3]) {
        if let Some(folds) = &mut self.folds {
            self.loads.clear();
            self.loads.extend_from_slice(folds.loads(step.start));
        }
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for (vertices, hinge) in &self.hinges {
            let bent = hinge.bent(vertices.map(|vertex| x[vertex as usize]));
            energy += hinge.coefficient * bent.length_squared();
            let force = bent * hinge.coefficient;
            for k in 0..4 {
                gradient[vertices[k] as usize] += force * hinge.weights[k];
            }
        }
        energy *= 0.5;
        let loaded = gradient[self.first_vertex..].iter_mut().zip(&x[self.first_vertex..]);
        for ((gradient, x), load) in loaded.zip(&self.loads) {
            *gradient -= *load;
            energy -= load.dot(*x);
        }
        energy
    }

    /// Nothing: the matrix has it from the start.
    fn curvature(&mut self, _: &[DVec3], _: &mut Matrix) {}

    fn is_inner(&self) -> bool {
        true
    }

    fn energy(&self, now: &Configuration<'_>, own: usize) -> Vec<(usize, StoredEnergy)> {
        let of_hinge = |(vertices, hinge): &PlacedHinge| {
            let bent = hinge.bent(vertices.map(|vertex| now.positions[vertex as usize]));
            0.5 * hinge.coefficient * bent.length_squared()
        };
        let all: f64 = self.hinges.iter().map(of_hinge).sum();
        let folds = self.folds.as_ref().map_or(0.0, |folds| folds.energy(now.positions));
        vec![(own, StoredEnergy::Elastic((all + folds).max(0.0)))]
    }

    fn memory(&self) -> Option<&dyn Memory> {
        self.folds.as_ref().map(|folds| folds as &dyn Memory)
    }

    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        self.folds.as_mut().map(|folds| folds as &mut dyn Memory)
    }
}
