//! Bending of a rope: one implicit step of all its joints.
//!
//! At a joint b between a and c, with edges of lengths u and v at rest, e = (c − b)/v − (b − a)/u is the change of direction, up
//! to stretch. At a curvature κ it is κ·L, where L = (u + v)/2 is the length of rope of a joint. So ½(D/L)·|e|² is the energy
//! ½D·κ² of that length, with D the flexural rigidity. It is quadratic, like that of the [hinges of
//! cloth](crate::model::bending), and has no twist (Bergou et al. 2006, "A quadratic bending model for inextensible surfaces"). A
//! joint that is bent by r at rest has ½(D/L)·|e − r·ê|², with ê the direction of e before the step: the side of the bend is
//! free.
//!
//! Implicit Euler solves (M + h²CᵀDC/L)·d = h²f. Every vertex couples with two to either side, x, y and z separately: a band
//! matrix, factorised as L·D·Lᵀ. It is stable for any stiffness. Kinematic vertices take part without moving, so two of them in a
//! row clamp a rope.

use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::world::Cloth;
use crate::world::runs;
use selvedge_core::glam::DVec3;

/// The largest stiffness of a joint, as a multiple of a vertex's mass over h². It keeps masses from being rounded away: the
/// rounding of a move is 10⁻⁶ of it.
const STIFFEST: f64 = 1e10;

#[derive(Debug)]
pub(crate) struct Bending {
    rows: Vec<Row>,
    band: Band,
}

#[derive(Debug)]
struct Row {
    vertices: Vec<u32>,
    /// The joint of each vertex and the next two.
    joints: Vec<Joint>,
}

#[derive(Debug)]
struct Joint {
    /// The weights of e at the three vertices, in 1/m.
    weights: [f64; 3],
    /// D/L, in J.
    stiffness: f64,
    /// The length of e at rest.
    bent: f64,
}

/// A symmetric matrix with two diagonals beside the main one, then its factors, and the right-hand side.
#[derive(Debug, Default)]
struct Band {
    diagonal: Vec<f64>,
    first: Vec<f64>,
    second: Vec<f64>,
    right: Vec<DVec3>,
}

impl Bending {
    /// Makes the joints with a flexural rigidity, in N·m².
    pub(crate) fn new(cloth: &Cloth, rigidity: f64, is_bent_at_rest: bool) -> Self {
        let edges: Vec<[u32; 2]> = cloth.topology.loose_edges().collect();
        let rest = &cloth.mesh.positions;
        let joint = |three: &[u32]| {
            let [a, b, c] = [three[0], three[1], three[2]].map(|vertex| rest[vertex as usize]);
            let [u, v] = [a.distance(b), b.distance(c)];
            let mut joint = Joint {
                weights: [1.0 / u, -1.0 / u - 1.0 / v, 1.0 / v],
                stiffness: rigidity / (0.5 * (u + v)),
                bent: 0.0,
            };
            if is_bent_at_rest {
                joint.bent = joint.turn([a, b, c]).length();
            }
            joint
        };
        let row = |vertices: Vec<u32>| Row {
            joints: vertices.windows(3).map(joint).collect(),
            vertices,
        };
        let runs = runs(&edges, rest.len());
        Self {
            rows: runs.iter().flat_map(|run| run.rows_of_joints()).map(row).collect(),
            band: Band::default(),
        }
    }
}

impl Constraint for Bending {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        for row in &self.rows {
            row.fill(&mut self.band, step, positions);
            self.band.solve();
            for (&vertex, &moved) in row.vertices.iter().zip(&self.band.right) {
                positions[vertex as usize] += moved;
            }
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let of_row = |row: &Row| -> f64 {
            let joints = row.vertices.windows(3).zip(&row.joints);
            let energy = |(three, joint): (&[u32], &Joint)| {
                let turn = joint.turn([three[0], three[1], three[2]].map(|vertex| now.positions[vertex as usize]));
                0.5 * joint.stiffness * (turn.length() - joint.bent).powi(2)
            };
            joints.map(energy).sum()
        };
        Some(StoredEnergy::Elastic(self.rows.iter().map(of_row).sum()))
    }
}

