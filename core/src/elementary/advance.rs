//! The certified time of impact: conservative advancement by separating directions.
//!
//! [`time_of_impact`] returns a time from which two moving sets may be within a distance s of each other (s = 0: touch), up to a
//! tolerance δ, a length. It never misses: [`Impact::Never`] is a proof, and the time of [`Impact::Possible`] is no later than
//! the first time at which they are that close.
//!
//! ```
//! use selvedge_core::elementary::{Impact, Limits, Reason, advance::time_of_impact};
//! use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
//!
//! // A vertex that falls from 1 to −1 onto a resting triangle, held 0.25 apart.
//! let pair = PrimitivePair::vertex_face(
//!     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)),
//!     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
//! );
//! let limits = Limits { tolerance: 1e-9, separation: 0.25 };
//! match time_of_impact(&pair, &limits) {
//!     Impact::Possible { time, reason: Reason::WithinTolerance } => {
//!         assert!(time <= 0.375 && time > 0.375 - 1e-9);
//!     }
//!     other => panic!("{other:?}"),
//! }
//! ```
//!
//! # The method
//! From time t = 0, the method advances to a later time up to which the pair is *proven* to be apart. It ends when the pair is
//! within δ + s, or the proof reaches the end of the step. It tries three proofs. All use only the pair's corners (`corners.rs`),
//! so there are no special cases for parallel edges, faces without area, or coplanar motion:
//! * a separating direction (`directions.rs`) from the closest points, held constant;
//! * from the second round on, where the closest points are inside the face or both edges, the signed volume (`volume.rs`): the
//!   points are not coplanar;
//! * from the fourth round on, a direction that turns, or moves on a curve (`turning.rs`). Where sets slide past one another, the
//!   reach of a constant direction shrinks with their distance, and that of a turning one does not.
//!
//! The length of an advance and the direction are heuristic, in plain floating point. Only the proofs count, and each covers its
//! rounding: see their modules.
//!
//! Few pairs use up their rounds, or have coordinates beyond the range of the proofs. For these, `f32` continues in `f64`, and
//! `f64` without a separation in the exact verdict ([`contact`](super::contact())).
//!
//! The proofs are written once, for any number of [`Lanes`](crate::lanes::Lanes). Here they serve one pair, which returns as soon
//! as it is decided; [`round`](crate::kernels::advance::round) serves many side by side, for [`batch`](crate::batch).
//! Verification runs them on symbols, and with other constants.
//!
//! The exact [relative boxes](crate::boxes::relative) come first, then the volume's proof for the whole step.
//!
//! # Guarantees
//! * **Every floating-point environment**: any rounding direction, subnormal numbers flushed or kept. A subnormal separation
//!   counts as the smallest normal number. (Excess precision and fused operations, which Rust does not use, are excluded.)
//! * **Bounded work**, whatever the input: at most [`ROUNDS`] rounds, or [`ROUNDS_WITH_SEPARATION`] in `f64` with a separation.
//!   [`Work`] has the number of steps in each. Degenerate pairs do not loop. The last resort adds the work of the exact verdict,
//!   or that of `f64`.
//! * **No false alarm**: a pair that is not excluded comes near. M is the largest difference between points of the two sets along
//!   each axis, τ is 2⁻⁶⁰ (`f64`: 2⁻⁵⁰⁰), u is 2⁻²⁴ (2⁻⁵³), and distances are exact:
//!
//! | reason | distance |
//! |---|---|
//! | [`WithinTolerance`](Reason::WithinTolerance) | at the time returned at most δ + s + 64u(δ + s + M_x + M_y + M_z) + τ |
//! | [`WithinError`](Reason::WithinError) | at the time returned at most s + 192u(s + M_x + M_y + M_z) + τ |
//! | [`LastResort`](Reason::LastResort) | zero at that time or later; with a separation, at some time at most V/4093 above the bound of `WithinError` |
//! | [`OutOfRange`](Reason::OutOfRange) | unknown, in `f64` with a separation: differences or the separation are above 2²⁵⁰, or coordinates above 2¹⁰¹⁹ |
//! | [`NotFinite`](Reason::NotFinite) | undefined: NaN, an infinity, or a separation that is negative |
//!
//! V is the longest path of a corner during the step. A round that ends neither within δ + s nor within rounding of s proves that
//! the pair is apart for some time. This is the time that the rest of the distance takes at speed V, apart from a few u. So 4093
//! rounds that each prove more than a 4093rd of the step pass its end. The first three rounds are not counted. They look for the
//! closest points in a cheaper way, which may be wrong for thin or tiny sets.
//!
//! # Loose answers
//! Where the sets' distance falls to the error of a product, about 20u times the size of the corners, nothing more can be proven.
//! The answer is that time, [`Reason::WithinError`], although the sets may touch much later or never. For sets that rest on each
//! other to the last digit, that time is zero. The [exact verdict](super::contact()) decides whether they touch.

