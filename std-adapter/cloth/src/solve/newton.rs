//! Newton's method on the augmented Lagrangian of a step.
//!
//! ```text
//!            ┌──────────────────────────────────────────────────────────────────────────┐
//! x ─▶ gradient ─▶ converged? ─▶ matrix ─▶ conjugate gradients ─▶ line search ─▶ renew multipliers
//!                      └─▶ end
//! ```
//!
//! **The end.** Newton's method ends when the remaining force is about what the linear problem left, and the multipliers change
//! little. What remains must also move little, in the norm of the masses, beside the way from the first guess. A rope that swings
//! is longer at the first guess, by the square of its turn. That stretch has so much energy that the energy alone would let the
//! swing go on for ever: law of the hanging chain.
//!
//! **Stiff cloth** has much energy at the first guess. Forces are right when a small share of it remains, but that share may
//! still exceed the energy of the motion. Then Newton's method goes on until
//! [little remains beside the motion](super::tolerance::Tolerance::bound_by). Contacts keep their multipliers meanwhile: where
//! there is no room, each renewal adds to them.
//!
//! **Not finished** after the most Newton steps is not a failure. Multipliers go on in the next step, and the certificate guards
//! the state. A cloth that buckles goes down from a saddle of the energy, which takes many steps, and none of them is wrong.

use super::carried_loads::CarriedLoads;
use super::constants::{MOST_HALVINGS, MOST_NEWTON_STEPS, NEARLY_LINEAR, SLOWEST_CHANGE, SMALL_CHANGE};
use super::contact_row::ContactRow;
use super::linear::{Linear, Vectors};
use super::matrix::dot;
use super::rigid::RigidBodies;
use super::term::{Prediction, Term};
use super::tolerance::{Outcome, Tolerance};
use super::{Solve, row_stiffness};
use crate::effects::plan::Entry;
use crate::model::length::{larger, length};
use crate::model::rigid::RigidMotion;
use crate::model::step::TimeStep;
use selvedge_core::glam::DVec3;

/// The rounding of the energy, as a share of it, and in J.
const ROUNDING: [f64; 2] = [1e-9, 1e-13];
/// A share of a Newton step above which it counts as whole.
const NEARLY_WHOLE: f64 = 0.9;
/// A share of a Newton step at which multipliers are renewed.
const ENOUGH: f64 = 0.7;
/// The least share of a Newton step that the line search chooses.
const LEAST_SHARE: f64 = 0.02;
/// The bisections of the line search, which then knows a share to a four-thousandth.
const BISECTIONS: usize = 12;

/// Buffers of a solve; their memory is used again.
#[derive(Debug, Default)]
pub(super) struct Work {
    guess: Vec<DVec3>,
    gradient: Vec<DVec3>,
    next_gradient: Vec<DVec3>,
    next: Vec<DVec3>,
    pub(super) linear: Linear,
    pieces: Vec<[f64; 3]>,
    /// The motions of free bodies at the guess, and before the present trial of the line search.
    guess_of_bodies: Vec<RigidMotion>,
    before: Vec<RigidMotion>,
}

/// An energy that is not finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NotFinite;

