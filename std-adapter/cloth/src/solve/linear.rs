//! The linear problem of a Newton step: conjugate gradients, with contacts that join in and drop out.
//!
//! ```text
//! contacts that push at x ─▶ conjugate gradients ─▶ do others push after the moves? ─▶ end
//!                                  ▲                        │ yes
//!                                  └── these contacts ◀─────┘
//! ```
//!
//! **Contacts.** A contact that takes part pulls as well as it pushes, and another one does not stop anything. So the moves may
//! press far into a contact that they meet, and the line search would end there: half of all Newton steps were short where cloth
//! buckles on a body. The linear problem is solved again with the contacts that push after the moves, from these moves on, as
//! long as the energy of those that change matters. (This is Newton's method for the piecewise quadratic energy of all contacts,
//! an active-set method: Hintermüller, Ito and Kunisch 2002.)
//!
//! **The end.** Iteration i of conjugate gradients lowers twice the energy by dᵢ, the square of the energy norm of what it mends
//! (Hestenes and Stiefel 1952). The error is about that of the next iterations, and those are like the last ones. So it ends when
//! the last third has mended little: at most the accuracy squared of all that the step has mended. While a Newton step mends
//! much, the next one has another matrix, and it ends at a [share](LINEAR_SHARE) of that already.

use super::Solve;
use super::constants::{LINEAR_SHARE, MOST_ITERATIONS, MOST_ROUNDS, NEGLIGIBLE};
use super::matrix::dot;
use super::term::Prediction;
use super::tolerance::{Outcome, Tolerance};
use selvedge_core::glam::{DVec3, Vec3A};

/// The least number of last iterations that must mend little. A single one may mend little by chance.
const FEWEST: usize = 2;

/// The vectors of conjugate gradients; their memory is used again.
#[derive(Debug, Default)]
pub(super) struct Vectors {
    pub(super) residual: Vec<Vec3A>,
    pub(super) moves: Vec<Vec3A>,
    pub(super) image: Vec<Vec3A>,
    pub(super) direction: Vec<Vec3A>,
    pub(super) product: Vec<Vec3A>,
}

/// The linear problem of a Newton step.
#[derive(Debug, Default)]
pub(super) struct Linear {
    pub(super) vectors: Vectors,
    /// The gradient of terms and of the contacts that take part; at the end of a solve, that of everything there.
    pub(super) gradient: Vec<DVec3>,
    /// The pushes after the moves.
    pushes: Vec<f64>,
    /// Twice the energy that each iteration has mended, in J.
    drops: Vec<f64>,
    /// Twice the energy that the earlier Newton steps of the solve have mended, in J.
    before: f64,
}

impl Linear {
    pub(super) fn resize(&mut self, count: usize) {
        let Vectors {
            residual,
            moves,
            image,
            direction,
            product,
        } = &mut self.vectors;
        for vector in [residual, moves, image, direction, product] {
            vector.resize(count, Vec3A::ZERO);
        }
        self.drops.clear();
        self.drops.reserve(MOST_ITERATIONS);
    }
}

impl Solve {
    /// Finds the gradient with the contacts that take part, and the residual without moves.
    pub(super) fn find_residual(&self, prediction: &Prediction, x: &[DVec3], of_terms: &[DVec3], linear: &mut Linear) {
        let Linear { vectors, gradient, .. } = linear;
        gradient.clear();
        gradient.extend_from_slice(of_terms);
        { self.rows.iter() }.for_each(|row| row.add_gradient(x, true, gradient, &self.bodies));
        for ((residual, gradient), mass) in vectors.residual.iter_mut().zip(&*gradient).zip(&prediction.masses) {
            *residual = if *mass > 0.0 { (-*gradient).as_vec3a() } else { Vec3A::ZERO };
        }
        let first = self.bodies.first_slot;
        for (residual, gradient) in vectors.residual[first..].iter_mut().zip(&gradient[first..]) {
            *residual = (-*gradient).as_vec3a();
        }
        self.bodies.visit_riders(&mut |vertex, slot, arm| {
            let force = -gradient[vertex];
            vectors.residual[slot] += force.as_vec3a();
            vectors.residual[slot + 1] += arm.cross(force).as_vec3a();
        });
        self.bodies.lock(&mut vectors.residual);
    }

