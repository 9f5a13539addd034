//! A candidate pair, and the direction that last kept its two sets apart.
//!
//! What a direction proves, and how far rounding can move it, is [core's](selvedge_core::separation::gap).

use super::closest::Closest;
use crate::step::{Carrier, FREE};
use selvedge::PairKind;
use selvedge_core::elementary::Limits;
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::gap::{GapError, SeparatingDirection, distance_from_below};
use selvedge_core::{Motion, PrimitivePair};

/// A vertex and a face, or two edges, that may come close in this step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// Ascends along the list of candidates, and is the same in every step.
    pub(super) key: u64,
    pub(super) vertices: [u32; 4],
    /// What kept the sets apart at the end of the last step that was looked at.
    separating: SeparatingDirection,
    /// The thickness that the pair can have, from its distance at rest; zero if nobody has asked yet.
    pub(super) thickness: f32,
    pub(super) kind: PairKind,
    /// The body that it is a pair with; [`FREE`] for cloth with itself.
    pub(super) body: Carrier,
}

impl Candidate {
    pub(super) fn new(key: u64, kind: PairKind, vertices: [u32; 4], body: Carrier) -> Self {
        Self {
            key,
            vertices,
            separating: SeparatingDirection::NONE,
            thickness: 0.0,
            kind,
            body,
        }
    }

    /// Takes over what an earlier step found out about the same pair.
    pub(super) fn remember(&mut self, earlier: &Self) {
        self.separating = earlier.separating;
        self.thickness = earlier.thickness;
    }

    #[inline(always)]
    pub(super) fn points(&self, positions: &[DVec3]) -> [DVec3; 4] {
        self.vertices.map(|v| positions[v as usize])
    }

    pub(super) fn closest(&self, positions: &[DVec3]) -> Closest {
        Closest::of(self.kind, self.points(positions))
    }

    /// A lower bound of the distance at the end of the last step that was looked at; −∞ if there is none.
    #[inline(always)]
    pub(super) const fn gap(&self) -> f32 {
        self.separating.gap()
    }

    /// The pair has moved in a way that was not looked at.
    pub(super) const fn forget_gap(&mut self) {
        self.separating = self.separating.without_gap();
    }

    /// A lower bound of the distance; zero where rounding hides it.
    pub(super) fn distance_from_below(&self, positions: &[DVec3], error: GapError<f64>) -> f64 {
        let direction = self.closest(positions).direction;
        distance_from_below(self.kind, self.points(positions), direction, error)
    }

    /// Remembers another direction, with its gap at the start of a step, if it proves more there.
    pub(super) fn refresh(&mut self, direction: DVec3, start: &[DVec3], error: GapError<f64>) {
        self.separating = self.separating.or_better(self.kind, direction, self.points(start), error);
    }

    /// Whether the remembered direction keeps the pair at a distance there. Plain floating point.
    #[inline(always)]
    pub(super) fn is_kept_at(&self, distance: f64, positions: &[DVec3]) -> bool {
        self.separating.gap_at(self.kind, self.points(positions)) > distance
    }

    /// Whether the direction that the pair remembers keeps it apart at the end of the step too, given that its gap is right at
    /// the start.
    #[inline(always)]
    pub(super) fn stays_apart(&mut self, end: &[DVec3], separation: f64, error: GapError<f64>) -> bool {
        let later = self.separating.lasts(self.kind, self.points(end), separation, error);
        if let Some(later) = later {
            self.separating = later;
        }
        later.is_some()
    }

    /// When the pair comes within `separation` on the way from `start` to `end`; `None` if it certainly does not. Remembers the
    /// direction that proves it.
    pub(super) fn impact(&mut self, [start, end]: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> Option<f64> {
        let (kind, points) = (self.kind, [start, end].map(|positions| self.points(positions)));
        let found = |positions: &[DVec3]| {
            let direction = self.closest(positions).direction;
            SeparatingDirection::found(kind, direction, points, separation, error)
        };
        let kept = self.separating.keeps(kind, points, separation, error);
        if let Some(kept) = kept.or_else(|| found(end)).or_else(|| found(start)) {
            self.separating = kept;
            return None;
        }
        self.forget_gap();
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
                let pair = PrimitivePair::vertex_face(a, [b, c, d]);
                time_of_impact(&pair, &limits)
            }
            PairKind::EdgeEdge => {
                let pair = PrimitivePair::edge_edge([a, b], [c, d]);
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
            let mut pair = Candidate::new(0, kind, [0, 1, 2, 3], FREE);
            let error = GapError::of_coordinates(2.0);
            let until = pair.impact([&start, &end], separation, error);
            let gap = f64::from(pair.gap());
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