impl Solve {
    /// Moves `x` to the least energy. `follow` finds the normals of
    /// smooth bodies again.
    ///
    /// # Errors
    /// Returns an error if the energy is not finite.
    pub(super) fn minimise(
        &mut self,
        step: &TimeStep<'_>,
        prediction: &Prediction,
        x: &mut Vec<DVec3>,
        follow: &dyn Fn(&mut ContactRow, &[DVec3], &mut RigidBodies),
    ) -> Result<Outcome, NotFinite> {
        let mut work = std::mem::take(&mut self.work);
        work.linear.resize(prediction.masses.len() + self.bodies.slots());
        work.guess_of_bodies.clear();
        work.guess_of_bodies.extend(self.bodies.motions());
        let mut tolerance = Tolerance::new(self.accuracy, prediction, self.bodies.mass());
        let mut outcome = Outcome::default();
        work.guess.clone_from(x);
        self.matrix.may_be_indefinite = true;
        for entry in &mut self.terms {
            entry.timed(|action| action.begin(step, prediction, x));
        }
        let mut energy = gradient(&mut self.terms, &self.bodies, prediction, x, &mut work.gradient);
        self.weigh_rows(prediction, x, &mut energy, &mut work.gradient);
        let (mut error, mut was_short, mut linear_rest) = (f64::INFINITY, false, f64::INFINITY);
        let mut result = Ok(());
        for newton in 0..=MOST_NEWTON_STEPS {
            if !energy.is_finite() {
                result = Err(NotFinite);
                break;
            }
            if newton > 0 {
                for row in self.rows.iter_mut().filter(|row| row.is_smooth()) {
                    follow(row, x, &mut self.bodies);
                }
            }
            let goal = (newton == 0).then_some(&prediction.goal[..]);
            self.rows.iter_mut().for_each(|row| row.choose(x, goal));
            self.find_residual(prediction, x, &work.gradient, &mut work.linear);
            if newton > 0 {
                let Vectors { residual, image, .. } = &mut work.linear.vectors;
                let left = self.preconditioner.measure(&self.matrix, residual, image);
                let [left_to_move, moved] = work.motion(prediction, x, &self.bodies);
                let little = NEARLY_LINEAR * linear_rest;
                let is_right = left <= tolerance.rest().max(little) && left_to_move <= tolerance.rest_of(moved).max(little);
                if is_right && error <= 1.0 {
                    outcome.is_finished = true;
                    if tolerance.is_bounded() {
                        break;
                    }
                    tolerance.bound_by(moved);
                    if left <= tolerance.rest() {
                        break;
                    }
                }
                if newton == MOST_NEWTON_STEPS {
                    break;
                }
                self.assemble(prediction, x);
            }
            let at = (&x[..], &work.gradient[..]);
            linear_rest = self.find_moves(prediction, at, &mut work.linear, &mut tolerance, &mut outcome);
            outcome.newton_steps += 1;
            let mut share = self.advance(prediction, x, &mut energy, &mut work);
            if share == 0.0 {
                // The contacts of the linear problem may lead up. Along the force there is always a way down.
                self.find_descent(prediction, x, &mut work);
                share = self.advance(prediction, x, &mut energy, &mut work);
            }
            if tolerance.is_bounded() {
                self.renew_terms(x, &mut energy, &mut work.gradient);
            } else if share > ENOUGH || std::mem::replace(&mut was_short, true) {
                was_short = false;
                error = self.renew(step.h, prediction, x, &mut energy, &mut work.gradient);
            } else {
                error = f64::INFINITY;
            }
        }
        self.work = work;
        result.map(|()| outcome)
    }

    /// Returns the energy of inertia and all terms at `x`, after a solve.
    pub(crate) fn energy(&mut self, prediction: &Prediction, x: &[DVec3]) -> f64 {
        gradient(&mut self.terms, &self.bodies, prediction, x, &mut self.work.next_gradient)
    }

    /// Returns the energy of motion at `x`, in J; but for [QUIET](super::constants::QUIET) motion, which counts as that.
    pub(crate) fn motion(&self, prediction: &Prediction, x: &[DVec3]) -> f64 {
        let Prediction { masses, base, .. } = prediction;
        let each = masses.iter().zip(x.iter().zip(base));
        let moved = each.map(|(mass, (x, base))| mass * x.distance_squared(*base)).sum::<f64>() + self.bodies.squared_step();
        0.5 * Tolerance::new(self.accuracy, prediction, self.bodies.mass()).visible(moved)
    }

    /// Lets the moves be the preconditioned force at `x`.
    fn find_descent(&mut self, prediction: &Prediction, x: &[DVec3], work: &mut Work) {
        self.matrix.remove_contacts();
        self.rows.iter_mut().for_each(|row| row.choose(x, None));
        { self.rows.iter() }.for_each(|row| row.add_curvature(x, &mut self.matrix, &self.bodies));
        self.preconditioner.renew(&self.matrix);
        self.find_residual(prediction, x, &work.gradient, &mut work.linear);
        let Vectors {
            residual, image, moves, ..
        } = &mut work.linear.vectors;
        self.preconditioner.measure(&self.matrix, residual, image);
        moves.clone_from(image);
        self.matrix.coupled.carry_riders(moves);
    }

