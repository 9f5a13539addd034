//! Stitches: points that a seam draws to within a length L of each other, and ties, which keep two vertices in one place.
//!
//! With p the vector between the points, the augmented Lagrangian of a stitch is t²/2κ with the pull t = λ + κ(|p| − L), at least
//! zero until the seam is closed, and λ ← t after each Newton step. Its second derivative is κ along p and t/|p| across. Contact
//! keeps the rows of a seam apart.
//!
//! A tie has no direction: its multiplier is a vector, its pull λ + κp, and its second derivative κ along all axes. κ is that of
//! its stiffer side, so that a light cord carries a heavy load within a few Newton steps.

use super::constants::{RECOVERY, SLOWEST_CHANGE, STIFFER_THAN_LIMITS};
use super::matrix::{Matrix, directed};
use super::term::{Prediction, Renewed, Term};
use crate::model::length::length;
use crate::model::step::TimeStep;
use crate::model::stitches::{Sewing, Stitch, length_at_end};
use selvedge_core::glam::{DMat3, DVec3};

/// The change of a stitch's length that does not matter, as a share of the length.
const SHARE: f64 = 0.01;
/// κ is chosen again when the compliance of its sides has changed by this factor.
const OTHER: f64 = 2.0;

/// The stitches of a seam.
#[derive(Debug)]
pub(crate) struct Stitches {
    sewing: Sewing,
    stitches: Vec<Pull>,
    h: f64,
}

#[derive(Clone, Copy, Debug)]
struct Pull {
    vertices: [u32; 3],
    weights: [f64; 3],
    /// κ, in N/m; zero before it is known.
    stiffness: f64,
    /// L at the end of the step, in m; zero for a tie.
    length: f64,
    /// True if the seam is closed: the points are then at the distance L, and no nearer.
    is_closed: bool,
    /// λ in this solve, and at the end of the last accepted step, in N. Of a stitch, x is the pull.
    multiplier: DVec3,
    accepted: DVec3,
}

impl Stitches {
    pub(crate) fn new(sewing: Sewing) -> Self {
        let pull = |(stitch, _): &(Stitch, f64)| Pull {
            vertices: stitch.vertices,
            weights: stitch.weights(),
            stiffness: 0.0,
            length: 0.0,
            is_closed: false,
            multiplier: DVec3::ZERO,
            accepted: DVec3::ZERO,
        };
        Self {
            stitches: sewing.stitches.iter().map(pull).collect(),
            sewing,
            h: 0.0,
        }
    }
}

/// A force on the vector between the points, with its energy.
struct Force {
    along: DVec3,
    energy: f64,
}

impl Pull {
    fn between(&self, x: &[DVec3]) -> DVec3 {
        let [a, b, c] = self.vertices.map(|vertex| x[vertex as usize]);
        a * self.weights[0] + b * self.weights[1] + c * self.weights[2]
    }

    fn is_tie(&self) -> bool {
        self.length == 0.0
    }

    /// Returns the force for a vector between the points.
    fn force(&self, between: DVec3) -> Force {
        if !(self.stiffness > 0.0) {
            return Force {
                along: DVec3::ZERO,
                energy: 0.0,
            };
        }
        let along = if self.is_tie() {
            self.multiplier + between * self.stiffness
        } else {
            let distance = length(between);
            let mut pull = self.multiplier.x + self.stiffness * (distance - self.length);
            if !self.is_closed && !(pull > 0.0) {
                pull = 0.0;
            }
            if distance > 0.0 {
                between * (pull / distance)
            } else {
                DVec3::ZERO
            }
        };
        Force {
            along,
            energy: 0.5 * along.length_squared() / self.stiffness,
        }
    }

    fn scatter(&self, force: DVec3, gradient: &mut [DVec3]) {
        for (&vertex, weight) in self.vertices.iter().zip(self.weights) {
            gradient[vertex as usize] += force * weight;
        }
    }

    /// Returns κ for the compliances of a matrix.
    fn wanted(&self, matrix: &Matrix, x: &[DVec3]) -> f64 {
        let compliance =
            |which: std::ops::Range<usize>, axis| matrix.compliance(&self.vertices[which.clone()], &self.weights[which], axis);
        let compliance = if self.is_tie() {
            let of_side = |which: std::ops::Range<usize>| {
                DVec3::AXES
                    .map(|axis| compliance(which.clone(), axis))
                    .into_iter()
                    .fold(0.0, f64::max)
            };
            let [one, other] = [of_side(0..1), of_side(1..3)];
            // A side that does not move has no compliance.
            if one > 0.0 && other > 0.0 {
                one.min(other)
            } else {
                one.max(other)
            }
        } else {
            let axis = self.between(x).try_normalize().unwrap_or(DVec3::Z);
            compliance(0..3, axis)
        };
        if compliance > 0.0 {
            STIFFER_THAN_LIMITS / compliance
        } else {
            0.0
        }
    }
}

