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
//! Few pairs use up their rounds. For these, `f32` continues in `f64`, and `f64` in the exact verdict
//! ([`contact`](super::contact())).
//!
//! The proofs are written once, for any number of [`Lanes`](crate::lanes::Lanes). Here they serve one pair, which returns as soon
//! as it is decided; [`round`](crate::kernels::advance::round) serves many side by side, for [`batch`](crate::batch).
//! Verification runs them on tiny numbers, on symbols, and with other constants.
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
//! | [`LastResort`](Reason::LastResort) | zero at that time or later; with a separation at most s + V/4096 at some time |
//! | [`OutOfRange`](Reason::OutOfRange) | unknown: differences are above 2²⁹, `f64` 2²⁵⁰ |
//! | [`NotFinite`](Reason::NotFinite) | undefined: NaN, an infinity, or a separation that is negative |
//!
//! V is the longest way of a corner during the step. A round that ends neither within δ + s nor within rounding of s proves that
//! the pair is apart for some time. This is the time that the distance beyond s takes at speed V, apart from a few u. So 4096
//! rounds that each prove more than a 4096th of the step pass its end.
//!
//! # Loose answers
//! Where the sets' distance falls to the error of a product, about 20u times the size of the corners, nothing more can be proven.
//! The answer is that time, [`Reason::WithinError`], although they may touch much later or never. Sets that rest on each other to
//! the last digit do so from the start. The [exact verdict](super::contact()) decides whether they touch.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that proves nothing"
)]

#[cfg(test)]
mod tests;

use super::{Impact, Limits, Reason};
use crate::PairKind;
use crate::exact;
use crate::kernels::advance::Work;
use crate::kernels::advance::closest::{Closest, Feature, closest, closest_of_thin};
pub use crate::kernels::advance::confirm::certain_contact;
use crate::kernels::advance::corners::Corners;
use crate::kernels::advance::directions::{Direction, are_apart_curving, are_apart_turning, beyond};
use crate::kernels::advance::turning::{along_face, along_side, balanced, farthest, in_the_middle};
use crate::kernels::advance::volume::{Clipped, SignedVolume};
use crate::lanes::Number;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The largest number of rounds without a separation, and in `f32`.
pub const ROUNDS: u32 = 64;

/// The largest number of rounds in `f64` with a separation, where no exact verdict helps.
pub const ROUNDS_WITH_SEPARATION: u32 = 4096;

/// The number of rounds after which a pair is hard: it slides, or its closest points are hard to find.
const EASY_ROUNDS: u32 = 3;

/// The largest number of turning directions in one round.
pub const TURNS: u32 = 10;

/// The largest number of times that the volume is clipped in one round.
const CLIPS: u32 = 8;

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

/// It is out of line: a program has one such function of 25 kB for each format, instead of one for each caller.
#[inline(never)]
fn impact_within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2]) -> Impact<S> {
    within(pair, limits, span).0
}

/// Returns [`time_of_impact`] and its work.
#[cfg(feature = "verification")]
#[inline]
pub fn time_of_impact_and_work<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> (Impact<S>, Work) {
    within(pair, limits, [S::ZERO, S::ONE])
}

/// Returns [`time_of_impact_and_work`] of four points in numbers of any format, verification's included. A separation must not be
/// subnormal.
#[cfg(feature = "verification")]
#[inline(always)]
pub fn time_of_impact_of_points<P: PairShape, S: Number>(points: &PairPoints<S>, limits: &Limits<S>) -> (Impact<S>, Work) {
    advanced::<P, S>(points, limits, [S::ZERO, S::ONE], ROUNDS)
}

