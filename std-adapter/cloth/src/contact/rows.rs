//! Rows of the contact solver: C = n·Σwᵢxᵢ − r ≥ 0, with the direction n and the weights w of the closest points at the start of the step.
//!
//! A row pushes its two sides apart to its rest distance r. It may take back later what it has pushed, but no more (projected
//! Gauss-Seidel with accumulated pushes). So several sweeps over all rows converge to the state where each row pushes as much as
//! it has to.
//!
//! Each sweep passes a push on by one layer. So a row that pushed in the last step begins with that push, in proportion to h², as
//! if the force stayed the same. Three kinds of rows begin without a push:
//!
//! * Squeezed contacts push back and forth, which would add energy.
//! * Where there is no room for the thickness, a row cannot push its sides apart. So its push would grow from step to step.
//! * Where stitches hold vertices together, they draw back the push that a row begins with, so that the row never takes it back.
//!   Its push would grow as well, and stretch the cloth about the seam.
//!
//! r is the thickness, but no more than the distance at the start: a push must not become a velocity. The
//! [shift](crate::model::touches), which r follows, makes up for the difference.

use super::crossing::PairKey;
use crate::model::mobility::mobility;
use crate::model::step::{TimeStep, Touches};
use crate::model::touches::{Touch, along};
use selvedge_core::glam::DVec3;

/// A pair that is near at the start of a step, and that pushes before it have not certainly kept at its thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProximityPair {
    /// Vertex and face, or first edge and second edge; the cloth's vertices, then those of bodies.
    pub vertices: [u32; 4],
    /// The weight of each vertex in the way between the closest points. Weights are positive on the first side, where they add up
    /// to one, and negative on the other.
    pub weights: [f64; 4],
    /// The direction from the second side to the first, of length one.
    pub normal: DVec3,
    /// The distance at which contact aims, in metres.
    pub thickness: f64,
}

/// A contact that may push.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    key: PairKey,
    pub(super) near: ProximityPair,
    /// The rest distance r, in metres.
    rest: f64,
    mobility: f64,
    /// The sum of its pushes in this step, in metres.
    push: f64,
    /// The place of its touch; `NONE` until it has pushed.
    touch: u32,
    /// Its place among the recoveries; `NONE` if it is not too near.
    recovery: u32,
}

/// The pushes of rows in the last accepted step, each over its mobility, by their pairs in order.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    pushes: Vec<(PairKey, f64)>,
    /// The length of that step, in seconds.
    h: f64,
}

impl Memory {
    pub(super) fn clear(&mut self) {
        self.pushes.clear();
    }

    /// Replaces the pushes by those of the rows of a step of `h` seconds, except of rows that begin without a push.
    pub(super) fn remember<'a>(
        &mut self,
        rows: impl Iterator<Item = &'a Row>,
        held_together: &[bool],
        touches: &Touches,
        h: f64,
    ) {
        self.pushes.clear();
        let begins_with_push = |row: &&Row| {
            let ProximityPair { vertices, thickness, .. } = row.near;
            let has_room = row.rest >= LEAST_ROOM * thickness && !touches.is_squeezed(row.recovery);
            let has_pushed = row.push > LEAST_PUSH * thickness;
            has_pushed && has_room && vertices.iter().all(|&vertex| !held_together[vertex as usize])
        };
        let pushed = rows.filter(begins_with_push);
        self.pushes.extend(pushed.map(|row| (row.key, row.push / row.mobility)));
        self.pushes.sort_unstable_by_key(|push| push.0);
        self.h = h;
    }

    /// The pairs, and the push with which each begins a step of `h` seconds, over its mobility.
    pub(super) fn begin(&self, h: f64) -> impl Iterator<Item = (PairKey, f64)> {
        let scale = (h / self.h).powi(2);
        self.pushes.iter().map(move |&(key, push)| (key, push * scale))
    }
}

const NONE: u32 = u32::MAX;
/// Pushes of less than this share of the thickness are not stored: they are rounding.
const LEAST_PUSH: f64 = 1e-9;
/// The rest distance, as a share of the thickness, below which there is no room. It is fitted: stacks that their fall compresses keep
/// more, cloth that is wedged in has less.
const LEAST_ROOM: f64 = 0.2;

