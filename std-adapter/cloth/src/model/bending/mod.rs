//! Resistance to bending, in one step that neither mesh nor stiffness makes unstable or soft.
//!
//! ```text
//! cloth at rest ──▶ hinges ──▶ forces −Q·x ──▶ stages ──▶ positions
//!                       └────▶ what is too stiff for the stages, one by one
//! ```
//!
//! **Energy.** A [`Hinge`] is an edge between two triangles with its four vertices; C = ΣKᵢxᵢ, K made of the cotangents of its angles at
//! rest, has the length of the edge times the angle between the triangles (Bergou et al. 2006). It costs ½(αD/A)·|C|², D being the
//! flexural rigidity, in N·m, and A the area of both triangles. The energy is quadratic: forces are −Q·x with a Q that never changes,
//! there is no trigonometry and no singular fold.
//!
//! Bergou et al. have α = 3. That is right for a ball, but cloth hardly ever bends in two directions at once, and bent in one, around rows
//! of equilateral triangles, it is three times too stiff: only the hinges across the rows are bent, |C| = κ·A for a curvature κ, and
//! there is one for each A of cloth, which is to cost ½D·κ² an area. With α = 1 equilateral triangles are right in any direction. A grid of
//! right-angled ones with alternating diagonals, whose vertices move by themselves to where least energy is, would have 5/6 of
//! the rigidity around its rows and 4/3 around its diagonals; with 4/3 for the legs and 2/3 for the diagonals it is 1 in every direction
//! (by homogenisation: the least energy of a periodic cell at a given mean curvature). α = (2 + cot γ + cot δ)/3, γ and δ being the
//! angles opposite the edge, is both, and 1.05 for equilateral triangles. A strip that bends under its weight then finds 0.9 to 1.1 times
//! the rigidity on grids and on irregular triangles, in any direction; where all diagonals of a grid are parallel, 0.6 to 2.9.
//!
//! **In time.** Implicit Euler wants x with (M + h²Q)(x − y) = −h²Q·y, y being where everything else leads. One sweep of Gauss and Seidel,
//! hinge by hinge, does nearly nothing about long waves on a fine mesh: a strip that should bend under its weight as a fabric does
//! hung down like a string (0.13 of its rigidity at edges of 2.4 mm, 0.04 at 1.2 mm, in spite of α = 3). But long waves are slow, and for them the
//! force −Q·y itself is as good. So the force is evaluated s times, in the stages of a Runge–Kutta–Chebyshev method of first order
//! (van der Houwen and Sommeijer 1980), x = R(h²M⁻¹Q)·y with R(λ) = 1 − λ + O(λ²) for what is slow and |R| ≤ 1/[`DAMPING`](stages::DAMPING)
//! for what is fast. That needs s in proportion to the root of the largest eigenvalue; one stage is enough for edges of a centimetre.
//!
//! As a polynomial of a symmetric operator whose rows sum to zero, it changes neither momentum nor angular momentum of a free cloth, but
//! for rounding: Σ yᵢ × (S·y)ᵢ = 0 for any symmetric S. Nothing depends on an order.
//!
//! **Stable.** A step multiplies a wave by z with z² − 2R·z + R = 0 (the velocity is x − the last x): |z|² = R if R ≥ 0, and
//! |z| ≤ 1 if R ≥ −1/3. How large eigenvalues are is known from above ([`Forces::fastest`]).
//!
//! **Too stiff.** Where a row needs more stages than are allowed, the stiffness of its hinges is parted: what the stages can do is done by
//! them, the rest by one sweep, hinge by hinge, as if there were no stages. So a plate is at least as stiff as the stages make it. The same is done
//! where a few slivers alone need more stages than all others, which would have to go along ([`MOST_BEYOND`]). With folds that stay ([`folds`])
//! there is no such rest: what is too stiff gets softer.

mod folds;
mod forces;
mod hinge;
mod stages;

pub(crate) use folds::Yield;
pub(crate) use hinge::{Hinge, hinges};

use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::schedule::{On, Schedule};
use crate::model::step::{Constraint, Memory, TimeStep, Touches};
use folds::Folds;
use forces::Forces;
use selvedge_core::glam::DVec3;
use stages::Stages;

/// So many of the hinges, at most, are in part done one by one so that the others need fewer stages.
const MOST_BEYOND: f64 = 0.02;
/// So few stages are not made fewer: they take little time, and with one, two and three of them R of the module is 1 − λ + c·λ² with a c of 0, 0.21
/// and 0.26 instead of the 0.27 to 0.30 of more, so that waves that are not slow move otherwise.
const ENOUGH_STAGES: u32 = 4;

