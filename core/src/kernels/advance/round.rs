//! One round of conservative advancement for a pair in each lane, with the proofs that suit lanes.
//!
//! The proofs are those for one pair ([`directions`](super::directions), [`volume`](super::volume)): a constant separating
//! direction and, on request, two steps of clipping the signed volume. The direction is that of the closest point, found without
//! branches. Callers use [`advance_from_rows`](crate::batch::advance_from_rows).

use super::closest::closest_by_selects;
use super::corners::Corners;
use super::directions::beyond;
use super::volume::SignedVolume;
use crate::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::points::{PairPoints, PairShape};
use crate::separation_lanes::SeparationLanes;

/// The parameters of a round, the same in each lane.
#[derive(Clone, Copy, Debug)]
pub struct RoundInput<L> {
    /// The distance within which a pair is near: the tolerance and the separation.
    pub near: L,
    /// The separation.
    pub separation: SeparationLanes<L>,
    /// The time up to which pairs matter, at most 1.
    pub until: L,
    /// True to use the signed volume as well, if there is no separation.
    pub with_volume: bool,
}

/// The result of a round. In each lane one mask is true, or none if the pair has advanced and is still open.
#[derive(Clone, Copy, Debug)]
pub struct RoundResult<L: Lanes> {
    /// The time up to which the pair is proven to be apart.
    pub time: L,
    /// The lanes that are certainly farther apart than the separation up to the time of interest.
    pub apart: L::Mask,
    /// The lanes that are, at their unchanged time, within the tolerance of the separation.
    pub near: L::Mask,
    /// The lanes of which no more could be proven; their time did not change.
    pub stuck: L::Mask,
}

/// Runs one round from `time` on, up to which the pairs are proven to be apart.
#[inline(always)]
#[must_use]
pub fn round<P: PairShape, L: Lanes>(points: &PairPoints<L>, time: L, question: &RoundInput<L>) -> RoundResult<L> {
    match P::KIND {
        PairKind::VertexFace => round_of(points, &Corners::of_vertex_face(points), time, question),
        PairKind::EdgeEdge => round_of(points, &Corners::of_edge_edge(points), time, question),
    }
}

#[inline(always)]
fn round_of<L: Lanes, const N: usize>(
    points: &PairPoints<L>,
    corners: &Corners<L, N>,
    time: L,
    question: &RoundInput<L>,
) -> RoundResult<L> {
    let is_in_range = corners.are_in_range() & points.is_finite();
    let now = corners.at(time);
    let w = closest_by_selects(&now, corners.extent);
    let squared_distance = w.dot(w);
    let is_beyond = squared_distance.greater(question.near * question.near);
    let is_number = time.splat(L::Scalar::INFINITY).greater(squared_distance);
    let near = is_in_range & is_number & !is_beyond;
    let others = !near;
    if L::may_leave(others) {
        // A near pair keeps its time, and there are no other pairs.
        return RoundResult {
            time,
            apart: others,
            near,
            stuck: others,
        };
    }

    let direction = corners.direction_beyond(w, &question.separation);
    let proven = corners.apart_along(&direction, &now, is_in_range);
    let mut until = proven.until;
    let mut is_proven = proven.is_apart & until.greater(time);

    if question.with_volume && !question.separation.is_positive() {
        let volume = SignedVolume::new(corners);
        let first = volume.clipped(time);
        let second = volume.clipped(first.until);
        let later = L::select(first.to_the_end | second.to_the_end, beyond(time), second.until);
        let is_later = is_in_range & later.greater(time) & (later.greater(until) | !is_proven);
        until = L::select(is_later, later, until);
        is_proven = is_proven | is_later;
    }

    let open = is_proven & !near;
    RoundResult {
        time: L::select(open, until, time),
        apart: open & until.greater(question.until),
        near,
        stuck: !(open | near),
    }
}