/// Advances within a span of time, with a separation that every thread compares at its value.
#[inline(always)]
fn within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2]) -> (Impact<S>, Work) {
    let limits = Limits {
        separation: limits.separation.raised_to_normal(),
        ..*limits
    };
    let is_last = S::FRACTION_BITS == <f64 as Scalar>::FRACTION_BITS && limits.separation > S::ZERO;
    let rounds = if is_last { ROUNDS_WITH_SEPARATION } else { ROUNDS };
    let (impact, work) = of_kind!(pair.kind, P => advanced::<P, S>(&pair.into(), &limits, span, rounds));
    match impact {
        Impact::Possible {
            time,
            reason: Reason::LastResort,
        } if !is_last => (last_resort(pair, &limits, [time, span[1]]), work),
        _ => (impact, work),
    }
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

/// Advances from the first time of `span` to the second.
#[inline(always)]
fn advanced<P: PairShape, S: Number>(points: &PairPoints<S>, limits: &Limits<S>, span: [S; 2], rounds: u32) -> (Impact<S>, Work) {
    if limits.separation <= S::ZERO && points.are_apart_along_three_axes::<P>() {
        if limits.separation < S::ZERO {
            return not_excluded(S::ZERO, Reason::NotFinite, Work::default());
        }
        return (Impact::Never, Work::default());
    }
    match P::KIND {
        PairKind::VertexFace => {
            let corners = Corners::of_vertex_face(points);
            decide(points, corners, limits, span, rounds)
        }
        PairKind::EdgeEdge => {
            let corners = Corners::of_edge_edge(points);
            decide(points, corners, limits, span, rounds)
        }
    }
}

#[inline(always)]
const fn not_excluded<S: Copy>(time: S, reason: Reason, work: Work) -> (Impact<S>, Work) {
    (Impact::Possible { time, reason }, work)
}

/// Runs everything after the relative boxes.
#[inline(always)]
fn decide<S: Number, const N: usize>(
    points: &PairPoints<S>,
    corners: Corners<S, N>,
    limits: &Limits<S>,
    span: [S; 2],
    rounds: u32,
) -> (Impact<S>, Work) {
    let mut work = Work::default();
    if !(points.is_finite() && limits.separation >= S::ZERO) {
        return not_excluded(S::ZERO, Reason::NotFinite, work);
    }
    if !(corners.are_in_range() && limits.separation <= S::LARGEST_EXTENT) {
        return not_excluded(S::ZERO, Reason::OutOfRange, work);
    }
    let corners = &corners;
    let separation = (limits.separation > S::ZERO).then_some(limits.separation);
    if separation.is_some_and(|separation| corners.are_beyond_along_an_axis(separation)) {
        return (Impact::Never, work);
    }
    let volume = SignedVolume::new(corners, separation);
    work.volume_steps += 1;
    if volume.proves_apart_throughout() {
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
    }
    .run();
    (impact, work)
}

/// One pair that advances.
struct Advance<'a, S, const N: usize> {
    corners: &'a Corners<S, N>,
    volume: &'a SignedVolume<S>,
    limits: &'a Limits<S>,
    /// The separation, if it is not zero.
    separation: Option<S>,
    /// The time up to which it is proven to be apart, and the end of the requested time.
    span: [S; 2],
    /// The number of allowed rounds.
    rounds: u32,
    work: &'a mut Work,
}

/// The pair at one time, up to which it is proven to be apart.
#[derive(Clone, Copy)]
struct Snapshot<S, const N: usize> {
    time: S,
    positions: [Vector<S>; N],
    closest: Closest<S>,
}

impl<S: Number, const N: usize> Snapshot<S, N> {
    #[inline(always)]
    fn new(corners: &Corners<S, N>, time: S) -> Self {
        let positions = corners.at(time);
        Self {
            time,
            positions,
            closest: closest(&positions),
        }
    }

    /// Returns a direction away from the origin, along which the hull is beyond the closest point. It is costly where that point
    /// is very near, so the tolerance is tested first.
    #[inline(always)]
    fn direction(&self, corners: &Corners<S, N>) -> Vector<S> {
        let extent = corners.extent.largest();
        self.closest.direction(&self.positions, extent)
    }
}