/// The bending of a cloth, as a constraint.
#[derive(Debug)]
pub(crate) struct Bending {
    forces: Forces,
    /// The largest eigenvalue of M⁻¹Q, or more, in 1/s².
    fastest: f64,
    /// What is too stiff for the stages.
    beyond: Option<Schedule<Hinge, 4>>,
    folds: Option<Folds>,
    /// The last two stages, and the next.
    work: [Vec<DVec3>; 3],
}

impl Bending {
    /// Of hinges on vertices with these inverse masses, in 1/kg, in at most so many stages for a step of so many seconds. Of folds is told
    /// when they stay, and of which vertices the last ones are copies.
    pub(crate) fn new(
        hinges: &[On<Hinge, 4>],
        inverse_masses: &[f64],
        most_stages: u32,
        time_step: f64,
        folds: Option<(Yield, &[u32])>,
    ) -> Self {
        let vertex_count = inverse_masses.len();
        let reach = |stages| Stages::of(stages).reach() / (time_step * time_step);
        // A little less, or rounding might ask for one stage more.
        let [enough, allowed] = [reach(ENOUGH_STAGES) * (1.0 - 1e-9), reach(most_stages)];
        let parted = |few| Parted::new(hinges, inverse_masses, [enough, allowed], few);
        let stages_of = |parted: &Parted| Stages::to_reach(time_step * time_step * parted.fastest).count();
        let mut least = parted(0.0);
        // Folds have no rest to leave anything to.
        if folds.is_none() && stages_of(&least) > ENOUGH_STAGES {
            let without_few = parted(MOST_BEYOND);
            if stages_of(&without_few) < stages_of(&least) {
                least = without_few;
            }
        }
        let Parted {
            within,
            beyond,
            forces,
            fastest,
        } = least;
        Self {
            fastest,
            forces,
            folds: folds.map(|(when, copied)| Folds::new(&within, vertex_count, copied, when)),
            beyond: (!beyond.is_empty() && folds.is_none()).then(|| Schedule::once(beyond, vertex_count)),
            work: Default::default(),
        }
    }
}

/// Hinges with as much of their stiffness as the stages do, and with what is left of it.
struct Parted {
    within: Vec<On<Hinge, 4>>,
    beyond: Vec<On<Hinge, 4>>,
    /// Of those within, and their [`Bending::fastest`].
    forces: Forces,
    fastest: f64,
}

impl Parted {
    /// Within, there is no eigenvalue of M⁻¹Q above `allowed`, in 1/s², nor above what is `enough` and what all hinges but a share of so `few`
    /// keep to.
    fn new(hinges: &[On<Hinge, 4>], inverse_masses: &[f64], [enough, allowed]: [f64; 2], few: f64) -> Self {
        let [within, beyond] = parted(hinges, inverse_masses, [enough, allowed], few);
        let forces = Forces::new(&within, inverse_masses.len());
        Self {
            fastest: forces.fastest(inverse_masses, enough),
            within,
            beyond,
            forces,
        }
    }
}

/// The hinges within and beyond of [`Parted::new`].
fn parted(hinges: &[On<Hinge, 4>], inverse_masses: &[f64], [enough, allowed]: [f64; 2], few: f64) -> [Vec<On<Hinge, 4>>; 2] {
    let mut sums = vec![0.0; inverse_masses.len()];
    for (vertices, hinge) in hinges {
        let all: f64 = hinge.weights.iter().map(|k| k.abs()).sum();
        for (&vertex, weight) in vertices.iter().zip(hinge.weights) {
            sums[vertex as usize] += hinge.coefficient * weight.abs() * all * inverse_masses[vertex as usize];
        }
    }
    let largest = |vertices: &[u32; 4]| vertices.iter().map(|&v| sums[v as usize]).fold(0.0, f64::max);
    let mut stiffest: Vec<f64> = hinges.iter().map(|(vertices, _)| largest(vertices)).collect();
    let stiffer = (few * hinges.len() as f64) as usize;
    let allowed = match stiffest.len().checked_sub(1 + stiffer) {
        Some(place) => allowed.min(stiffest.select_nth_unstable_by(place, f64::total_cmp).1.max(enough)),
        None => allowed,
    };
    let mut beyond = Vec::new();
    let within = hinges.iter().map(|&(vertices, mut hinge)| {
        let largest = largest(&vertices);
        if largest > allowed {
            let within = hinge.coefficient * (allowed / largest);
            let coefficient = hinge.coefficient - within;
            beyond.push((vertices, Hinge { coefficient, ..hinge }));
            hinge.coefficient = within;
        }
        (vertices, hinge)
    });
    [within.collect(), beyond]
}