    /// Fills the matrix with the terms at `x`.
    fn assemble(&mut self, prediction: &Prediction, x: &[DVec3]) {
        self.matrix.clear(&prediction.masses);
        self.matrix.begin_bodies(&self.bodies);
        for entry in &mut self.terms {
            entry.timed(|action| action.curvature(x, &mut self.matrix));
        }
        self.matrix.find_diagonal();
    }

    /// Fills the matrix, and chooses the stiffness of multipliers.
    fn weigh_rows(&mut self, prediction: &Prediction, x: &[DVec3], energy: &mut f64, slope: &mut Vec<DVec3>) {
        self.assemble(prediction, x);
        let mut has_changed = false;
        for entry in &mut self.terms {
            has_changed |= entry.timed(|action| action.weigh(&self.matrix, x));
        }
        if has_changed {
            *energy = gradient(&mut self.terms, &self.bodies, prediction, x, slope);
        }
        let (matrix, bodies) = (&self.matrix, &self.bodies);
        let loads = CarriedLoads::new(&self.rows, bodies, &prediction.goal);
        self.rows.retain_mut(|row| {
            row.stiffness = row_stiffness(row, matrix, bodies, &loads);
            row.stiffness > 0.0
        });
    }

    /// Moves `x` by a share of the moves at which the energy is less, and finds energy and gradient there. Returns the share.
    fn advance(&mut self, prediction: &Prediction, x: &mut Vec<DVec3>, energy: &mut f64, work: &mut Work) -> f64 {
        let mut share = if self.rows.is_empty() { 1.0 } else { self.best_share(x, work) };
        let of_rows = |rows: &[ContactRow], x: &[DVec3]| rows.iter().map(|row| row.energy(x)).sum::<f64>();
        let before = *energy + of_rows(&self.rows, x);
        work.next.clone_from(x);
        work.before.clear();
        work.before.extend(self.bodies.motions());
        for _ in 0..MOST_HALVINGS {
            let moves = &work.linear.vectors.moves;
            for ((next, x), moved) in work.next.iter_mut().zip(&*x).zip(&moves[..self.bodies.first_slot]) {
                *next = *x + moved.as_dvec3() * share;
            }
            if !self.bodies.is_empty() {
                self.bodies.advance(&work.before, moves, share);
                self.bodies.put(&mut work.next);
                { self.rows.iter_mut() }.for_each(|row| row.refresh(&self.bodies));
            }
            let found = gradient(&mut self.terms, &self.bodies, prediction, &work.next, &mut work.next_gradient);
            let [relative, absolute] = ROUNDING;
            if found + of_rows(&self.rows, &work.next) <= before + relative * before.abs() + absolute {
                *energy = found;
                std::mem::swap(x, &mut work.next);
                std::mem::swap(&mut work.gradient, &mut work.next_gradient);
                return share;
            }
            share *= 0.5;
        }
        // Nothing on the way is less: other multipliers may have another way.
        self.bodies.go_back(&work.before);
        { self.rows.iter_mut() }.for_each(|row| row.refresh(&self.bodies));
        *energy = gradient(&mut self.terms, &self.bodies, prediction, x, &mut work.gradient);
        0.0
    }

