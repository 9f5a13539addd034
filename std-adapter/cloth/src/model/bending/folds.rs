//! Permanent folds: cloth that is bent too far does not flatten completely.
//!
//! A hinge has its own rest value c₀ along the normal n between its triangles, and the energy ½(αD/A)·|C − c₀n|². C is parallel
//! to n up to stretch, so the energy depends on C·n alone. The forces are −Q·x and (αD/A)·c₀·K·n on the vertices, which sum to
//! zero and exert no torque. The second part, the loads, is constant in a step, with the normals at its start. Since n
//! lags behind a rotation, it damps rotation a little.
//!
//! **Yield.** C·n/A is a curvature, c₀/A that of the fold at rest. If they differ by more than κ after a step, the fold creeps:
//! it takes 1 − exp(−h/τ) of the excess over κ, and all of it if τ is zero. This is perfect plasticity. It is the model of
//! Narain, Pfaff and O'Brien (2013) without hardening, for fold angles instead of curvatures of triangles.

use super::hinge::{Hinge, PlacedHinge};
use crate::model::step::{Memory, TimeStep};
use libm::exp;
use selvedge::parallel;
use selvedge_core::glam::DVec3;

/// The point at which folds become permanent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Yield {
    /// The curvature κ beyond which a fold creeps, in 1/m.
    pub(crate) curvature: f64,
    /// The time τ within which a fold creeps, in s.
    pub(crate) creep: f64,
}

#[derive(Debug)]
pub(crate) struct Folds {
    when: Yield,
    hinges: Vec<Fold>,
    /// The cloth's first vertex, as its hinges number vertices here.
    first: u32,
    /// The source vertices of the last vertices, which are copies made by tears.
    copied: Vec<u32>,
    loads: Vec<DVec3>,
}

#[derive(Debug)]
struct Fold {
    vertices: [u32; 4],
    hinge: Hinge,
    /// The rest value c₀ along the normal, in m.
    rest: f64,
}

impl Fold {
    /// Returns C, and the normal between the two triangles.
    fn bent(&self, positions: &[DVec3]) -> [DVec3; 2] {
        let x = self.vertices.map(|v| positions[v as usize]);
        let [a, b, c, d] = x;
        let first = (b - a).cross(c - a).normalize_or_zero();
        let second = (a - b).cross(d - b).normalize_or_zero();
        [self.hinge.bent(x), (first + second).normalize_or_zero()]
    }
}

impl Folds {
    /// Makes flat folds. The last vertices are copies of those in `copied`.
    /// The cloth's vertices are numbered from `first` on.
    pub(crate) fn new(hinges: &[PlacedHinge], first: u32, vertex_count: usize, copied: &[u32], when: Yield) -> Self {
        let fold = |&(vertices, hinge): &PlacedHinge| Fold {
            vertices: vertices.map(|vertex| vertex + first),
            hinge,
            rest: 0.0,
        };
        Self {
            when,
            first,
            hinges: hinges.iter().map(fold).collect(),
            copied: copied.to_vec(),
            loads: vec![DVec3::ZERO; vertex_count],
        }
    }

    /// Returns the vertices of a fold before the cloth tore, and whether their order reverses the edge and so the normal. Those
    /// of the edge ascend.
    fn as_made(&self, fold: &Fold) -> ([u32; 4], bool) {
        let first_copy = self.loads.len() - self.copied.len();
        let made = |vertex: u32| {
            let vertex = vertex - self.first;
            let copy = (vertex as usize).checked_sub(first_copy);
            copy.map_or(vertex, |copy| self.copied[copy])
        };
        let [a, b, c, d] = fold.vertices.map(made);
        ([a.min(b), a.max(b), c, d], a > b)
    }

    /// Returns the loads of the folds on each vertex at these positions, in N.
    pub(crate) fn loads(&mut self, positions: &[DVec3]) -> &[DVec3] {
        self.loads.fill(DVec3::ZERO);
        for fold in self.hinges.iter().filter(|fold| fold.rest != 0.0) {
            let [_, normal] = fold.bent(positions);
            let pull = normal * (fold.hinge.coefficient * fold.rest);
            for (&vertex, weight) in fold.vertices.iter().zip(fold.hinge.weights) {
                self.loads[(vertex - self.first) as usize] += pull * weight;
            }
        }
        &self.loads
    }

    /// Returns the energy without the part ½x·Q·x, in J.
    pub(crate) fn energy(&self, positions: &[DVec3]) -> f64 {
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

    /// Returns the rest of each fold, in m, with the normal as it was before the cloth tore.
    fn numbers(&self) -> Vec<f64> {
        let number = |fold: &Fold| match self.as_made(fold) {
            (_, true) => -fold.rest,
            (_, false) => fold.rest,
        };
        self.hinges.iter().map(number).collect()
    }

    fn recall(&mut self, numbers: &[f64]) {
        for (place, &number) in numbers.iter().enumerate().take(self.hinges.len()) {
            let (_, is_turned) = self.as_made(&self.hinges[place]);
            self.hinges[place].rest = if is_turned { -number } else { number };
        }
    }

    fn keys(&self) -> Vec<[u32; 4]> {
        self.hinges.iter().map(|fold| self.as_made(fold).0).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vertex 0 has a copy, so that the edge begins at its other end.
    #[test]
    fn a_fold_is_known_by_the_vertices_that_it_had_before_a_tear_and_bent_the_same_way() {
        let hinge = Hinge {
            weights: [0.0; 4],
            coefficient: 1.0,
            area: 1.0,
        };
        let when = Yield {
            curvature: 1.0,
            creep: 0.0,
        };
        let mut whole = Folds::new(&[([0, 1, 2, 3], hinge)], 0, 4, &[], when);
        let mut torn = Folds::new(&[([1, 4, 2, 3], hinge)], 0, 5, &[0], when);
        assert_eq!(whole.keys(), torn.keys());
        whole.recall(&[0.25]);
        torn.recall(&whole.numbers());
        assert_eq!(torn.numbers(), [0.25]);
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.0, -1.0, 0.5), DVec3::ZERO];
        let loads = whole.hinges[0].bent(&corners)[1] * whole.hinges[0].rest;
        assert!(torn.hinges[0].bent(&corners)[1] * torn.hinges[0].rest == loads && loads != DVec3::ZERO);
    }
}