/// All stages of a step; `whole` makes the whole force on a vertex of that which bending alone has.
fn run(
    forces: &Forces,
    [before, last, next]: &mut [Vec<DVec3>; 3],
    stages: Stages,
    (step, positions): (&TimeStep<'_>, &mut [DVec3]),
    whole: impl Fn(usize, DVec3) -> DVec3 + Sync,
) {
    let own = forces.len();
    last.clear();
    last.extend_from_slice(&positions[..own]);
    before.clone_from(last);
    for stage in stages.each() {
        let scale = stage.force * step.h * step.h;
        next.resize(own, DVec3::ZERO);
        forces.for_each(last, next, |vertex, force, next| {
            let (before, last) = (before[vertex], last[vertex]);
            let force = whole(vertex, force);
            *next = last + (before - last) * stage.before + force * (scale * step.inverse_masses[vertex]);
        });
        std::mem::swap(before, last);
        std::mem::swap(last, next);
    }
    positions[..own].copy_from_slice(last);
}

impl Constraint for Bending {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        let stages = Stages::to_reach(step.h * step.h * self.fastest);
        let (forces, work) = (&self.forces, &mut self.work);
        match &mut self.folds {
            None => run(forces, work, stages, (step, positions), |_, force| force),
            Some(folds) => {
                let loads = folds.loads(step.start);
                run(forces, work, stages, (step, positions), |vertex, force| force + loads[vertex]);
            }
        }
        if let Some(beyond) = &mut self.beyond {
            beyond.project(step, positions, touches);
        }
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let beyond = self.beyond.as_ref().and_then(|beyond| beyond.energy(now));
        let beyond = beyond.map_or(0.0, StoredEnergy::joules);
        let folds = self.folds.as_ref().map_or(0.0, |folds| folds.energy(now.positions));
        Some(StoredEnergy::Elastic(
            (self.forces.energy(now.positions) + folds).max(0.0) + beyond,
        ))
    }

    fn memory(&self) -> Option<&dyn Memory> {
        self.folds.as_ref().map(|folds| folds as &dyn Memory)
    }

    fn memory_mut(&mut self) -> Option<&mut dyn Memory> {
        self.folds.as_mut().map(|folds| folds as &mut dyn Memory)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::schedule::Local;
    use crate::world::{Cloth, sheet};

    /// Whether the stages do all of it or the sweep of hinges a part.
    #[test]
    fn energy_is_that_of_all_hinges_and_flat_cloth_has_none() {
        let cloth = Cloth::of(sheet(DVec3::ONE, [DVec3::X, DVec3::new(0.3, 1.0, 0.0)], [9, 8]));
        let rest = &cloth.mesh.positions;
        let wavy: Vec<_> = rest
            .iter()
            .map(|p| *p + DVec3::Z * 0.1 * (5.0 * p.x + 3.0 * p.y).sin())
            .collect();
        let inverse_masses: Vec<f64> = cloth.masses().into_iter().map(f64::recip).collect();
        let all = hinges(&cloth, |_| 2e-3);
        let of_hinge = |(own, hinge): &On<Hinge, 4>| hinge.energy(own.map(|v| wavy[v as usize])).unwrap();
        let expected: f64 = all.iter().map(of_hinge).sum();
        for (stages, is_parted) in [(100, false), (1, true)] {
            let bending = Bending::new(&all, &inverse_masses, stages, 0.1, None);
            assert_eq!(bending.beyond.is_some(), is_parted);
            let of = |positions: &[DVec3]| {
                let now = Configuration {
                    positions,
                    inverse_masses: &inverse_masses,
                };
                bending.energy(&now).unwrap().joules()
            };
            assert!((of(&wavy) / expected - 1.0).abs() < 1e-10, "{} {expected}", of(&wavy));
            assert!((0.0..1e-16).contains(&of(rest)), "{}", of(rest));
        }
    }

    /// A vertex is moved most of the way towards another one: some thirty of 4,720 hinges then have slivers at their ends.
    #[test]
    fn a_few_slivers_need_no_more_stages_than_the_rest() {
        let even = sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [40, 40]);
        let mut with_slivers = even.clone();
        let [vertex, other] = [20 * 41 + 20, 20 * 41 + 21].map(|k| even.positions[k]);
        with_slivers.positions[20 * 41 + 20] = vertex.lerp(other, 0.95);
        let h = 4e-3;
        let stages = |mesh, few| {
            let cloth = Cloth::of(mesh);
            let inverse_masses: Vec<f64> = cloth.masses().into_iter().map(f64::recip).collect();
            let parted = Parted::new(&hinges(&cloth, |_| 1e-3), &inverse_masses, [0.0, f64::INFINITY], few);
            Stages::to_reach(h * h * parted.fastest).count()
        };
        assert!(stages(with_slivers.clone(), 0.0) > 2 * stages(even.clone(), 0.0));
        assert!(stages(with_slivers, MOST_BEYOND) <= stages(even, 0.0));
    }
}