mod rounds;
#[cfg(test)]
mod tests;
mod witness;

use super::{Impact, Limits, Reason};
use crate::PairKind;
use crate::exact;
use crate::kernels::advance::Work;
pub use crate::kernels::advance::confirm::certain_contact;
use crate::kernels::advance::corners::Corners;
use crate::kernels::advance::directions::axis_bar;
use crate::kernels::advance::volume::SignedVolume;
use crate::lanes::Number;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::separation_lanes::SeparationLanes;
use rounds::{Advance, EASY_ROUNDS};
pub use witness::{Proof, WITNESS_PARTS, Witness, WitnessPart, witness};
use witness::{Record, Unrecorded};

/// The largest number of rounds without a separation, and in `f32`.
pub const ROUNDS: u32 = 64;

/// The largest number of rounds in `f64` with a separation, where no exact verdict helps.
pub const ROUNDS_WITH_SEPARATION: u32 = 4096;

/// The largest number of turning directions in one round.
pub const TURNS: u32 = 10;

/// Returns the time from which the pair may be within the separation. It is certified: see the [module](self).
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> Impact<S> {
    impact_within(pair, limits, [S::ZERO, S::ONE])
}

/// Returns [`time_of_impact`] of a pair that is proven to be apart up to `from`, up to `until` only. [`Impact::Never`] says that
/// it is apart from `from` until then. A time that is not excluded is no earlier than `from`.
///
/// Both times must be in [0, 1] and ascend; otherwise nothing is excluded. So a caller who has advanced pairs side by side
/// ([`batch`](crate::batch)), or who looks for the earliest contact, resumes from what is known.
#[inline]
pub fn time_of_impact_within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, from: S, until: S) -> Impact<S> {
    if !(from >= S::ZERO && from <= S::ONE && until >= from && until <= S::ONE) {
        return not_excluded(S::ZERO, Reason::NotFinite, Work::default()).0;
    }
    impact_within(pair, limits, [from, until])
}

#[inline]
fn impact_within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2]) -> Impact<S> {
    within(pair, limits, span).0
}

/// Returns [`time_of_impact`] and its work.
#[inline]
pub fn time_of_impact_and_work<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> (Impact<S>, Work) {
    within(pair, limits, [S::ZERO, S::ONE])
}

/// Returns [`time_of_impact_and_work`] of four points in numbers of any format, other crates' included, after at most `rounds`
/// rounds. A separation must not be subnormal.
#[inline(always)]
pub fn time_of_impact_of_points<P: PairShape, S: Number>(
    points: &PairPoints<S>,
    limits: &Limits<S>,
    rounds: u32,
) -> (Impact<S>, Work) {
    advanced::<P, S, _>(points, limits, [S::ZERO, S::ONE], rounds, &mut Unrecorded)
}

/// Returns the time from which the pair may touch, as far as the first rounds prove. They settle most pairs, and take less time
/// than whole numbers; later rounds often take more.
#[inline]
pub(super) fn easy_impact<S: Scalar>(pair: &PrimitivePair<S>) -> Impact<S> {
    in_rounds(pair, &Limits::accurate_to(S::ZERO), [S::ZERO, S::ONE], EASY_ROUNDS).0
}

/// Returns limits with a separation that every thread compares at its value.
#[inline(always)]
fn normal<S: Scalar>(limits: &Limits<S>) -> Limits<S> {
    Limits {
        separation: limits.separation.raised_to_normal(),
        ..*limits
    }
}

/// Advances within a span of time, and then by the last resort.
#[inline(always)]
fn within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2]) -> (Impact<S>, Work) {
    let limits = normal(limits);
    let is_last = S::FRACTION_BITS == <f64 as Scalar>::FRACTION_BITS && limits.separation > S::ZERO;
    let rounds = if is_last { ROUNDS_WITH_SEPARATION } else { ROUNDS };
    let (impact, work) = in_rounds(pair, &limits, span, rounds);
    match impact {
        Impact::Possible {
            time,
            reason: Reason::LastResort,
        } if !is_last => (last_resort(pair, &limits, [time, span[1]]), work),
        // `f64` has the range of all `f32`, and whole numbers have any.
        Impact::Possible {
            reason: Reason::OutOfRange,
            ..
        } if !is_last => (last_resort(pair, &limits, span), work),
        _ => (impact, work),
    }
}