    /// Finds the moves of a Newton step from the residual at `x`, where `of_terms` is the gradient of the terms, and the matrix
    /// without multipliers. Returns rᵀWr of what remains, or zero if another Newton step is needed in any case.
    pub(super) fn find_moves(
        &mut self,
        prediction: &Prediction,
        (x, of_terms): (&[DVec3], &[DVec3]),
        linear: &mut Linear,
        tolerance: &mut Tolerance,
        outcome: &mut Outcome,
    ) -> f64 {
        for entry in &mut self.terms {
            entry.timed(|action| action.curvature_of_multipliers(x, &mut self.matrix));
        }
        self.matrix.begin_contacts();
        { self.rows.iter() }.for_each(|row| row.add_curvature(x, &mut self.matrix, &self.bodies));
        self.preconditioner.prepare(&self.matrix);
        linear.vectors.moves.fill(Vec3A::ZERO);
        linear.before = tolerance.mended;
        let mut rest = self.descend(linear, tolerance, outcome);
        for _ in 1..MOST_ROUNDS {
            if !self.change_contacts(x, linear, tolerance) {
                break;
            }
            self.find_residual(prediction, x, of_terms, linear);
            let Vectors {
                residual,
                moves,
                product,
                ..
            } = &mut linear.vectors;
            self.matrix.multiply(moves, product);
            // Moves m mend 2m·r − m·A·m = m·r + m·(r − A·m) of twice the energy.
            let mut mended = dot(moves, residual);
            for ((residual, product), mass) in residual.iter_mut().zip(&*product).zip(&prediction.masses) {
                if *mass > 0.0 {
                    *residual -= *product;
                }
            }
            let first = self.bodies.first_slot;
            for (residual, product) in residual[first..].iter_mut().zip(&product[first..]) {
                *residual -= *product;
            }
            mended += dot(moves, residual);
            tolerance.mended = linear.before + mended.max(0.0);
            rest = self.descend(linear, tolerance, outcome);
        }
        rest
    }

    /// Lets the contacts that push after the moves take part, and no others. Returns false, and changes nothing, if it does not
    /// matter.
    fn change_contacts(&mut self, x: &[DVec3], linear: &mut Linear, tolerance: &Tolerance) -> bool {
        let Linear { vectors, pushes, .. } = linear;
        pushes.clear();
        pushes.extend({ self.rows.iter() }.map(|row| row.push_after(x, &vectors.moves, &self.bodies)));
        let changes = self.rows.iter().zip(&*pushes);
        let changes = changes.filter(|(row, push)| row.is_active != (**push > 0.0));
        let twice_energy: f64 = changes.map(|(row, push)| push * push / row.stiffness).sum();
        if !(twice_energy > NEGLIGIBLE * tolerance.rest()) {
            return false;
        }
        self.matrix.remove_contacts();
        for (row, push) in self.rows.iter_mut().zip(pushes) {
            if row.is_active != (*push > 0.0) {
                row.take_part(*push > 0.0);
            }
        }
        { self.rows.iter() }.for_each(|row| row.add_curvature(x, &mut self.matrix, &self.bodies));
        self.preconditioner.renew(&self.matrix);
        true
    }

    /// Adds moves that lower the energy, by conjugate gradients. Returns rᵀWr of what remains, or zero if it has ended before
    /// little is left.
    fn descend(&mut self, linear: &mut Linear, tolerance: &mut Tolerance, outcome: &mut Outcome) -> f64 {
        let Self {
            matrix, preconditioner, ..
        } = self;
        let Linear {
            vectors, drops, before, ..
        } = linear;
        drops.clear();
        let mut rest = preconditioner.measure(matrix, &vectors.residual, &mut vectors.image);
        vectors.direction.clone_from(&vectors.image);
        for _ in 0..MOST_ITERATIONS {
            // NaN ends the iteration, too.
            if !(rest > 0.0) {
                break;
            }
            matrix.coupled.carry_riders(&mut vectors.direction);
            matrix.multiply(&vectors.direction, &mut vectors.product);
            let curvature = dot(&vectors.direction, &vectors.product);
            if !(curvature > 0.0) {
                matrix.may_be_indefinite = false;
                if tolerance.mended == *before {
                    // Along the preconditioned force the energy falls in any case.
                    vectors.moves.clone_from(&vectors.image);
                    matrix.coupled.carry_riders(&mut vectors.moves);
                }
                break;
            }
            outcome.iterations += 1;
            let by = rest / curvature;
            drops.push(by * rest);
            tolerance.mended += by * rest;
            let next = preconditioner.follow(matrix, by as f32, vectors);
            let share = (next / rest) as f32;
            rest = next;
            let last = FEWEST.max(drops.len() / 3);
            if drops.len() >= last {
                let of_last: f64 = drops.iter().rev().take(last).sum();
                if of_last <= tolerance.rest() {
                    break;
                }
                if of_last <= LINEAR_SHARE * LINEAR_SHARE * (tolerance.mended - *before) {
                    return 0.0;
                }
            }
            for (direction, image) in vectors.direction.iter_mut().zip(&vectors.image) {
                *direction = *image + *direction * share;
            }
        }
        rest
    }
}
