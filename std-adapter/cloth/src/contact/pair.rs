//! A candidate pair, and the direction that last kept its two sets apart.
//!
//! # What a direction proves
//! For a fixed direction d of length at most 1 + 2⁻²⁰ and any points p of the first set and q of the second, d·(p(t) − q(t)) is
//! linear in t. If it exceeds m·(1 + 2⁻²⁰) at the start and at the end of a step, p and q are more than m apart throughout.
//!
//! **Rounding** (any direction: ε = 2u an operation). A dot product passes each product through at most 3 roundings: its error is
//! at most 3ε·3B·D to first order, B the largest coordinate and D ≤ 1.01 the largest component of d. A gap is the difference of
//! two of them, itself rounded: 18εBD + 6εBD ≤ 49uB. [`rounding_error`] allows 64u·B, and [`Rounding::UNDERFLOW`] for threads that
//! flush subnormal numbers (16 operations lose at most one smallest normal number each).

use super::closest::Closest;
use super::sieve::are_neighbours;
use crate::plan::{FREE, Frame};
use selvedge::PairKind;
use selvedge_core::elementary::Limits;
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::glam::DVec3;
use selvedge_core::{EdgeEdge, Motion, Rounding, VertexFace};

/// What makes a direction's length and the rounding of stored gaps harmless.
const SLACK: f64 = 1.0 + 1.0 / (1 << 20) as f64;

/// A vertex and a face, or two edges, that may come close in this step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// Ascends along the list of candidates, and is the same in every step.
    pub(super) key: u64,
    pub(super) vertices: [u32; 4],
    /// Keeps the sets apart at the end of the last step, by [`gap`](Self::gap). Of length one but for rounding, or zero.
    direction: [f32; 3],
    /// A lower bound of the distance at the end of the last step that was looked at; −∞ if there is none.
    pub(super) gap: f32,
    /// The thickness that the pair can have, from its distance at rest; zero if nobody has asked yet.
    pub(super) thickness: f32,
    pub(super) kind: PairKind,
    /// The body that it is a pair with; [`FREE`] for cloth with itself.
    pub(super) body: Frame,
}

/// How far coordinates of at most `largest` make a gap wrong.
pub(super) fn rounding_error(largest: f64) -> f64 {
    64.0 * (0.5 * f64::EPSILON) * largest + f64::UNDERFLOW
}

impl Pair {
    pub(super) fn new(key: u64, kind: PairKind, vertices: [u32; 4], body: Frame) -> Self {
        Self {
            key,
            vertices,
            direction: [0.0; 3],
            gap: f32::NEG_INFINITY,
            thickness: 0.0,
            kind,
            body,
        }
    }

    /// Takes over what an earlier step found out about the same pair.
    pub(super) fn remember(&mut self, earlier: &Self) {
        self.direction = earlier.direction;
        self.gap = earlier.gap;
        self.thickness = earlier.thickness;
    }

    #[inline(always)]
    pub(super) fn points(&self, positions: &[DVec3]) -> [DVec3; 4] {
        self.vertices.map(|v| positions[v as usize])
    }

    pub(super) fn closest(&self, positions: &[DVec3]) -> Closest {
        Closest::of(self.kind, self.points(positions))
    }

    pub(super) fn are_neighbours(&self, rest: &[DVec3], distance: f64) -> bool {
        are_neighbours(self.kind, self.points(rest), distance)
    }

    /// By how much the first set is ahead of the second along a direction.
    #[inline(always)]
    fn gap_along(&self, direction: DVec3, positions: &[DVec3]) -> f64 {
        let [a, b, c, d] = self.points(positions).map(|point| direction.dot(point));
        match self.kind {
            PairKind::VertexFace => a - b.max(c).max(d),
            PairKind::EdgeEdge => a.min(b) - c.max(d),
        }
    }

    /// A lower bound of the distance; zero where rounding hides it.
    pub(super) fn distance_from_below(&self, positions: &[DVec3], error: f64) -> f64 {
        let direction = self.closest(positions).direction;
        let bound = self.gap_along(direction, positions) / SLACK - error;
        if bound > 0.0 { bound } else { 0.0 }
    }

    /// Remembers another direction, with its gap at the start of a step.
    pub(super) fn refresh(&mut self, direction: DVec3, start: &[DVec3], error: f64) {
        let direction = direction.as_vec3().as_dvec3();
        let gap = self.gap_along(direction, start) - error;
        if gap > f64::from(self.gap) {
            self.set(direction, gap);
        }
    }

    fn set(&mut self, direction: DVec3, gap: f64) {
        self.direction = direction.to_array().map(|component| component as f32);
        self.gap = (gap / SLACK) as f32;
    }

