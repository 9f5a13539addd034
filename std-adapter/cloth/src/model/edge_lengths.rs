//! The lengths of a mesh's edges, over those at rest.

use super::energy::{Configuration, StoredEnergy};
use super::step::{Constraint, TimeStep, Touches};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// The edges of triangles, each with the inverse square of its largest length.
#[derive(Debug)]
pub(crate) struct Lengths(Vec<([u32; 2], f64)>);

impl Lengths {
    /// Finds the edges of a mesh at rest, which may become `limit` times as long.
    pub(crate) fn new(mesh: &Mesh, limit: f64) -> Self {
        let Mesh { positions, triangles } = mesh;
        let ends = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut edges: Vec<[u32; 2]> = ends.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        let longest = |edge: [u32; 2]| {
            let [a, b] = edge.map(|vertex| positions[vertex as usize]);
            (edge, (a.distance_squared(b) * limit * limit).recip())
        };
        Self(edges.into_iter().map(longest).collect())
    }

    /// Returns the largest ratio of a length to its limit.
    pub(crate) fn largest(&self, positions: &[DVec3]) -> f64 {
        let over =
            |&([a, b], per_square): &([u32; 2], f64)| positions[a as usize].distance_squared(positions[b as usize]) * per_square;
        // A comparison is one instruction, and `f64::max` several.
        let largest = self
            .0
            .iter()
            .map(over)
            .fold(0.0, |largest, over| if over > largest { over } else { largest });
        largest.sqrt()
    }
}

/// The growth of the longest edge after which a [lasting](Lasting) constraint acts again.
const UNDONE: f64 = 1.05;

/// A constraint that resists stretch, and acts again if contacts have undone what it did.
///
/// Where cloth is taut over a body, the constraint pulls it into the body. Contacts push it out, but stretch it. So what pulls at
/// the cloth does not feel the tension, and the cloth is drawn longer and longer.
#[derive(Debug)]
pub(crate) struct Lasting<C> {
    constraint: C,
    lengths: Lengths,
    /// The largest ratio of a length to that at rest, or 1, after it acted last.
    left: f64,
}

impl<C> Lasting<C> {
    /// Makes a constraint on this mesh, which is at rest.
    pub(crate) fn new(constraint: C, mesh: &Mesh) -> Self {
        Self {
            constraint,
            lengths: Lengths::new(mesh, 1.0),
            left: 1.0,
        }
    }
}

impl<C: Constraint> Constraint for Lasting<C> {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        self.constraint.project(step, positions, touches);
        self.left = self.lengths.largest(positions).max(1.0);
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        self.constraint.energy(now)
    }

    fn is_inner(&self) -> bool {
        self.constraint.is_inner()
    }

    fn is_undone(&self, positions: &[DVec3]) -> Option<bool> {
        Some(self.lengths.largest(positions) > UNDONE * self.left)
    }
}