impl Row {
    fn fill(&self, band: &mut Band, step: &TimeStep<'_>, positions: &[DVec3]) {
        let count = self.vertices.len();
        let inverse_mass = |k: usize| step.inverse_masses[self.vertices[k] as usize];
        band.diagonal.clear();
        // A vertex that does not move has no meaningful mass.
        let mass = |k: usize| {
            let inverse = inverse_mass(k);
            if inverse > 0.0 { inverse.recip() } else { 1.0 }
        };
        band.diagonal.extend((0..count).map(mass));
        for diagonal in [&mut band.first, &mut band.second] {
            diagonal.clear();
            diagonal.resize(count, 0.0);
        }
        band.right.clear();
        band.right.resize(count, DVec3::ZERO);
        for (k, joint) in self.joints.iter().enumerate() {
            let is_free = [k, k + 1, k + 2].map(|k| inverse_mass(k) > 0.0);
            let weights = [0, 1, 2].map(|i| if is_free[i] { joint.weights[i] } else { 0.0 });
            let lightest = [0, 1, 2].map(|i| if is_free[i] { mass(k + i) } else { f64::INFINITY });
            let lightest = lightest.into_iter().fold(f64::INFINITY, f64::min);
            let largest: f64 = joint.weights.iter().map(|weight| weight * weight).sum();
            let stiffness = (joint.stiffness * step.h * step.h).min(STIFFEST * lightest / largest);
            if !stiffness.is_finite() {
                // None of the three vertices moves.
                continue;
            }
            let turn = joint.turn([k, k + 1, k + 2].map(|k| positions[self.vertices[k] as usize]));
            let too_much = turn - turn.normalize_or_zero() * joint.bent;
            for i in 0..3 {
                let weight = stiffness * weights[i];
                band.diagonal[k + i] += weight * weights[i];
                band.right[k + i] -= too_much * weight;
            }
            band.first[k] += stiffness * weights[0] * weights[1];
            band.first[k + 1] += stiffness * weights[1] * weights[2];
            band.second[k] += stiffness * weights[0] * weights[2];
        }
    }
}

impl Joint {
    /// Returns the change of direction e at the joint.
    fn turn(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        (c - b) * self.weights[2] - (b - a) * self.weights[0]
    }
}

impl Band {
    /// Replaces the right-hand side by the solution.
    fn solve(&mut self) {
        let Self {
            diagonal,
            first,
            second,
            right,
        } = self;
        for k in 0..diagonal.len() {
            if k >= 1 {
                // These are the factors of earlier rows, times their diagonal.
                let (one, two) = (first[k - 1], if k >= 2 { second[k - 2] } else { 0.0 });
                diagonal[k] -= one * one * diagonal[k - 1];
                first[k] -= one * second[k - 1] * diagonal[k - 1];
                let mut before = right[k - 1] * one;
                if k >= 2 {
                    diagonal[k] -= two * two * diagonal[k - 2];
                    before += right[k - 2] * two;
                }
                right[k] -= before;
            }
            first[k] /= diagonal[k];
            second[k] /= diagonal[k];
        }
        for k in (0..diagonal.len()).rev() {
            let mut value = right[k] / diagonal[k];
            for (factor, other) in [(first[k], k + 1), (second[k], k + 2)] {
                if let Some(&solved) = right.get(other) {
                    value -= solved * factor;
                }
            }
            right[k] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// CᵀC plus a diagonal, times the solution, equals the right-hand side.
        #[test]
        fn the_band_solves_its_equations(
            masses in prop::collection::vec(0.1..2.0_f64, 3..12),
            weights in prop::collection::vec(prop::array::uniform3(-2.0..2.0_f64), 12),
            right in prop::collection::vec(-1.0..1.0_f64, 12),
        ) {
            let count = masses.len();
            let mut dense = vec![vec![0.0; count]; count];
            let mut band = Band { diagonal: masses.clone(), first: vec![0.0; count], second: vec![0.0; count], ..Band::default() };
            (0..count).for_each(|k| dense[k][k] = masses[k]);
            for (k, w) in weights[..count - 2].iter().enumerate() {
                for i in 0..3 {
                    (0..3).for_each(|j| dense[k + i][k + j] += w[i] * w[j]);
                    band.diagonal[k + i] += w[i] * w[i];
                }
                band.first[k] += w[0] * w[1];
                band.first[k + 1] += w[1] * w[2];
                band.second[k] += w[0] * w[2];
            }
            band.right = right[..count].iter().map(|&x| DVec3::new(x, -x, 1.0)).collect();
            band.solve();
            for (k, row) in dense.iter().enumerate() {
                let product: DVec3 = row.iter().zip(&band.right).map(|(a, x)| *x * *a).sum();
                prop_assert!(product.distance(DVec3::new(right[k], -right[k], 1.0)) < 1e-9);
            }
        }
    }
}