    /// Whether the remembered direction keeps the pair at a distance there. Plain floating point.
    #[inline(always)]
    pub(super) fn is_kept_at(&self, distance: f64, positions: &[DVec3]) -> bool {
        let direction = DVec3::from_array(self.direction.map(f64::from));
        self.gap_along(direction, positions) > distance
    }

    /// Whether the direction that the pair remembers keeps it apart at the end of the step too, given that `gap` is right at
    /// the start.
    #[inline(always)]
    pub(super) fn stays_apart(&mut self, end: &[DVec3], separation: f64, error: f64) -> bool {
        let threshold = separation * (SLACK * SLACK) + error;
        if !(f64::from(self.gap) > threshold) {
            return false;
        }
        let direction = DVec3::from_array(self.direction.map(f64::from));
        let gap = self.gap_along(direction, end) - error;
        if gap > threshold {
            self.gap = (gap / SLACK) as f32;
            return true;
        }
        false
    }

    /// When the pair comes within `separation` on the way from `start` to `end`; `None` if it certainly does not. Remembers the
    /// direction that proves it.
    pub(super) fn impact(&mut self, [start, end]: [&[DVec3]; 2], separation: f64, error: f64) -> Option<f64> {
        let threshold = separation * (SLACK * SLACK) + error;
        let remembered = DVec3::from_array(self.direction.map(f64::from));
        for attempt in 0..3 {
            let direction = match attempt {
                0 => remembered,
                1 => self.closest(end).direction,
                _ => self.closest(start).direction,
            };
            // What is remembered is rounded: prove with that.
            let direction = direction.as_vec3().as_dvec3();
            let gap = self.gap_along(direction, end);
            if gap > threshold && self.gap_along(direction, start) > threshold {
                self.set(direction, gap - error);
                return None;
            }
        }
        self.gap = f32::NEG_INFINITY;
        self.time_of_impact([start, end], separation)
    }

    /// The certified time of impact, in [0, 1].
    pub(super) fn time_of_impact(&self, [start, end]: [&[DVec3]; 2], separation: f64) -> Option<f64> {
        let limits = Limits {
            tolerance: (1e-6 * separation).min(TOLERANCE),
            separation,
        };
        let [a, b, c, d] = self.vertices.map(|v| Motion::new(start[v as usize], end[v as usize]));
        let impact = match self.kind {
            PairKind::VertexFace => {
                let pair = VertexFace {
                    vertex: a,
                    face: [b, c, d],
                };
                time_of_impact(&pair, &limits)
            }
            PairKind::EdgeEdge => {
                let pair = EdgeEdge {
                    first: [a, b],
                    second: [c, d],
                };
                time_of_impact(&pair, &limits)
            }
        };
        impact.time()
    }

    pub(super) fn is_with_body(&self) -> bool {
        self.body != FREE
    }
}

/// δ of the time of impact, in metres.
const TOLERANCE: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// On sampled times; the proof itself is checked with exact arithmetic where it is made.
        #[test]
        fn what_is_said_to_stay_apart_does(
            start in prop::array::uniform4(point()),
            moves in prop::array::uniform4(point()),
            separation in 0.0..0.3_f64,
            is_edge in any::<bool>(),
        ) {
            let end = [0, 1, 2, 3].map(|k| start[k] + moves[k] * 0.3);
            let kind = if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace };
            let mut pair = Pair::new(0, kind, [0, 1, 2, 3], FREE);
            let error = rounding_error(2.0);
            let until = pair.impact([&start, &end], separation, error);
            let gap = f64::from(pair.gap);
            for step in 0..=40 {
                let t = f64::from(step) / 40.0;
                let at = [0, 1, 2, 3].map(|k| start[k].lerp(end[k], t));
                let distance = Closest::of(kind, at).distance();
                if until.is_none_or(|until| t < until) {
                    prop_assert!(distance > separation * (1.0 - 1e-9), "{distance} at {t}");
                }
            }
            prop_assert!(Closest::of(kind, end).distance() >= gap);
            prop_assert!(pair.distance_from_below(&start, error) <= Closest::of(kind, start).distance());
            // And once more from where it is: the gap is right there, as `stays_apart` takes it to be.
            let on = [0, 1, 2, 3].map(|k| end[k] + moves[k] * 0.1);
            if pair.stays_apart(&on, separation, error) {
                for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let at = [0, 1, 2, 3].map(|k| end[k].lerp(on[k], t));
                    prop_assert!(Closest::of(kind, at).distance() > separation * (1.0 - 1e-9));
                }
            }
        }
    }
}
