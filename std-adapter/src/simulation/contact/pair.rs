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
use crate::PairKind;
use crate::simulation::plan::{FREE, Frame};
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

    fn set(&mut self, direction: DVec3, gap: f64) {
        self.direction = direction.to_array().map(|component| component as f32);
        self.gap = (gap / SLACK) as f32;
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
    pub(super) fn impact(
        &mut self,
        [start, end]: [&[DVec3]; 2],
        separation: f64,
        error: f64,
    ) -> Option<f64> {
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
    pub(super) fn time_of_impact(
        &self,
        [start, end]: [&[DVec3]; 2],
        separation: f64,
    ) -> Option<f64> {
        let limits = Limits {
            tolerance: (1e-6 * separation).min(TOLERANCE),
            separation,
        };
        let [a, b, c, d] = self
            .vertices
            .map(|v| Motion::new(start[v as usize], end[v as usize]));
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