impl Row {
    /// Makes the row of a pair that is this far apart at the start of the step.
    pub(super) fn new(key: PairKey, near: ProximityPair, distance: f64, step: &TimeStep<'_>) -> Self {
        Self {
            key,
            recovery: NONE,
            near,
            rest: near.thickness.min(distance),
            mobility: mobility(step.inverse_masses, near.vertices, near.weights),
            push: 0.0,
            touch: NONE,
        }
    }

    /// Records by how much the pair misses its thickness at the start of the step, while there is no shift. Also records this
    /// distance for moved bodies and unmoved cloth.
    #[inline]
    pub(super) fn record_missing(&mut self, step: &TimeStep<'_>, positions: &[DVec3], touches: &mut Touches) {
        let ProximityPair {
            vertices,
            weights,
            normal,
            thickness,
        } = self.near;
        let missing = [self.rest, self.rest.min(self.left(step, positions))].map(|distance| thickness - distance);
        let touch = Touch::new(vertices, weights, normal, self.mobility, 0.0);
        let recovery = touches.record_missing(touch, missing, thickness, step.inverse_masses);
        self.recovery = recovery.unwrap_or(self.recovery);
    }

    /// The distance of its sides along the normal with bodies at the end of the step and the cloth at the start.
    fn left(&self, step: &TimeStep<'_>, positions: &[DVec3]) -> f64 {
        let ProximityPair {
            vertices,
            weights,
            normal,
            ..
        } = self.near;
        let at = |vertex: usize| {
            let is_free = step.inverse_masses[vertex] > 0.0;
            if is_free { step.start[vertex] } else { positions[vertex] }
        };
        let parts = vertices.into_iter().zip(weights);
        parts.fold(0.0, |sum, (vertex, weight)| sum + weight * normal.dot(at(vertex as usize)))
    }

    /// Pushes its sides apart, or takes pushes back, until they are at its rest distance. Returns by how much it moves them.
    #[inline]
    pub(super) fn settle(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3]) -> f64 {
        let ProximityPair {
            vertices,
            weights,
            normal,
            ..
        } = self.near;
        let missing = self.rest - along(positions, vertices, weights, normal);
        let least = -self.push;
        self.push_by(if missing > least { missing } else { least }, step, positions)
    }

    /// Begins with a push, given over its mobility.
    pub(super) fn begin_with(&mut self, push: f64, step: &TimeStep<'_>, positions: &mut [DVec3]) {
        self.push_by(push * self.mobility, step, positions);
    }

    pub(super) fn has_pushed(&self) -> bool {
        self.push > 0.0
    }

    /// Returns by how much it moves its sides.
    #[inline(always)]
    fn push_by(&mut self, push: f64, step: &TimeStep<'_>, positions: &mut [DVec3]) -> f64 {
        let ProximityPair {
            vertices,
            weights,
            normal,
            ..
        } = self.near;
        // A push that is not a number is skipped.
        if !(push != 0.0 && push.is_finite() && self.mobility > 0.0) {
            return 0.0;
        }
        let way = normal * (push / self.mobility);
        for (vertex, weight) in vertices.into_iter().zip(weights) {
            positions[vertex as usize] += way * (step.inverse_masses[vertex as usize] * weight);
        }
        self.push += push;
        push.abs()
    }

    /// Changes the rest distance by the shift, which may bring neighbours of this contact nearer to it.
    ///
    /// Where contacts are squeezed there is no room for their distances. They push just enough to keep the cloth where it was,
    /// beside bodies where they are now. Otherwise pads that close would throw out the cloth between them.
    pub(super) fn follow_shift(&mut self, step: &TimeStep<'_>, positions: &[DVec3], touches: &Touches) {
        if touches.is_squeezed(self.recovery) {
            let left = self.left(step, positions);
            self.rest = self.rest.min(left);
        }
        let shifted = touches.shift_along(self.near.vertices, self.near.weights, self.near.normal);
        self.rest = self.near.thickness.min(self.rest + shifted);
    }

    /// Records its pushes so far.
    pub(super) fn record(&mut self, touches: &mut Touches) {
        if !touches.wanted {
            return;
        }
        match touches.list.get_mut(self.touch as usize) {
            Some(touch) => touch.push = self.push,
            None if self.push > 0.0 => {
                let ProximityPair {
                    vertices,
                    weights,
                    normal,
                    ..
                } = self.near;
                self.touch = touches.list.len() as u32;
                touches
                    .list
                    .push(Touch::new(vertices, weights, normal, self.mobility, self.push));
            }
            None => (),
        }
    }
}
