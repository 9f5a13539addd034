//! Advances many pairs by separating directions, sixteen of them in one round.
//!
//! [`advance_from_rows`] is one [round](crate::kernels::advance::round) of the certified
//! [time of impact](crate::elementary::advance::time_of_impact) for pairs of a mesh.

use super::chunk::{Chunk, points};
use super::mask::{LANES, Mask};
use super::rows::{Padded, VertexRow};
use super::sixteen::Sixteen;
use crate::elementary::Limits;
use crate::kernels::advance::round;
use crate::kind::PairKind;
use crate::lanes::Lanes;
use crate::points::{PairPoints, PairShape};
use crate::scalar::{Family, InFormat, Scalar};
use crate::separation_lanes::SeparationLanes;
use core::marker::PhantomData;
use fearless_simd::Level;
#[cfg(not(unoptimised))]
use fearless_simd::{Simd, f32x8, f32x16, f64x2, f64x4, f64x8};

/// The result of one round for sixteen pairs. A pair in none of the three masks has advanced, and is still open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Round {
    /// The pairs that are certainly farther apart than the separation until the end of the requested time.
    pub apart: Mask,
    /// The pairs that are, at their unchanged time, within the tolerance of the separation.
    pub near: Mask,
    /// The pairs of which the lanes can prove no more; their times did not change.
    pub stuck: Mask,
}

/// The parameters of a round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundQuestion<S> {
    /// The separation and the tolerance.
    pub limits: Limits<S>,
    /// The time up to which pairs matter, at most 1.
    pub until: S,
    /// True to use the signed volume as well. It costs half as much again, which pays for pairs that come close to contact. It
    /// requires a separation of zero.
    pub with_volume: bool,
}

/// Advances each pair that `indices` name by one round. A pair that is proven apart up to its time is proven apart up to a later
/// one, or to the end.
///
/// A caller sweeps over all open pairs, drops the decided ones, and sweeps again. It finishes pairs that are stuck, or still open
/// after a dozen sweeps, one by one with [`time_of_impact_within`](crate::elementary::advance::time_of_impact_within).
///
/// **Certified, in every floating-point environment**, as for one pair, with the same bits on every instruction set. NaN,
/// infinite or too large differences, and indices that are not in the rows, make a pair [`stuck`](Round::stuck).
///
/// Times and rounds past the last pair are not changed; pairs past the last time or round are ignored. All pairs are stuck if a
/// separation or a tolerance is negative, NaN or too large (above 2²⁹, `f64` 2²⁵⁰).
///
/// Each pair must be proven apart from the start up to its time; zero is always valid. Afterwards it is so up to the new time.
/// The four indices are those of its vertices: vertex, face; or first edge, second edge.
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
            (Some(indices), Some(times)) => sixteen(level, kind, &question, rows, indices, times),
            _ => None,
        };
        *round = whole.unwrap_or_else(|| padded(level, kind, &question, rows, indices, times));
    }
}

/// Handles fewer than sixteen pairs, or some whose indices are not in `rows`.
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
    let Some(round) = sixteen(level, kind, question, rows, &indices, &mut whole_times) else {
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

/// Runs one round for sixteen pairs. Returns `None`, and changes no time, if an index is not in the rows.
fn sixteen<S: Scalar>(
    level: Level,
    kind: PairKind,
    question: &RoundQuestion<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]; LANES],
    times: &mut [S; LANES],
) -> Option<Round> {
    match S::in_format::<Input<'_>>((question, rows, times)) {
        InFormat::Single((question, rows, times)) => single(level, kind, question, rows, indices, times),
        InFormat::Double((question, rows, times)) => double(level, kind, question, rows, indices, times),
    }
}

/// The input and output of a round, in either format.
struct Input<'a>(PhantomData<&'a ()>);

impl<'a> Family for Input<'a> {
    type Of<S: Scalar> = (&'a RoundQuestion<S>, &'a [VertexRow<S>], &'a mut [S; LANES]);
}

macro_rules! rounds {
    ($name:ident, $scalar:ident, $lanes:tt) => {
        fn $name(
            level: Level,
            kind: PairKind,
            question: &RoundQuestion<$scalar>,
            rows: &[VertexRow<$scalar>],
            indices: &[[u32; 4]; LANES],
            times: &mut [$scalar; LANES],
        ) -> Option<Round> {
            of_kind!(kind, P => vectorized!(level, $lanes, all::<P>(question, rows, indices, times)))
        }
    };
}

// Rounds have long chains of dependent operations: two registers of `f32` at a time keep the machine busy.
rounds!(single, f32, [f32x16, f32x16, f32x8, f32]);
rounds!(double, f64, [f64x8, f64x4, f64x2, f64]);

/// Times are written only when all pairs are known to be in the rows, so that they are the same for each width.
#[inline(always)]
fn all<P: PairShape, L: Chunk>(
    token: L::Token,
    question: &RoundQuestion<L::Scalar>,
    rows: &[VertexRow<L::Scalar>],
    indices: &[[u32; 4]; LANES],
    times: &mut [L::Scalar; LANES],
) -> Option<Round> {
    let (mut all, mut new) = (Round::default(), *times);
    for chunk in 0..LANES / L::WIDTH {
        let first = chunk * L::WIDTH;
        let points = points::<L>(token, Sixteen::Mesh { rows, indices }, first)?;
        let found = round::<P, L>(&points, L::load(token, times, first), question);
        found.time.store(&mut new, first);
        all.apart |= L::bits(found.apart) << first;
        all.near |= L::bits(found.near) << first;
        all.stuck |= L::bits(found.stuck) << first;
    }
    *times = new;
    Some(all)
}

#[inline(always)]
fn round<P: PairShape, L: Lanes>(points: &PairPoints<L>, time: L, question: &RoundQuestion<L::Scalar>) -> round::RoundResult<L>
where
    L::Scalar: Scalar,
{
    let Limits { tolerance, separation } = question.limits;
    let question = round::RoundInput {
        near: time.splat(tolerance + separation),
        separation: SeparationLanes::new(separation, time),
        until: time.splat(question.until),
        with_volume: question.with_volume,
    };
    round::round::<P, L>(points, time, &question)
}
