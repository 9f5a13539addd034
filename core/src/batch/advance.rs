//! Advancing many pairs by separating directions, one round for sixteen of them at a time.
//!
//! [`advance_from_rows`] is one [round](crate::kernels::advance::round) of the certified
//! [time of impact](crate::elementary::advance::time_of_impact) for pairs of a mesh.

use super::rows::Padded;
use super::{LANES, Level, Mask, VertexRow};
use crate::PairKind;
use crate::elementary::Limits;
use crate::kernels::advance::round;
use crate::lanes::{Lanes, Rounding};
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;

/// What a round found of sixteen pairs. A pair in none of the three has advanced, and is still open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Round {
    /// Certainly farther apart than the separation until the end of the time asked about.
    pub apart: Mask,
    /// At its time, which did not change, within the tolerance of the separation.
    pub near: Mask,
    /// Nothing more could be proven in lanes; its time did not change.
    pub stuck: Mask,
}

/// What a round is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundQuestion<S> {
    /// Separation and tolerance.
    pub limits: Limits<S>,
    /// Up to when pairs are of interest, at most 1.
    pub until: S,
    /// Whether the signed volume is asked as well: half as much work again, which pays for pairs that come close to contact. Only
    /// with a separation of zero.
    pub with_volume: bool,
}

/// One round of advancing for each pair that `indices` name, from its time on: proven to be apart up to that, each is proven to be so up
/// to a later one, or to the end.
///
/// A caller sweeps over all open pairs, drops those that are decided, sweeps again, and finishes those that are stuck, or still
/// open after a dozen sweeps, one by one
/// ([`time_of_impact_within`](crate::elementary::advance::time_of_impact_within)).
///
/// **Certified, in every floating-point environment**, as for one pair, and the same bits on every instruction set. NaN,
/// infinite or too large differences, and indices that are not in the rows, make a pair [`stuck`](Round::stuck).
///
/// Times and rounds past the last pair are not touched; pairs past
/// the last time or round are not looked at. With a separation or a tolerance that is negative, NaN or too large (above 2²⁹,
/// `f64` 2²⁵⁰) all pairs are stuck.
///
/// Each pair must be proven to be apart from the start up to its time; zero will always do. Afterwards it is so up to the
/// new one. The four indices are those of its vertices: vertex, face; or first edge, second edge.
///
/// ```
/// use selvedge_core::batch::{advance_from_rows, Level, Round, RoundQuestion, VertexRow};
/// use selvedge_core::{elementary::Limits, glam::DVec3, PairKind, Motion};
/// // A vertex that falls from 1 to −1 onto a resting triangle.
/// let mut rows = vec![VertexRow::new(Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)))];
/// rows.extend([DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| VertexRow::new(Motion::resting(corner))));
/// let question = RoundQuestion { limits: Limits::default(), until: 1.0, with_volume: false };
/// let (mut times, mut rounds) = ([0.0], [Round::default()]);
/// let kind = PairKind::VertexFace;
/// advance_from_rows(Level::baseline(), kind, &question, &rows, &[[0, 1, 2, 3]], &mut times, &mut rounds);
/// assert!(times[0] > 0.499 && times[0] <= 0.5);
/// advance_from_rows(Level::baseline(), kind, &question, &rows, &[[0, 1, 2, 3]], &mut times, &mut rounds);
/// assert_eq!(rounds[0].near, 1);
/// ```
pub fn advance_from_rows<S: Scalar>(
    level: Level,
    kind: PairKind,
    question: &RoundQuestion<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    times: &mut [S],
    rounds: &mut [Round],
) {
    let question = RoundQuestion {
        limits: Limits {
            separation: question.limits.separation.raised_to_normal(),
            ..question.limits
        },
        ..*question
    };
    let Limits { tolerance, separation } = question.limits;
    let is_length = |length: S| length >= S::ZERO && length <= S::LARGEST_EXTENT;
    let is_good = is_length(tolerance) && is_length(separation);
    let pairs = indices.chunks(LANES).zip(times.chunks_mut(LANES));
    for ((indices, times), round) in pairs.zip(rounds) {
        if !is_good {
            *round = Round {
                stuck: Mask::MAX.checked_shr((LANES - LANES.min(indices.len())) as u32).unwrap_or(0),
                ..Round::default()
            };
            continue;
        }
        let whole = match (indices.first_chunk(), times.first_chunk_mut()) {
            (Some(indices), Some(times)) => S::round(level, kind, &question, rows, indices, times, Mask::MAX),
            _ => None,
        };
        *round = whole.unwrap_or_else(|| padded(level, kind, &question, rows, indices, times));
    }
}

/// Fewer than sixteen pairs, or some whose indices are not in `rows`.
#[cold]
fn padded<S: Scalar>(
    level: Level,
    kind: PairKind,
    question: &RoundQuestion<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    times: &mut [S],
) -> Round {
    let unknown = Mask::MAX.checked_shr((LANES - LANES.min(times.len())) as u32).unwrap_or(0);
    let mut all = Round {
        stuck: unknown,
        ..Round::default()
    };
    let Some(Padded { indices, known }) = Padded::new(indices, rows.len()) else {
        return all;
    };
    let mut whole_times = [S::ZERO; LANES];
    for (own, &time) in whole_times.iter_mut().zip(times.iter()) {
        *own = time;
    }
    let Some(round) = S::round(level, kind, question, rows, &indices, &mut whole_times, known) else {
        return all;
    };
    for (lane, (time, new)) in times.iter_mut().zip(whole_times).enumerate() {
        if known >> lane & 1 != 0 {
            *time = new;
        }
    }
    all.apart = round.apart & known;
    all.near = round.near & known;
    all.stuck = unknown & !known | round.stuck & known;
    all
}

/// One round in lanes.
#[inline(always)]
pub(super) fn round<P: PairShape, L: Lanes>(
    points: &PairPoints<L>,
    time: L,
    question: &RoundQuestion<L::Scalar>,
) -> round::Found<L>
where
    L::Scalar: Scalar,
{
    let Limits { tolerance, separation } = question.limits;
    let question = round::Question {
        near: time.splat(tolerance + separation),
        separation: (separation > L::Scalar::ZERO).then(|| time.splat(separation)),
        until: time.splat(question.until),
        with_volume: question.with_volume,
    };
    round::round::<P, L>(points, time, &question)
}
