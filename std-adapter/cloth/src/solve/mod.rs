//! One solve a step: elasticity, loads, limits, contact and friction agree at the end of it.
//!
//! ```text
//! velocities, forces ─▶ prediction y, M ──┐
//! candidates ─────────▶ contact rows ─────┼─▶ Newton's method ─▶ x ─▶ certificate ─▶ accept: multipliers for the next step
//! effects ────────────▶ terms ────────────┘
//! ```
//!
//! A step minimises ½Σ M|x − y|² + Σ terms, with contacts, friction, strain limits and stitches as augmented Lagrangians. An
//! effect registers a [`Term`]: its energy, gradient and second derivative. A term that no effect registers does not exist, and
//! takes no time.
//!
//! | file | content |
//! |---|---|
//! | [`prediction`] | y and M: implicit Euler for what something presses, second order for the rest; where the solve begins |
//! | [`newton`], [`tolerance`] | the loop, and its end |
//! | [`linear`], [`matrix`], [`preconditioner`], [`bands`], [`coupled`] | the linear problem of a Newton step |
//! | [`contact_row`] | contact and friction |
//! | [`rigid`], [`rigid_body`], [`carried_loads`] | free rigid bodies: six unknowns each; what they press against something |
//! | [`membranes`], [`bending`], [`ropes`], [`stitches`], [`springs`], [`walls`], [`air`] | the terms |
//! | [`loads`] | the forces on bodies, pins and attachments |
//! | [`kept`] | what goes on from step to step, for checkpoints |
//! | [`constants`] | all constants, with their meaning |
//!
//! Sums run in a fixed order, so that the result has the same bits on any number of threads.

mod bands;
mod carried_loads;
mod constants;
mod contact_row;
mod coupled;
mod kept;
mod linear;
mod loads;
mod matrix;
mod newton;
mod preconditioner;
mod term;
mod tolerance;

pub(crate) mod air;
pub(crate) mod bending;
pub(crate) mod membranes;
pub(crate) mod prediction;
pub(crate) mod rigid;
pub(crate) mod rigid_body;
pub(crate) mod ropes;
pub(crate) mod springs;
pub(crate) mod stitches;
pub(crate) mod walls;

pub use constants::Accuracy;
#[cfg(doc)]
use constants::RECOVERY;
pub(crate) use contact_row::{ContactRow, Remembered, RowKey};
pub(crate) use kept::Kept;
pub(crate) use loads::SpringGroup;
pub use matrix::Matrix;
pub(crate) use newton::NotFinite;
pub use term::{Prediction, Renewed, Term};
pub(crate) use tolerance::Outcome;

use crate::contact::PairKey;
use crate::effects::plan::Entry;
use crate::model::step::TimeStep;
use carried_loads::CarriedLoads;
use constants::{GIVE, STIFFER_THAN_BODIES, STIFFER_THAN_CLOTH};
use preconditioner::Preconditioner;
use rigid::RigidBodies;
use rustc_hash::FxHashMap;
use selvedge::clock::Clock;
use selvedge_core::glam::DVec3;

/// The counts of the solves so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SolveCounts {
    /// Solves.
    pub solves: u64,
    /// Newton steps.
    pub newton_steps: u64,
    /// Iterations of conjugate gradients.
    pub iterations: u64,
    /// Solves that had not converged after the most Newton steps; they go on in the next step.
    pub unfinished: u64,
    /// Contacts of the solves, and those that pushed.
    pub contacts: u64,
    /// Contacts that pushed.
    pub pushing: u64,
}

/// The energy of a scene, and what its minimisation keeps from step to step.
#[derive(Debug)]
pub(crate) struct Solve {
    pub(crate) terms: Vec<Entry<dyn Term>>,
    pub(crate) rows: Vec<ContactRow>,
    /// The free bodies of the present step.
    pub(crate) bodies: RigidBodies,
    pub(crate) counts: SolveCounts,
    pub(crate) accuracy: Accuracy,
    /// The seconds so far, without those of the terms.
    pub(crate) seconds: f64,
    matrix: Matrix,
    preconditioner: Preconditioner,
    /// The contacts that pushed in the last accepted step.
    pushes: FxHashMap<RowKey, Remembered>,
    work: newton::Work,
}

impl Solve {
    /// Makes the solve of these terms. `triangles` are those of all cloths, and `ropes` are rows of successive vertices. The
    /// numbers are those of the cloths' vertices and of the free bodies.
    pub(crate) fn new(
        terms: Vec<Entry<dyn Term>>,
        accuracy: Accuracy,
        triangles: &[[u32; 3]],
        bending: &[([u32; 4], [f64; 4], f64)],
        ropes: &[Vec<u32>],
        [vertex_count, free_bodies]: [usize; 2],
    ) -> Self {
        Self {
            terms,
            rows: Vec::new(),
            bodies: RigidBodies::default(),
            counts: SolveCounts::default(),
            accuracy,
            seconds: 0.0,
            matrix: Matrix::new(triangles, bending, ropes, vertex_count + 2 * free_bodies),
            preconditioner: Preconditioner::default(),
            pushes: FxHashMap::default(),
            work: newton::Work::default(),
        }
    }

