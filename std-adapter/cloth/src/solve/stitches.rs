//! Stitches: points that a seam keeps within a length L of each other.
//!
//! With p the vector between the points, the augmented Lagrangian is t²/2κ with the pull t = max(0, λ + κ(|p| − L)), and λ ← t after
//! each Newton step. Its second derivative is κ along p and t/|p| across. Contact keeps the rows of a seam apart.

use super::constants::{SLOWEST_CHANGE, STIFFER_THAN_LIMITS};
use super::matrix::{Matrix, directed};
use super::term::{Prediction, Renewed, Term};
use crate::model::length::length;
use crate::model::step::TimeStep;
use crate::model::stitches::{Sewing, Stitch, length_at_end};
use selvedge_core::glam::DVec3;

/// The stitches of a seam.
#[derive(Debug)]
pub(crate) struct Stitches {
    sewing: Sewing,
    stitches: Vec<Pull>,
    /// The length of the step for which the stiffness was chosen, in seconds.
    weighed: f64,
    h: f64,
}

#[derive(Clone, Copy, Debug)]
struct Pull {
    vertices: [u32; 3],
    weights: [f64; 3],
    /// κ, in N/m; zero before it is known.
    stiffness: f64,
    /// L at the end of the step, in m.
    length: f64,
    /// λ in this solve, and at the end of the last accepted step, in N.
    multiplier: f64,
    accepted: f64,
}

impl Stitches {
    pub(crate) fn new(sewing: Sewing) -> Self {
        let pull = |(stitch, _): &(Stitch, f64)| Pull {
            vertices: stitch.vertices,
            weights: stitch.weights(),
            stiffness: 0.0,
            length: 0.0,
            multiplier: 0.0,
            accepted: 0.0,
        };
        Self {
            stitches: sewing.stitches.iter().map(pull).collect(),
            sewing,
            weighed: 0.0,
            h: 0.0,
        }
    }
}

impl Pull {
    fn between(&self, x: &[DVec3]) -> DVec3 {
        let [a, b, c] = self.vertices.map(|vertex| x[vertex as usize]);
        a * self.weights[0] + b * self.weights[1] + c * self.weights[2]
    }

    /// Returns the pull t at a distance.
    fn at(&self, distance: f64) -> f64 {
        (self.multiplier + self.stiffness * (distance - self.length)).max(0.0)
    }

    fn energy(&self, distance: f64) -> f64 {
        0.5 * self.at(distance).powi(2) / self.stiffness
    }

    fn scatter(&self, force: DVec3, gradient: &mut [DVec3]) {
        for (&vertex, weight) in self.vertices.iter().zip(self.weights) {
            gradient[vertex as usize] += force * weight;
        }
    }
}

impl Term for Stitches {
    fn begin(&mut self, step: &TimeStep<'_>, _: &Prediction, _: &[DVec3]) {
        self.h = step.h;
        let Sewing { stitches, gap, closing } = &self.sewing;
        for (pull, (_, start)) in self.stitches.iter_mut().zip(stitches) {
            pull.length = length_at_end(step, *start, *gap, *closing);
            pull.multiplier = pull.accepted;
        }
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for pull in self.stitches.iter().filter(|pull| pull.stiffness > 0.0) {
            let between = pull.between(x);
            let distance = length(between);
            let force = pull.at(distance);
            if force > 0.0 && distance > 0.0 {
                energy += pull.energy(distance);
                pull.scatter(between * (force / distance), gradient);
            }
        }
        energy
    }

    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        for pull in self.stitches.iter().filter(|pull| pull.stiffness > 0.0) {
            let between = pull.between(x);
            let distance = length(between);
            let force = pull.at(distance);
            if force > 0.0 && distance > 0.0 {
                let across = (force / distance).min(pull.stiffness);
                matrix.add_link(&pull.vertices, &pull.weights, directed(between / distance, pull.stiffness, across));
            }
        }
    }

    fn weigh(&mut self, matrix: &Matrix) -> bool {
        if self.h == self.weighed {
            return false;
        }
        self.weighed = self.h;
        for pull in &mut self.stitches {
            let along = DVec3::AXES.map(|axis| matrix.compliance(&pull.vertices, &pull.weights, axis));
            let compliance = along.iter().sum::<f64>() / 3.0;
            pull.stiffness = if compliance > 0.0 { STIFFER_THAN_LIMITS / compliance } else { 0.0 };
        }
        true
    }

    fn renew(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> Renewed {
        let mut renewed = Renewed::default();
        for pull in self.stitches.iter_mut().filter(|pull| pull.stiffness > 0.0) {
            let between = pull.between(x);
            let distance = length(between);
            let (before, energy) = (pull.at(distance), pull.energy(distance));
            let change = (before - pull.multiplier).abs() / pull.stiffness;
            pull.multiplier = before;
            let after = pull.at(distance);
            renewed.energy += pull.energy(distance) - energy;
            renewed.error = renewed.error.max(change / (SLOWEST_CHANGE * self.h).max(SHARE * pull.length));
            if distance > 0.0 {
                pull.scatter(between * ((after - before) / distance), gradient);
            }
        }
        renewed
    }

    fn accept(&mut self, is_moved: &[bool]) {
        for pull in &mut self.stitches {
            let is_moved = pull.vertices.iter().any(|&vertex| is_moved[vertex as usize]);
            pull.accepted = if is_moved { 0.0 } else { pull.multiplier };
        }
    }

    fn forget(&mut self) {
        self.stitches.iter_mut().for_each(|pull| pull.accepted = 0.0);
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn joints(&self) -> Vec<[u32; 2]> {
        self.stitches.iter().flat_map(|pull| pull.vertices[1..].iter().map(|&other| [pull.vertices[0], other])).collect()
    }
}

/// The change of a stitch's length that does not matter, as a share of the length.
const SHARE: f64 = 0.01;