impl Term for Stitches {
    fn begin(&mut self, step: &TimeStep<'_>, _: &Prediction, _: &[DVec3]) {
        self.h = step.h;
        let is_tie = self.sewing.is_closed_tie(step);
        let Sewing { stitches, gap, closing } = &self.sewing;
        for (pull, (_, start)) in self.stitches.iter_mut().zip(stitches) {
            let length = if is_tie {
                0.0
            } else {
                length_at_end(step, *start, *gap, *closing)
            };
            if (length == 0.0) != pull.is_tie() {
                pull.accepted = DVec3::ZERO;
            }
            // The seam closes by its schedule. What is too long besides comes together at the rate at which contacts come apart.
            let before = length_at_end(&TimeStep { h: 0.0, ..*step }, *start, *gap, *closing);
            let late = (pull.between(step.start).length() - before.max(length)).max(0.0);
            let late = if length > 0.0 { late } else { 0.0 };
            pull.is_closed = length == *gap;
            pull.length = length + late * (1.0 - (RECOVERY * step.h).min(1.0));
            pull.multiplier = pull.accepted;
        }
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for pull in &self.stitches {
            let force = pull.force(pull.between(x));
            energy += force.energy;
            pull.scatter(force.along, gradient);
        }
        energy
    }

    fn curvature(&mut self, _: &[DVec3], _: &mut Matrix) {}

    fn curvature_of_multipliers(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        for pull in self.stitches.iter().filter(|pull| pull.stiffness > 0.0) {
            let between = pull.between(x);
            if pull.is_tie() {
                let stiffness = DMat3::from_diagonal(DVec3::splat(pull.stiffness));
                matrix.add_tie(&pull.vertices[..2], &[1.0, -1.0], stiffness);
                continue;
            }
            let distance = length(between);
            let force = pull.force(between).along.dot(between);
            if force != 0.0 {
                let across = (force / (distance * distance)).clamp(0.0, pull.stiffness);
                matrix.add_late(
                    &pull.vertices,
                    &pull.weights,
                    directed(between / distance, pull.stiffness, across),
                );
            }
        }
    }

    fn weigh(&mut self, matrix: &Matrix, x: &[DVec3]) -> bool {
        let mut has_changed = false;
        for pull in &mut self.stitches {
            let wanted = pull.wanted(matrix, x);
            if !(wanted <= OTHER * pull.stiffness && pull.stiffness <= OTHER * wanted) {
                pull.stiffness = wanted;
                has_changed = true;
            }
        }
        has_changed
    }

    fn renew(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> Renewed {
        let mut renewed = Renewed::default();
        for pull in self.stitches.iter_mut().filter(|pull| pull.stiffness > 0.0) {
            let between = pull.between(x);
            let before = pull.force(between);
            let multiplier = if pull.is_tie() {
                before.along
            } else {
                DVec3::X * before.along.dot(between.normalize_or_zero())
            };
            let change = length(multiplier - pull.multiplier) / pull.stiffness;
            renewed.error = renewed.error.max(change / (SLOWEST_CHANGE * self.h).max(SHARE * pull.length));
            pull.multiplier = multiplier;
            let after = pull.force(between);
            renewed.energy += after.energy - before.energy;
            pull.scatter(after.along - before.along, gradient);
        }
        renewed
    }

    fn accept(&mut self, is_moved: &[bool]) {
        for pull in &mut self.stitches {
            let is_moved = pull.vertices.iter().any(|&vertex| is_moved[vertex as usize]);
            pull.accepted = if is_moved { DVec3::ZERO } else { pull.multiplier };
        }
    }

    /// Returns λ, κ and L of each stitch.
    fn multipliers(&self) -> Vec<f64> {
        let numbers = |pull: &Pull| {
            let [x, y, z] = pull.accepted.to_array();
            [x, y, z, pull.stiffness, pull.length]
        };
        self.stitches.iter().flat_map(numbers).collect()
    }

    fn set_multipliers(&mut self, numbers: &[f64]) {
        for (pull, own) in self.stitches.iter_mut().zip(numbers.as_chunks::<5>().0) {
            pull.accepted = DVec3::new(own[0], own[1], own[2]);
            (pull.stiffness, pull.length) = (own[3], own[4]);
        }
    }

    fn forget(&mut self) {
        for pull in &mut self.stitches {
            (pull.accepted, pull.stiffness) = (DVec3::ZERO, 0.0);
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn joints(&self) -> Vec<[u32; 2]> {
        self.stitches
            .iter()
            .flat_map(|pull| pull.vertices[1..].iter().map(|&other| [pull.vertices[0], other]))
            .collect()
    }
}
