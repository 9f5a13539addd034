//! Tension over distances longer than an edge. On each coarse [`Level`], from the coarsest to the finest, one sweep over its
//! triangles moves the seeds, and all vertices follow. Then comes the effect's own sweep on the mesh.
//!
//! ```text
//! positions ──▶ of seeds ──▶ sweep ──▶ moves of seeds ──▶ every vertex by its shares ──▶ the next finer level … ──▶ the mesh
//! ```
//!
//! A coarse triangle knows only the corners of its part of the cloth, so it follows three rules:
//!
//! * **It never pushes.** Corners that come nearer to each other may have a fold between them. Corners that are farther apart
//!   than the cloth between them is long do stretch it.
//! * **It acts in the principal direction**, with the combined compliance of warp, weft and shear. At an angle of φ to the warp a
//!   stretch e costs ½k(φ)·e² per area, with 1/k(φ) = cos⁴φ/k_u + sin⁴φ/k_v + cos²φ·sin²φ/G (a fabric without transverse
//!   contraction). Warp and weft separately would leave a diagonal pull to the mesh. Without shear stiffness nothing resists that
//!   pull, and warp and weft are used.
//! * **It needs a stretched side.** The three corners of a tube or a fold may approach each other while the triangle gets longer
//!   in one direction and flatter in others. So a triangle without a side longer than at rest does not act. Otherwise its stretch
//!   is at most [`TRUST`] times that of its longest side. Without this rule levels of few triangles prop the cloth up. With it
//!   the resolution of the coarsest level does not matter.
//!
//! L levels and the mesh share the stiffness: each level has (L + 1) times the compliance, since each alone would do all of the
//! work. The mesh keeps its own compliance, because the rest is local.
//!
//! The seeds' masses are such that conserving their momentum conserves that of the cloth ([`Level::inverse_masses`]).

use crate::input::{Count, SceneError, Table, ValueError};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::hierarchy::{CoarseTriangle, Level};
use crate::model::length::length;
use crate::model::membrane::{Membrane, SquaredStretch, all, image};
use crate::model::schedule::{Local, Schedule};
use crate::model::step::{Constraint, TimeStep, Touches};
use selvedge_core::glam::DVec3;
use std::sync::Arc;

/// The largest ratio of a triangle's stretch to that of its longest side. A stretch of e along one direction stretches a side at
/// an angle of φ to it by e·cos²φ. The nearest side of a right-angled triangle with equal legs is at most 45° off: e/2.
const TRUST: f64 = 2.0;

/// An effect on coarse levels, then on the mesh.
#[derive(Debug)]
pub(super) struct OnLevels<C> {
    /// The levels, from coarse to fine.
    levels: Vec<OnLevel>,
    mesh: C,
}

#[derive(Debug)]
struct OnLevel {
    level: Arc<Level>,
    triangles: Schedule<Tension, 3>,
    before: Vec<DVec3>,
    after: Vec<DVec3>,
    /// The inverse masses of the seeds, if something holds vertices.
    inverse_masses: Vec<f64>,
}

impl<C> OnLevels<C> {
    /// Makes the effect on `levels`, which go from fine to coarse.
    pub(super) fn new(levels: Vec<Arc<Level>>, mesh: C, tension: impl Fn(&CoarseTriangle) -> Tension) -> Self {
        let on_level = |level: Arc<Level>| {
            let triangles = level.triangles.iter();
            let triangles = triangles.map(|(seeds, triangle)| (*seeds, tension(triangle)));
            OnLevel {
                triangles: Schedule::once(triangles.collect(), level.inverse_masses.len()),
                before: Vec::new(),
                after: Vec::new(),
                inverse_masses: Vec::new(),
                level,
            }
        };
        Self {
            levels: levels.into_iter().rev().map(on_level).collect(),
            mesh,
        }
    }
}

impl<C: Constraint> Constraint for OnLevels<C> {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        for level in &mut self.levels {
            level.project(step, positions, touches);
        }
        self.mesh.project(step, positions, touches);
    }

    fn is_inner(&self) -> bool {
        self.mesh.is_inner()
    }

    /// Returns the mesh's own energy: levels only speed up convergence.
    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        self.mesh.energy(now)
    }
}