impl<S: Number, const N: usize> Advance<'_, S, N> {
    #[inline(always)]
    fn run(&mut self) -> Impact<S> {
        let near = self.limits.tolerance + self.limits.separation;
        let near_squared = near * near;
        let [from, end] = self.span;
        let mut now = Snapshot::new(self.corners, from);
        let possible = |now: &Snapshot<S, N>, reason| Impact::Possible { time: now.time, reason };
        while self.work.rounds < self.rounds {
            self.work.rounds += 1;
            if now.closest.squared_distance <= near_squared {
                return possible(&now, Reason::WithinTolerance);
            }
            let mut until = match self.apart_until(&now) {
                Ok(until) => until,
                Err(reason) => return possible(&now, reason),
            };
            if until >= beyond(until) {
                return Impact::Never;
            }
            if self.work.rounds > 1 && now.closest.feature == Feature::Interior {
                let Clipped {
                    to_the_end,
                    until: later,
                } = self.clipped_volume(now.time);
                if to_the_end {
                    return Impact::Never;
                }
                until = later.larger(until);
            }
            if until > end {
                return Impact::Never;
            }
            let mut next = self.snapshot(until);
            if self.work.rounds > EASY_ROUNDS && next.closest.squared_distance > near_squared {
                self.turn_on(&now, &mut next);
                if next.time >= S::ONE || next.time > end {
                    return Impact::Never;
                }
            }
            now = next;
        }
        possible(&now, Reason::LastResort)
    }

    /// Returns the pair at `time`. In a pair with many rounds, its closest point is accurate for thin hulls too.
    #[inline(always)]
    fn snapshot(&self, time: S) -> Snapshot<S, N> {
        let mut snapshot = Snapshot::new(self.corners, time);
        if self.work.rounds > EASY_ROUNDS {
            snapshot.closest = closest_of_thin(&snapshot.positions);
        }
        snapshot
    }

    /// Returns a later time until which a constant direction keeps the pair apart, or the reason why there is none.
    #[inline(always)]
    fn apart_until(&self, now: &Snapshot<S, N>) -> Result<S, Reason> {
        let w = now.direction(self.corners);
        self.apart_along(w, now)
            .map_or_else(|| self.apart_at_second_sight(w, now), Ok)
    }

    #[inline(always)]
    fn apart_along(&self, w: Vector<S>, now: &Snapshot<S, N>) -> Option<S> {
        let proven = self.corners.apart_along(&self.direction(w), &now.positions, true);
        (proven.is_apart && proven.until > now.time).then_some(proven.until)
    }

    /// Handles a direction of the closest point, `w`, that proves nothing: either the sets are too close, or that point is wrong.
    #[cold]
    fn apart_at_second_sight(&self, w: Vector<S>, now: &Snapshot<S, N>) -> Result<S, Reason> {
        if self.hides(&now.closest) {
            return Err(Reason::WithinError);
        }
        self.apart_along(farthest(&now.positions, w), now).ok_or_else(|| {
            let is_hidden = self.hides(&closest_of_thin(&now.positions));
            if is_hidden { Reason::WithinError } else { Reason::LastResort }
        })
    }

    /// Returns whether sets with these closest points are no farther apart than the bound of [`Reason::WithinError`].
    #[inline(always)]
    fn hides(&self, closest: &Closest<S>) -> bool {
        let (separation, extent) = (self.limits.separation, self.corners.extent);
        let sizes = separation + ((extent.x + extent.y) + extent.z);
        let error = S::small(128) * S::UNIT_ROUNDOFF * sizes + S::small(4) * S::LENGTH_UNDERFLOW;
        let bound = separation + error;
        closest.squared_distance <= bound * bound
    }

    #[inline(always)]
    fn direction(&self, w: Vector<S>) -> Direction<S> {
        self.corners.direction(w, self.separation)
    }

    /// Returns the time until which the volume proves, from `time` on, that the pair is apart.
    #[inline(always)]
    fn clipped_volume(&mut self, time: S) -> Clipped<S> {
        let mut until = time;
        for _ in 0..CLIPS {
            self.work.volume_steps += 1;
            let next = self.volume.clipped::<false>(until);
            let step = next.until - until;
            until = next.until;
            // Steps as short as rounding errors make no progress.
            if next.to_the_end || !(step > S::small(16) * S::UNIT_ROUNDOFF) {
                return Clipped { until, ..next };
            }
        }
        Clipped {
            to_the_end: false,
            until,
        }
    }

    /// Advances from `next`, which one round reached from `now`, as far as a turning direction proves. It tries nine tenths of
    /// the way to the contact that the last round's approach predicts, and then less.
    ///
    /// Each tried reach is at most a quarter of the one before, and the last is no longer than a few rounds. Rounding may hide
    /// the approach, so the last is tried however far the first reach is.
    #[inline(never)]
    fn turn_on(&mut self, now: &Snapshot<S, N>, next: &mut Snapshot<S, N>) {
        let separation = self.limits.separation;
        let gap = |at: &Snapshot<S, N>| at.closest.squared_distance.sqrt() - separation;
        let (gap_now, gap_next) = (gap(now), gap(next));
        let step = next.time - now.time;
        let mut reach = S::ONE - next.time;
        if gap_next < gap_now {
            let contact = step * gap_next / (gap_now - gap_next);
            reach = (contact * (S::small(9) / S::small(10))).smaller(reach);
        }
        let shortest = S::small(4) * step;
        let mut shrinks = S::small(4);
        let before = self.turning(next);
        for turn in 0..TURNS {
            let goal = (next.time + reach).smaller(S::ONE);
            if !(goal > next.time) {
                return;
            }
            self.work.turns += 1;
            let later = self.snapshot(goal);
            if self.keeps_apart(&before, next, &later) {
                *next = later;
                return;
            }
            if turn + 5 == TURNS {
                shrinks = shrinks.larger((reach / shortest).sqrt().sqrt());
            }
            reach = reach / shrinks;
        }
    }

    /// Returns the direction to turn from or to, of unit length up to rounding. It is the middle of those that keep the pair
    /// apart. The exceptions are a closest point inside the face or both edges, and a direction that does not keep twice the
    /// separation.
    #[inline(always)]
    fn turning(&self, at: &Snapshot<S, N>) -> Direction<S> {
        let middle = if at.closest.feature == Feature::Interior {
            None
        } else {
            in_the_middle(&at.positions)
        };
        let keeps_twice = |direction: &Direction<S>| {
            let twice = direction.bar + direction.bar;
            at.positions.iter().all(|corner| direction.w.dot(*corner) > twice)
        };
        let middle = middle.map(|w| self.direction(w)).filter(keeps_twice);
        middle.unwrap_or_else(|| self.direction(farthest(&at.positions, at.direction(self.corners))))
    }

    /// Returns whether a direction that turns from `before` to another proves that the pair is apart between two times.
    #[inline(always)]
    fn keeps_apart(&self, before: &Direction<S>, from: &Snapshot<S, N>, to: &Snapshot<S, N>) -> bool {
        let after = self.turning(to);
        let proves = |after| are_apart_turning(before, &from.positions, &after, &to.positions);
        let balanced = |w| balanced(before.w, &from.positions, w, &to.positions);
        if proves(after) || proves(self.direction(balanced(after.w))) {
            return true;
        }
        let proves = |curve: [Vector<S>; 3]| are_apart_curving(&curve.map(|w| self.direction(w)), &from.positions, &to.positions);
        to.closest.feature == Feature::Interior && along_face(&from.positions, &to.positions).is_some_and(proves)
            || along_side([before.w, after.w], &from.positions, &to.positions, &to.closest).is_some_and(proves)
    }
}
