//! A candidate pair, with the data that contact stores for it.

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

/// The data that contact stores for a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfPair {
    pub(super) aim: Aim,
    /// The body of a pair of cloth and a body; [`FREE`] for a pair of cloth and cloth.
    pub(super) body: Carrier,
}

/// The distance at which contact aims for a pair, in metres. Until the thickness of this pair has been computed, from its
/// distance at rest, this is the thickness of all such pairs.
///
/// The number is negative while it is the thickness of all such pairs. So code that runs in every step reads one number without a
/// branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim(f32);

impl Aim {
    pub(super) const fn requested(thickness: f64) -> Self {
        Self(-(thickness as f32))
    }

    pub(super) const fn computed(thickness: f64) -> Self {
        Self(thickness as f32)
    }

    pub(super) fn is_computed(self) -> bool {
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

/// Finds the closest points of up to sixteen pairs of one kind at once.
#[derive(Default)]
pub(super) struct ClosestOfSome {
    points: [[DVec3; 4]; LANES],
    closest: [ClosestPoints; LANES],
}

impl ClosestOfSome {
    /// Replaces the stored closest points by those of these pairs.
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

    /// The closest points, in the order of the pairs.
    pub(super) const fn found(&self) -> &[ClosestPoints] {
        &self.closest
    }
}

/// Returns when a pair comes within `separation` on the way from `start` to `end`; `None` if it certainly does not. Stores the
/// direction
/// that proves this in the pair.
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

        /// Tests the proof at sampled times; the place that makes the proof checks it with exact arithmetic.
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
                aim: Aim::requested(0.0),
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
            // The proof also holds from the start to a place where repairs may have moved the pair: the gap at the start was
            // large enough.
            let moved = [0, 1, 2, 3].map(|k| end[k] + moves[(k + 1) % 4] * 0.1);
            let mut again = pair;
            if until.is_none() && again.stays_apart(&moved, separation, error) {
                for step in 0..=20 {
                    let at = [0, 1, 2, 3].map(|k| start[k].lerp(moved[k], f64::from(step) / 20.0));
                    prop_assert!(ClosestPoints::from_points(kind, at).distance() > separation * (1.0 - 1e-9));
                }
            }
            // The proof also holds from the present place: `stays_apart` assumes that the gap is right there.
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