/// Advances by at most `rounds` rounds.
///
/// It is out of line: a program has one such function of 25 kB for each format, instead of one for each caller.
#[inline(never)]
fn in_rounds<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2], rounds: u32) -> (Impact<S>, Work) {
    of_kind!(pair.kind, P => advanced::<P, S, _>(&pair.into(), limits, span, rounds, &mut Unrecorded))
}

/// Decides a pair that advancing in this format left open. For `f32`, advancing continues in `f64`, whose errors are half a
/// billion times smaller. For `f64`, whole numbers decide whether it touches.
#[cold]
#[inline(never)]
fn last_resort<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, [from, until]: [S; 2]) -> Impact<S> {
    let reason = Reason::LastResort;
    if S::FRACTION_BITS == <f64 as Scalar>::FRACTION_BITS {
        return match exact::touches(pair) {
            Some(false) => Impact::Never,
            _ => Impact::Possible { time: from, reason },
        };
    }
    let limits = Limits {
        tolerance: limits.tolerance.to_f64(),
        separation: limits.separation.to_f64(),
    };
    match impact_within(&pair.widened(), &limits, [from.to_f64(), until.to_f64()]) {
        Impact::Never => Impact::Never,
        Impact::Possible { time, reason } => Impact::Possible {
            time: S::truncated(time).larger(from),
            reason,
        },
    }
}

#[inline(always)]
fn advanced<P: PairShape, S: Number, R: Record<S>>(
    points: &PairPoints<S>,
    limits: &Limits<S>,
    span: [S; 2],
    rounds: u32,
    record: &mut R,
) -> (Impact<S>, Work) {
    if limits.separation <= S::ZERO && points.are_apart_along_three_axes::<P>() {
        if limits.separation < S::ZERO {
            return not_excluded(S::ZERO, Reason::NotFinite, Work::default());
        }
        let corners = || [P::corners(points.start), P::corners(points.end)].into_iter().flatten();
        if record.add_axis(corners, S::ZERO) {
            return (Impact::Never, Work::default());
        }
    }
    match P::KIND {
        PairKind::VertexFace => {
            let corners = Corners::of_vertex_face(points);
            decide(points, corners, limits, span, rounds, record)
        }
        PairKind::EdgeEdge => {
            let corners = Corners::of_edge_edge(points);
            decide(points, corners, limits, span, rounds, record)
        }
    }
}

#[inline(always)]
const fn not_excluded<S: Copy>(time: S, reason: Reason, work: Work) -> (Impact<S>, Work) {
    (Impact::Possible { time, reason }, work)
}

/// Runs everything after the relative boxes.
#[inline(always)]
fn decide<S: Number, R: Record<S>, const N: usize>(
    points: &PairPoints<S>,
    corners: Corners<S, N>,
    limits: &Limits<S>,
    span: [S; 2],
    rounds: u32,
    record: &mut R,
) -> (Impact<S>, Work) {
    let mut work = Work::default();
    if !(points.is_finite() && limits.separation >= S::ZERO) {
        let is_finite = |number: S| number.abs() < S::INFINITY;
        let mut corners = points.start.iter().chain(&points.end);
        // The sum of finite coordinates may overflow.
        let are_finite = corners.all(|corner| is_finite(corner.x) && is_finite(corner.y) && is_finite(corner.z));
        let is_known = are_finite && limits.separation >= S::ZERO;
        let reason = if is_known { Reason::OutOfRange } else { Reason::NotFinite };
        return not_excluded(S::ZERO, reason, work);
    }
    if !(corners.are_in_range() && limits.separation <= S::LARGEST_EXTENT) {
        return not_excluded(S::ZERO, Reason::OutOfRange, work);
    }
    let corners = &corners;
    let separation = SeparationLanes::new(limits.separation, limits.separation);
    if separation.is_positive()
        && corners.are_beyond_along_an_axis(separation.length())
        && record.add_axis(|| corners.ends.into_iter().flatten(), axis_bar(separation.length()))
    {
        return (Impact::Never, work);
    }
    let volume = SignedVolume::beyond(corners, &separation);
    work.volume_steps += 1;
    if volume.proves_apart_throughout() {
        record.add(S::ONE, Proof::Volume);
        return (Impact::Never, work);
    }
    let impact = Advance {
        corners,
        volume: &volume,
        limits,
        separation,
        span,
        rounds,
        work: &mut work,
        record,
    }
    .run();
    (impact, work)
}