impl Constraint for OnLevel {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        self.level.read(positions, &mut self.before);
        self.after.clone_from(&self.before);
        let inverse_masses = if step.held.is_empty() {
            &self.level.inverse_masses
        } else {
            self.level.weigh(step.held, &mut self.inverse_masses);
            &self.inverse_masses
        };
        let of_seeds = TimeStep { inverse_masses, ..*step };
        self.triangles.project(&of_seeds, &mut self.after, touches);
        if self.after != self.before {
            for (after, before) in self.after.iter_mut().zip(&self.before) {
                *after -= *before;
            }
            self.level.spread(&self.after, positions);
        }
    }
}

/// Resists the stretch of a coarse triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tension {
    membrane: Membrane,
    /// The inverse squares of the sides at rest, in 1/m².
    per_square: [f64; 3],
    /// The stretch below which the triangle does not act.
    slack: f64,
    /// Compliances of warp, weft and shear, in 1/J. A shear of `None` has no resistance.
    compliance: [Option<f64>; 3],
}

impl Tension {
    /// Resists stretch, with stiffnesses of warp, weft and shear in N/m.
    pub(super) fn stretch(triangle: &CoarseTriangle, stiffness: [Option<f64>; 3]) -> Self {
        let area = triangle.area;
        Self {
            compliance: stiffness.map(|k| k.map(|k| 1.0 / (k * area))),
            ..Self::limit(triangle, 1.0)
        }
    }

    /// Allows no stretch beyond `limit`.
    pub(super) fn limit(triangle: &CoarseTriangle, limit: f64) -> Self {
        Self {
            membrane: triangle.membrane,
            per_square: triangle.sides.map(f64::recip),
            slack: limit,
            compliance: [Some(0.0); 3],
        }
    }

    /// Returns the square of the largest stretch of a side.
    #[inline(always)]
    fn squared_side(&self, x: [DVec3; 3]) -> f64 {
        let sides = [x[1] - x[0], x[2] - x[1], x[0] - x[2]];
        let squared = |k: usize| sides[k].length_squared() * self.per_square[k];
        squared(0).max(squared(1)).max(squared(2))
    }

    /// Reduces the stretch along a unit direction by `excess`.
    #[inline(always)]
    fn pull(&self, x: [DVec3; 3], w: [f64; 3], [du, dv]: [f64; 2], excess: f64, compliance: f64) -> [DVec3; 3] {
        let Membrane { a, b } = self.membrane;
        let two = [du * a[0] + dv * b[0], du * a[1] + dv * b[1]];
        let c = all(two);
        let stretched = image(two, x);
        let length = length(stretched);
        let weight = w[0] * c[0] * c[0] + w[1] * c[1] * c[1] + w[2] * c[2] * c[2];
        // The mesh handles values that overflow when squared.
        if !(excess > 0.0 && weight > 0.0 && length.is_finite()) {
            return [DVec3::ZERO; 3];
        }
        let along = stretched * (-excess / ((weight + compliance) * length));
        [0, 1, 2].map(|k| along * (w[k] * c[k]))
    }
}

impl Local<3> for Tension {
    type Multipliers = ();

    #[inline(always)]
    fn moves_nothing(&self, x: [DVec3; 3]) -> bool {
        self.squared_side(x) <= self.slack * self.slack
    }

    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], stiffening: f64, _: &mut ()) -> [DVec3; 3] {
        let trusted = TRUST * (self.squared_side(x).sqrt() - self.slack);
        if !(trusted > 0.0) {
            return [DVec3::ZERO; 3];
        }
        let [warp, weft, shear] = self.compliance.map(|compliance| compliance.map(|own| own * stiffening));
        let [warp, weft] = [warp, weft].map(Option::unwrap_or_default);
        match shear {
            Some(shear) => {
                let (largest, [du, dv]) = SquaredStretch::new(self.membrane, x).principal();
                let length = (du * du + dv * dv).sqrt();
                let direction = [du / length, dv / length];
                let [c, s] = direction.map(|part| part * part);
                let compliance = c * c * warp + s * s * weft + c * s * shear;
                self.pull(x, w, direction, (largest - self.slack).min(trusted), compliance)
            }
            None => {
                let excess = |c: [f64; 2], x: [DVec3; 3]| (image(c, x).length() - self.slack).min(trusted);
                let first = self.pull(x, w, [1.0, 0.0], excess(self.membrane.a, x), warp);
                let x = [0, 1, 2].map(|k| x[k] + first[k]);
                let second = self.pull(x, w, [0.0, 1.0], excess(self.membrane.b, x), weft);
                [0, 1, 2].map(|k| first[k] + second[k])
            }
        }
    }
}

const MOST: Count = Count::new("levels", 0, 32);