    /// Removes all rows, and returns their place and the free bodies, with a test whether a pair was a contact at rest in the
    /// last step, by its distance in thicknesses: it pushed, and is pressed by no more than a load may press it.
    pub(crate) fn begin_rows(&mut self) -> (&mut Vec<ContactRow>, &RigidBodies, impl Fn(PairKey, f64) -> bool + '_) {
        let Self {
            rows, bodies, pushes, ..
        } = self;
        rows.clear();
        let was_at_rest = |key, thicknesses| thicknesses >= 1.0 - GIVE && pushes.contains_key(&RowKey::Pair(key));
        (rows, bodies, was_at_rest)
    }

    /// Gives the rows the forces that they had in the last step, and chooses where they are at rest in one of `h` seconds.
    pub(crate) fn remind_rows(&mut self, h: f64) {
        for row in &mut self.rows {
            row.choose_rest(self.pushes.get(&row.key), h);
        }
    }

    /// Solves a step from the positions `x`, which it moves. `follow` finds the normals of smooth bodies again.
    ///
    /// # Errors
    /// Returns an error if the energy is not finite.
    pub(crate) fn run(
        &mut self,
        step: &TimeStep<'_>,
        prediction: &Prediction,
        x: &mut Vec<DVec3>,
        follow: &dyn Fn(&mut ContactRow, &[DVec3], &mut RigidBodies),
    ) -> Result<Outcome, NotFinite> {
        let begin = Clock::now();
        let result = self.minimise(step, prediction, x, follow);
        let of_terms: f64 = self.terms.iter().map(|entry| entry.seconds).sum();
        self.seconds += begin.elapsed().as_secs_f64() - of_terms;
        let outcome = result?;
        let counts = &mut self.counts;
        counts.solves += 1;
        counts.newton_steps += u64::from(outcome.newton_steps);
        counts.iterations += u64::from(outcome.iterations);
        counts.unfinished += u64::from(!outcome.is_finished);
        counts.contacts += self.rows.len() as u64;
        counts.pushing += self.rows.iter().filter(|row| row.push > 0.0).count() as u64;
        Ok(outcome)
    }

    /// Stores the multipliers of an accepted step, apart from those of vertices that the certificate has moved.
    pub(crate) fn accept(&mut self, is_moved: &[bool], h: f64) {
        for Entry { action, .. } in &mut self.terms {
            action.accept(is_moved);
        }
        self.pushes.clear();
        let pushing = self.rows.iter().filter(|row| row.push > 0.0);
        let kept = pushing.filter(|row| row.parts().all(|(vertex, _)| !is_moved[vertex]));
        self.pushes.extend(kept.map(|row| (row.key, row.remembered(h))));
    }

    /// Returns the length of the longest edge over its limit; `None` without a limit.
    pub(crate) fn longest_over_limit(&self, positions: &[DVec3]) -> Option<f64> {
        let over = self.terms.iter().filter_map(|entry| entry.action.over_limit(positions));
        over.reduce(f64::max)
    }

    /// Forgets all multipliers.
    pub(crate) fn forget(&mut self) {
        self.pushes.clear();
        self.rows.clear();
        self.terms.iter_mut().for_each(|entry| entry.action.forget());
    }

    /// Removes the terms that push from outside, for untangling.
    pub(crate) fn take_loads(&mut self) -> Vec<Entry<dyn Term>> {
        let all = std::mem::take(&mut self.terms);
        let (loads, terms) = all.into_iter().partition(|entry| entry.action.is_load());
        self.terms = terms;
        loads
    }

    /// Adds them again.
    pub(crate) fn give_loads(&mut self, loads: Vec<Entry<dyn Term>>) {
        self.terms.extend(loads);
        self.terms.sort_by_key(|entry| entry.effect);
    }

    /// Returns whether all terms are inner forces, so that a piece of cloth that touches nothing keeps its momentum.
    pub(crate) fn is_inner(&self) -> bool {
        self.terms.iter().all(|entry| entry.action.is_inner())
    }
}

/// Returns κ of a row, in N/m; zero if neither side moves.
///
/// It is stiffer than the vertices by a factor, and stiff enough that the load of the last step presses it by a small share of
/// its thickness alone. What is [caught](carried_loads) is at least as stiff as the body that it carries.
fn row_stiffness(row: &ContactRow, matrix: &Matrix, bodies: &RigidBodies, loads: &CarriedLoads) -> f64 {
    let compliance = matrix.compliance(&row.vertices, &row.weights, row.normal) + bodies.compliance(row.touches, row.normal);
    if !(compliance > 0.0) {
        return 0.0;
    }
    let stiffer = if row.is_with_body {
        STIFFER_THAN_BODIES
    } else {
        STIFFER_THAN_CLOTH
    };
    let least = (row.push / (GIVE * row.thickness)).max(loads.least_stiffness(row, bodies));
    (stiffer / compliance).max(least)
}
