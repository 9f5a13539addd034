//! Relaxation: positions move until each pair of an active set is kept apart (Agmon 1954, Motzkin and Schoenberg 1954; in the
//! metric of the masses).
//!
//! A pair that is not free becomes active and stays so until the relaxation ends. So a push out of one pair does not go unnoticed
//! into another. At first the condition of a pair is a half-space, Σwᵢ·d·xᵢ ≥ m_P. The weights w and the direction d are those of
//! its closest points at the start of the step. The pair may not be free in a later test, where other points are the closest.
//! Then *all* points of its first set have to be ahead of all points of its second set by m_P along d, which suffices.
//!
//! Each projection aims at a little more than the condition, so that the rounds end if positions exist that satisfy all
//! conditions.

use super::candidate::Candidate;
use super::mobility::mobility;
use crate::model::step::TimeStep;
use selvedge::PairKind;
use selvedge_core::glam::DVec3;
use std::collections::BTreeMap;

/// The distance at which a projection aims, as a multiple of the distance to keep.
const AIM: f64 = 1.05;

/// The active set of a relaxation.
#[derive(Debug, Default)]
pub(super) struct Relaxation {
    /// The pairs, in the order in which tests found them not to be free.
    active: Vec<Active>,
    /// The place of each pair in `active`.
    places: BTreeMap<(PairKind, [u32; 2]), usize>,
}

/// A pair that is to be kept apart.
#[derive(Clone, Copy, Debug)]
struct Active {
    kind: PairKind,
    vertices: [u32; 4],
    weights: [f64; 4],
    direction: DVec3,
    /// The distance to keep along the direction.
    kept: f64,
    /// True if all points have to keep it, and not only the closest.
    of_all: bool,
}

impl Relaxation {
    /// Makes the set empty.
    pub(super) fn reset(&mut self) {
        self.active.clear();
        self.places.clear();
    }

    /// Adds a pair that has to keep a distance of `kept`; for an active pair, requires this of all of its points.
    pub(super) fn add(&mut self, pair: &Candidate, kept: f64, step: &TimeStep<'_>) {
        if let Some(&place) = self.places.get(&pair.key()) {
            self.active[place].of_all = true;
            return;
        }
        self.places.insert(pair.key(), self.active.len());
        let closest = pair.closest(step.start);
        self.active.push(Active {
            kind: pair.kind,
            vertices: pair.vertices,
            weights: closest.weights,
            direction: closest.direction,
            kept,
            of_all: false,
        });
    }

    /// Projects one pair after the other, in at most so many rounds, until all are kept apart: returns whether they are. Marks
    /// the vertices that move.
    pub(super) fn relax(&self, rounds: usize, step: &TimeStep<'_>, positions: &mut [DVec3], moved: &mut [bool]) -> bool {
        (0..rounds).any(|_| {
            let mut are_kept = true;
            for pair in &self.active {
                are_kept &= pair.project(step, positions, moved);
            }
            are_kept
        })
    }
}

impl Active {
    /// Returns whether the pair was kept apart before, or cannot be.
    fn project(&self, step: &TimeStep<'_>, positions: &mut [DVec3], moved: &mut [bool]) -> bool {
        let vertices = self.vertices.map(|vertex| vertex as usize);
        let along = vertices.map(|vertex| self.direction.dot(positions[vertex]));
        let weights = if self.of_all { self.of_nearest(along) } else { self.weights };
        let mobility = mobility(step.inverse_masses, self.vertices, weights);
        let gap = (0..4).fold(0.0, |gap, corner| gap + weights[corner] * along[corner]);
        let missing = AIM * self.kept - gap;
        if !(missing > 0.0 && mobility > 0.0) {
            return true;
        }
        let push = self.direction * (missing / mobility);
        for (vertex, weight) in vertices.into_iter().zip(weights) {
            let inverse_mass = step.inverse_masses[vertex];
            if inverse_mass > 0.0 && weight != 0.0 {
                positions[vertex] += push * (weight * inverse_mass);
                moved[vertex] = true;
            }
        }
        gap >= self.kept
    }

    /// The weights of the point of each set that is nearest to the other set, for points that are so far `along` the direction.
    fn of_nearest(&self, along: [f64; 4]) -> [f64; 4] {
        let of_first = match self.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        };
        let nearer = |a: usize, b: usize| if along[b] < along[a] { b } else { a };
        let farther = |a: usize, b: usize| if along[b] > along[a] { b } else { a };
        let mut weights = [0.0; 4];
        weights[(1..of_first).fold(0, nearer)] = 1.0;
        weights[(of_first + 1..4).fold(of_first, farther)] = -1.0;
        weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::candidate::{Aim, OfPair};
    use crate::model::step::FREE;
    use proptest::prelude::*;
    use selvedge_core::separation::closest::ClosestPoints;

    fn points() -> impl Strategy<Value = [DVec3; 4]> {
        prop::array::uniform4(prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from))
    }

    proptest! {
        /// Covers pairs of which one of the four vertices may not move.
        #[test]
        fn a_pair_is_kept_apart_on_its_side_once_all_of_its_points_are_asked_for(
            start in points(),
            moves in points(),
            fixed in 0..5_usize,
            is_edge in any::<bool>(),
        ) {
            let kind = if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace };
            let kept = 0.5 * ClosestPoints::from_points(kind, start).distance();
            prop_assume!(kept > 1e-3);
            let inverse_masses = [0, 1, 2, 3].map(|corner| if corner == fixed { 0.0 } else { 1.0 + corner as f64 });
            let step = TimeStep { time: 0.0, h: 1.0, start: &start, inverse_masses: &inverse_masses, poses: &[], motions: &[] };
            let pair = Candidate::new(kind, [0, 0], [0, 1, 2, 3], OfPair { aim: Aim::requested(0.0), body: FREE });
            let mut relaxation = Relaxation::default();
            relaxation.add(&pair, kept, &step);
            relaxation.add(&pair, kept, &step);
            prop_assert_eq!(relaxation.active.len(), 1);
            let wanted = [0, 1, 2, 3].map(|corner| start[corner] + if corner == fixed { DVec3::ZERO } else { moves[corner] });
            let (mut end, mut moved) = (wanted, [false; 4]);
            relaxation.relax(1000, &step, &mut end, &mut moved);
            for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let at = [0, 1, 2, 3].map(|corner| start[corner].lerp(end[corner], t));
                prop_assert!(ClosestPoints::from_points(kind, at).distance() > kept * (1.0 - 1e-9));
            }
            for corner in 0..4 {
                prop_assert!(moved[corner] || end[corner] == wanted[corner]);
                prop_assert!(corner != fixed || !moved[corner]);
            }
        }
    }
}
