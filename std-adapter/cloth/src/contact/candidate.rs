//! A candidate pair, with what contact keeps of it.

use crate::model::step::{Carrier, FREE};
use selvedge::PairKind;
use selvedge::coherent::NearPair;
use selvedge::simd::Level;
use selvedge_core::batch::{LANES, closest_points};
use selvedge_core::elementary::Limits;
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::GapError;
use selvedge_core::{Motion, PrimitivePair};

/// A vertex and a face, or two edges, that may come close in this step.
pub(super) type Candidate = NearPair<OfPair>;

/// What contact keeps of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfPair {
    pub(super) aim: Aim,
    /// The body that it is a pair with; [`FREE`] for cloth with itself.
    pub(super) body: Carrier,
}

/// How far apart a pair is to be, in metres: what is asked of all such pairs, until its own thickness is known, from its distance at rest.
///
/// Less than zero as long as it is what is asked: one number, and no branch, for those who ask for it in every step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim(f32);

impl Aim {
    pub(super) const fn asked(thickness: f64) -> Self {
        Self(-(thickness as f32))
    }

    pub(super) const fn own(thickness: f64) -> Self {
        Self(thickness as f32)
    }

    pub(super) fn is_own(self) -> bool {
        self.0 > 0.0
    }

    #[inline(always)]
    pub(super) fn length(self) -> f64 {
        f64::from(self.0.abs())
    }
}

impl OfPair {
    pub(super) fn is_with_body(&self) -> bool {
        self.body != FREE
    }
}

/// Where up to sixteen pairs of one kind are closest, found at once.
#[derive(Default)]
pub(super) struct ClosestOfSome {
    points: [[DVec3; 4]; LANES],
    closest: [ClosestPoints; LANES],
}

impl ClosestOfSome {
    /// Replaces them by those of these pairs.
    pub(super) fn find<'a>(
        &mut self,
        level: Level,
        pairs: impl Iterator<Item = &'a Candidate>,
        positions: &[DVec3],
    ) -> &[ClosestPoints] {
        let (mut kind, mut count) = (PairKind::VertexFace, 0);
        for (points, pair) in self.points.iter_mut().zip(pairs) {
            *points = pair.points(positions);
            kind = pair.kind;
            count += 1;
        }
        closest_points(level, kind, &self.points[..count], &mut self.closest);
        self.found()
    }

    /// In the order of the pairs.
    pub(super) const fn found(&self) -> &[ClosestPoints] {
        &self.closest
    }
}

/// When a pair comes within `separation` on the way from `start` to `end`; `None` if it certainly does not. It remembers the
/// direction that proves it.
pub(super) fn impact(pair: &mut Candidate, path: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> Option<f64> {
    if pair.keeps_apart(path, separation, error) {
        return None;
    }
    time_of_impact_of(pair, path, separation)
}

/// The certified time of impact, in [0, 1].
pub(super) fn time_of_impact_of(pair: &Candidate, [start, end]: [&[DVec3]; 2], separation: f64) -> Option<f64> {
    let limits = Limits {
        tolerance: (1e-6 * separation).min(TOLERANCE),
        separation,
    };
    let motions = pair.vertices.map(|v| Motion::new(start[v as usize], end[v as usize]));
    let kind = pair.kind;
    time_of_impact(&PrimitivePair { kind, motions }, &limits).time()
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
            let of_pair = OfPair {
                aim: Aim::asked(0.0),
                body: FREE,
            };
            let mut pair = Candidate::new(kind, [0, 0], [0, 1, 2, 3], of_pair);
            let error = GapError::from_largest_coordinate(2.0);
            let until = impact(&mut pair, [&start, &end], separation, error);
            let gap = f64::from(pair.gap());
            for step in 0..=40 {
                let t = f64::from(step) / 40.0;
                let at = [0, 1, 2, 3].map(|k| start[k].lerp(end[k], t));
                let distance = ClosestPoints::from_points(kind, at).distance();
                if until.is_none_or(|until| t < until) {
                    prop_assert!(distance > separation * (1.0 - 1e-9), "{distance} at {t}");
                }
            }
            prop_assert!(ClosestPoints::from_points(kind, end).distance() >= gap);
            prop_assert!(pair.distance_from_below(&start, error) <= ClosestPoints::from_points(kind, start).distance());
            // And from the start to where repairs may have moved it: the gap at the start was large enough.
            let moved = [0, 1, 2, 3].map(|k| end[k] + moves[(k + 1) % 4] * 0.1);
            let mut again = pair;
            if until.is_none() && again.stays_apart(&moved, separation, error) {
                for step in 0..=20 {
                    let at = [0, 1, 2, 3].map(|k| start[k].lerp(moved[k], f64::from(step) / 20.0));
                    prop_assert!(ClosestPoints::from_points(kind, at).distance() > separation * (1.0 - 1e-9));
                }
            }
            // And once more from where it is: the gap is right there, as `stays_apart` takes it to be.
            let on = [0, 1, 2, 3].map(|k| end[k] + moves[k] * 0.1);
            if pair.stays_apart(&on, separation, error) {
                for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let at = [0, 1, 2, 3].map(|k| end[k].lerp(on[k], t));
                    prop_assert!(ClosestPoints::from_points(kind, at).distance() > separation * (1.0 - 1e-9));
                }
            }
        }
    }
}