    /// Returns the share of the moves with the least energy, for the quadratic model of the terms and the exact energy of pushes.
    fn best_share(&self, x: &[DVec3], work: &mut Work) -> f64 {
        let Vectors { residual, moves, .. } = &work.linear.vectors;
        let along = |gradient: &[DVec3]| {
            let each = gradient.iter().zip(moves);
            each.map(|(gradient, moved)| gradient.dot(moved.as_dvec3())).sum::<f64>()
        };
        let mut slope = along(&work.gradient);
        // A·moves is minus the gradient and what remains.
        let mut bend = -along(&work.linear.gradient) - dot(residual, moves);
        work.pieces.clear();
        for row in &self.rows {
            let along = row.along(x, moves, &self.bodies);
            slope += along.slope;
            bend += along.bend;
            work.pieces.extend(along.piece);
        }
        let at = |share: f64| {
            let pushes = work
                .pieces
                .iter()
                .map(|[push, fall, offset]| larger(push - fall * share, 0.0) * offset);
            slope + share * bend - pushes.sum::<f64>()
        };
        if at(1.0) <= 0.0 {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if at(middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        if high > NEARLY_WHOLE { 1.0 } else { high.max(LEAST_SHARE) }
    }

    /// Renews the multipliers of terms. Returns the largest change over the one that does not matter.
    fn renew_terms(&mut self, x: &[DVec3], energy: &mut f64, gradient: &mut [DVec3]) -> f64 {
        let mut error = 0.0_f64;
        let (of_cloth, _) = gradient.split_at_mut(self.bodies.first_slot);
        for entry in &mut self.terms {
            let renewed = entry.timed(|action| action.renew(x, of_cloth));
            *energy += renewed.energy;
            error = error.max(renewed.error);
        }
        error
    }

    /// Renews all multipliers. Returns the largest change over the one that does not matter.
    fn renew(&mut self, h: f64, prediction: &Prediction, x: &[DVec3], energy: &mut f64, gradient: &mut [DVec3]) -> f64 {
        let mut error = self.renew_terms(x, energy, gradient);
        if self.rows.is_empty() {
            return error;
        }
        let farthest = x
            .iter()
            .zip(&prediction.base)
            .zip(&prediction.masses)
            .filter(|(_, mass)| **mass > 0.0);
        let farthest = farthest.map(|((x, base), _)| x.distance_squared(*base));
        let farthest = farthest.fold(self.bodies.farthest_squared(), larger).sqrt();
        let largest = self.accuracy.largest_change();
        let pulls = gradient.iter().zip(&prediction.masses).filter(|(_, mass)| **mass > 0.0);
        let all = pulls.map(|(pull, _)| length(*pull)).sum::<f64>() + self.bodies.pulls();
        for row in &mut self.rows {
            let change = row.renew(x, all);
            let small = (SMALL_CHANGE * farthest).min(largest * row.thickness).max(SLOWEST_CHANGE * h);
            error = error.max(change / small);
        }
        error
    }
}

impl Work {
    /// Returns the squares, in the norm of the masses, of what remains to move, and of the way from the first guess to `x`.
    fn motion(&self, prediction: &Prediction, x: &[DVec3], bodies: &RigidBodies) -> [f64; 2] {
        let by_mass = |vectors: &mut dyn Iterator<Item = DVec3>| {
            let each = prediction.masses.iter().zip(vectors);
            each.map(|(mass, vector)| mass * vector.length_squared()).sum::<f64>()
        };
        let image = &self.linear.vectors.image;
        let [of_bodies, moved_bodies] = bodies.motion(image, &self.guess_of_bodies);
        [
            by_mass(&mut image.iter().map(|image| image.as_dvec3())) + of_bodies,
            by_mass(&mut x.iter().zip(&self.guess).map(|(x, guess)| *x - *guess)) + moved_bodies,
        ]
    }
}

/// Finds the gradient of inertia and all terms at `x`, and returns their energy.
fn gradient(
    terms: &mut [Entry<dyn Term>],
    bodies: &RigidBodies,
    prediction: &Prediction,
    x: &[DVec3],
    gradient: &mut Vec<DVec3>,
) -> f64 {
    let Prediction { goal, masses, .. } = prediction;
    gradient.clear();
    let mut energy = 0.0;
    for ((x, goal), mass) in x.iter().zip(goal).zip(masses) {
        let offset = *x - *goal;
        gradient.push(offset * *mass);
        energy += 0.5 * mass * offset.length_squared();
    }
    energy += bodies.begin_gradient(gradient);
    let (of_cloth, _) = gradient.split_at_mut(bodies.first_slot);
    for entry in terms {
        energy += entry.timed(|action| action.gradient(x, of_cloth));
    }
    energy
}