/// Reads `levels`: the largest number of levels, from the finest. Returns `None`, for all useful ones, if the key is missing; 0
/// runs the effect on the mesh alone.
pub(super) fn read_most(table: &Table<'_>) -> Result<Option<u32>, SceneError> {
    table.count(&MOST)
}

pub(super) fn check(most: Option<u32>) -> Result<(), ValueError> {
    most.map_or(Ok(()), |most| MOST.check(most))
}

pub(super) fn settings(most: Option<u32>) -> Option<(&'static str, String)> {
    most.map(|most| ("levels", most.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::hierarchy::{Hierarchy, irregular};
    use crate::world::{Cloth, capsule, tube};

    const FABRIC: [Option<f64>; 3] = [Some(400.0), Some(300.0), Some(80.0)];

    /// Returns the positions after the levels' sweeps, without a sweep on the mesh.
    fn moved(cloth: &Cloth, positions: &[DVec3], tension: impl Fn(&CoarseTriangle) -> Tension) -> Vec<DVec3> {
        let masses = cloth.masses();
        let mut hierarchy = Hierarchy::new(cloth, masses.clone(), vec![false; masses.len()]);
        let mesh = Schedule::<Tension, 3>::once(Vec::new(), masses.len());
        let mut levels = OnLevels::new(hierarchy.levels_to(f64::INFINITY), mesh, tension);
        let mut moved = positions.to_vec();
        let inverse_masses: Vec<f64> = masses.iter().map(|m| 1.0 / m).collect();
        let step = TimeStep::first(1e-3, positions, &inverse_masses);
        levels.project(&step, &mut moved, &mut Touches::default());
        moved
    }

    fn stretched(cloth: &Cloth, by: f64) -> Vec<DVec3> {
        let rest = cloth.mesh.positions.iter();
        rest.map(|p| DVec3::new(p.x * by, p.y, 0.05 * (9.0 * p.y).sin())).collect()
    }

    #[test]
    fn sweeps_on_levels_conserve_momentum() {
        let hole = irregular::with_hole(&irregular::sheet(32, 0), DVec3::new(0.2, 0.1, 0.0), 0.15);
        let cloth = Cloth::of(hole);
        let masses = cloth.masses();
        let start = stretched(&cloth, 1.2);
        for fabric in [FABRIC, [Some(400.0), Some(300.0), None]] {
            let end = moved(&cloth, &start, |triangle| Tension::stretch(triangle, fabric));
            let moves = || start.iter().zip(&end).map(|(from, to)| *to - *from);
            let momentum: DVec3 = moves().zip(&masses).map(|(by, m)| by * *m).sum();
            let all: f64 = moves().zip(&masses).map(|(by, m)| by.length() * m).sum();
            assert!(all > 1e-4 && momentum.length() < 1e-12 * all, "{momentum} of {all}");
        }
    }

    #[test]
    fn a_stretched_sheet_is_drawn_together_and_a_shortened_one_left_alone() {
        for mesh in [irregular::sheet(32, 0), irregular::sheet(32, 4)] {
            let cloth = Cloth::of(mesh);
            let width = |positions: &[DVec3]| positions.iter().map(|p| p.x).fold(0.0, f64::max) * 2.0;
            let start = stretched(&cloth, 1.2);
            let limited = moved(&cloth, &start, |triangle| Tension::limit(triangle, 1.1));
            assert!((1.0..1.18).contains(&width(&limited)), "{}", width(&limited));
            let rest = moved(&cloth, &stretched(&cloth, 1.09), |triangle| Tension::limit(triangle, 1.1));
            assert_eq!(rest, stretched(&cloth, 1.09));
            let short: Vec<_> = cloth.mesh.positions.iter().map(|p| *p * 0.8).collect();
            assert_eq!(moved(&cloth, &short, |triangle| Tension::stretch(triangle, FABRIC)), short);
        }
    }

    /// Flat triangles between points of a curved cloth have sides shorter than the cloth: at rest nothing pulls.
    #[test]
    fn curved_cloth_at_rest_is_left_alone() {
        let tube = tube([DVec3::ZERO, DVec3::Z], 0.2, [80, 64]);
        for mesh in [tube, capsule([DVec3::ZERO; 2], 0.3, 64)] {
            let cloth = Cloth::of(mesh);
            let rest = &cloth.mesh.positions;
            assert_eq!(&moved(&cloth, rest, |triangle| Tension::stretch(triangle, FABRIC)), rest);
        }
    }
}
