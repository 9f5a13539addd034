//! Bending resistance, in one step that is stable and accurate for any mesh and stiffness.
//!
//! ```text
//! cloth at rest ──▶ hinges ──▶ forces −Q·x ──▶ stages ──▶ positions
//!                       └────▶ the part that is too stiff for the stages, hinge by hinge
//! ```
//!
//! **Energy.** A [`Hinge`] is an edge between two triangles with its four vertices. The weights K in C = ΣKᵢxᵢ are made of the
//! cotangents of its angles at rest. The length of C is the length of the edge times the angle between the triangles (Bergou et
//! al. 2006). The energy is ½(αD/A)·|C|², with the flexural rigidity D in N·m and A the area of both triangles. It is quadratic:
//! forces are −Q·x with a constant Q, without trigonometry and without singular folds.
//!
//! Bergou et al. use α = 3. That is right for a ball, but cloth hardly ever bends in two directions at once. Bent in one
//! direction around rows of equilateral triangles, it is three times too stiff. Only the hinges across the rows bend, with |C| =
//! κ·A for a curvature κ. There is one of them for each area A of cloth, whose energy should be ½D·κ² per area. With α = 1
//! equilateral triangles are right in any direction. Take a grid of right-angled triangles with alternating diagonals, whose
//! vertices relax to the least energy. It would have 5/6 of the rigidity around its rows and 4/3 around its diagonals. With 4/3
//! for the legs and 2/3 for the diagonals it is 1 in every direction. This follows by homogenisation: the least energy of a
//! periodic cell at a given mean curvature. α = (2 + cot γ + cot δ)/3, with γ and δ the angles opposite the edge, gives both, and
//! 1.05 for equilateral triangles. A strip that bends under its weight then shows 0.9 to 1.1 times the rigidity, on grids and on
//! irregular triangles. If all diagonals of a grid are parallel, it shows 0.6 to 2.9.
//!
//! **Integration.** Implicit Euler solves (M + h²Q)(x − y) = −h²Q·y for x, with y the prediction of everything else. One
//! Gauss–Seidel sweep, hinge by hinge, hardly moves long waves on a fine mesh. A strip hangs like a string: 0.13 of its rigidity
//! at edges of 2.4 mm, 0.04 at 1.2 mm, even with α = 3. But long waves are slow, and for them the force −Q·y itself is accurate
//! enough. So the force is evaluated s times, in the stages of a first-order Runge–Kutta–Chebyshev method (van der Houwen and
//! Sommeijer 1980): x = R(h²M⁻¹Q)·y with R(λ) = 1 − λ + O(λ²) for slow modes and |R| ≤ 1/[`DAMPING`](stages::DAMPING) for fast
//! ones. The number of stages grows with the root of the largest eigenvalue; one stage suffices for edges of a centimetre.
//!
//! The step is a polynomial of a symmetric operator whose rows sum to zero. So it conserves momentum and angular momentum of a
//! free cloth up to rounding: Σ yᵢ × (S·y)ᵢ = 0 for any symmetric S. The result does not depend on an order.
//!
//! **Stability.** A step multiplies a wave by z with z² − 2R·z + R = 0 (the velocity is x − the last x): |z|² = R if R ≥ 0, and
//! |z| ≤ 1 if R ≥ −1/3. [`Forces::fastest`] bounds the eigenvalues from above.
//!
//! **Too stiff.** If a row needs more stages than are allowed, the stiffness of its hinges is split. The stages do as much as
//! they can, and one sweep, hinge by hinge, does the rest as if there were no stages. So a plate is at least as stiff as the
//! stages make it. The same happens if a few slivers alone need more stages than all others ([`MOST_BEYOND`]). With permanent
//! folds ([`folds`]) the rest is left out, and the cloth becomes softer.

mod folds;
mod forces;
mod hinge;
mod stages;

pub(crate) use folds::{Folds, Yield};
pub(crate) use hinge::{Hinge, hinges};

use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::schedule::{On, Schedule};
use crate::model::step::{Constraint, Memory, TimeStep, Touches};
use forces::Forces;
use selvedge_core::glam::DVec3;
use stages::Stages;

/// The largest share of hinges whose stiffness is split so that the others need fewer stages.
const MOST_BEYOND: f64 = 0.02;
/// The number of stages that is not reduced further, since so few stages take little time. With one, two and three stages R of
/// the module's documentation is 1 − λ + c·λ² with a c of 0, 0.21 and 0.26. With more stages c is 0.27 to 0.30, so fewer stages
/// would change the motion of waves that are not slow.
const ENOUGH_STAGES: u32 = 4;

/// The bending of a cloth, as a constraint.
#[derive(Debug)]
pub(crate) struct Bending {
    forces: Forces,
    /// An upper bound of the largest eigenvalue of M⁻¹Q, in 1/s².
    fastest: f64,
    /// The part that is too stiff for the stages.
    beyond: Option<Schedule<Hinge, 4>>,
    folds: Option<Folds>,
    /// The positions of the last two stages, and of the next.
    work: [Vec<DVec3>; 3],
}

impl Bending {
    /// Makes the constraint from hinges on vertices with these inverse masses, in 1/kg, with at most `most_stages` stages for a
    /// step of `h` seconds. `folds` has the point at which folds become permanent, and the source vertices of the last vertices,
    /// which are copies.
    pub(crate) fn new(
        hinges: &[On<Hinge, 4>],
        inverse_masses: &[f64],
        most_stages: u32,
        time_step: f64,
        folds: Option<(Yield, &[u32])>,
    ) -> Self {
        let vertex_count = inverse_masses.len();
        let reach = |stages| Stages::of(stages).reach() / (time_step * time_step);
        // The factor leaves room for rounding, which might need one stage more.
        let [enough, allowed] = [reach(ENOUGH_STAGES) * (1.0 - 1e-9), reach(most_stages)];
        let parted = |few| Parted::new(hinges, inverse_masses, [enough, allowed], few);
        let stages_of = |parted: &Parted| Stages::to_reach(time_step * time_step * parted.fastest).count();
        let mut least = parted(0.0);
        // Folds have no rest that could take a part.
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
            folds: folds.map(|(when, copied)| Folds::new(&within, 0, vertex_count, copied, when)),
            beyond: (!beyond.is_empty() && folds.is_none()).then(|| Schedule::once(beyond, vertex_count)),
            work: Default::default(),
        }
    }
}

/// Hinges, split into the stiffness that the stages apply and the rest.
struct Parted {
    within: Vec<On<Hinge, 4>>,
    beyond: Vec<On<Hinge, 4>>,
    /// The forces of the first part, and their upper bound [`Bending::fastest`].
    forces: Forces,
    fastest: f64,
}

impl Parted {
    /// Splits hinges. The first part has no eigenvalue of M⁻¹Q above `allowed`, in 1/s². It also has none above the larger of
    /// `enough` and the value that all hinges except a share of `few` keep.
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

/// Returns the two parts of [`Parted::new`].
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

/// Runs all stages of a step; `whole` maps the force of bending on a vertex to the whole force.
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

    fn is_inner(&self) -> bool {
        true
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

    /// Bending conserves momentum, whether the stages do all of it or the sweep of hinges does a part.
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

    /// A vertex is moved most of the way towards another one. Some thirty of 4,720 hinges then have slivers at their ends.
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
