//! The certified time of impact: conservative advancement by separating directions.
//!
//! [`time_of_impact`] asks from when on two moving sets may be within a distance s of each other (s = 0: touch), up to a
//! tolerance δ in length units. It never misses: [`Impact::Never`] is a proof, and the time of [`Impact::Possible`] is no later
//! than the first time at which they are that close.
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
//! From time t, and starting at 0, go on to a later one up to which the pair is *proven* to be apart, until it is within δ + s, or
//! the proof reaches the end of the step. Three proofs are tried, all on the pair's corners (`corners.rs`) alone, so there is no
//! case for parallel edges, faces without area, coplanar motion:
//! * a separating direction (`directions.rs`) from the closest points, held constant;
//! * from the second round on, where the closest points are inside the face or both edges, the signed volume (`volume.rs`): the points
//!   are not coplanar;
//! * from the fourth round on a direction that turns: where sets slide past one another, what a constant direction proves shrinks
//!   with their distance, and a turning one's does not.
//!
//! How far to go, and along which direction, is heuristic and in plain floating point. Only the proofs count, and each of them
//! covers its rounding: see the modules of the three.
//!
//! The proofs are written once, for any number of [`Lanes`](crate::lanes::Lanes): here one pair alone, which leaves as soon as it is
//! decided; in [`round`](crate::kernels::advance::round) many side by side, for [`batch`](crate::batch); and verification runs them on tiny numbers, on
//! symbols, and with other constants.
//!
//! Before all this come the [relative boxes](crate::boxes::relative), exact, and the volume's proof for the whole step.
//!
//! # What is promised
//! * **In every floating-point environment**: whatever direction the thread rounds in, and whether or not it flushes subnormal
//!   numbers to zero; a subnormal separation counts as the smallest normal number. (Not with excess precision or fused operations, which Rust does not use.)
//! * **A bounded amount of work**, whatever the input: at most [`ROUNDS`] rounds, [`Work`] says of how many steps each.
//!   Degenerate pairs do not loop.
//! * **Tight**, where the reason is [`Reason::WithinTolerance`]: at the time returned the exact distance is at most
//!   δ + s + 64u(δ + s + M_x + M_y + M_z) + 2⁻⁶⁰ (`f64`: 2⁻⁵⁰⁰), M being the largest difference between points of the two sets along
//!   each axis. The other reasons say nothing of the distance.
//! * **No answer from bad input**: NaN, infinite or too large differences (above 2²⁹, `f64` 2²⁵⁰) exclude nothing.
//!
//! # Where the answer is loose
//! Where the sets' distance comes down to the error of a product, about 20u times the size of the corners, nothing can be proven
//! any more: the answer is that time, [`Reason::WithinError`], though they may touch much later or never. Sets that rest on each
//! other to the last digit do so from the start.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that proves nothing"
)]

#[cfg(test)]
mod tests;

use super::{Impact, Limits, Reason};
use crate::PairKind;
use crate::kernels::advance::Work;
use crate::kernels::advance::closest::{Closest, Feature, closest};
pub use crate::kernels::advance::confirm::certain_contact;
use crate::kernels::advance::corners::Corners;
use crate::kernels::advance::directions::{Direction, are_apart_turning, beyond};
use crate::kernels::advance::volume::{Clipped, SignedVolume};
use crate::lanes::Number;
use crate::motion::PrimitivePair;
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The largest number of rounds.
pub const ROUNDS: u32 = 64;

/// How often the volume is clipped in one round, at most.
const CLIPS: u32 = 8;

/// From when on the pair may be within the separation. Certified: see the [module](self).
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> Impact<S> {
    impact_within(pair, limits, [S::ZERO, S::ONE])
}

/// [`time_of_impact`] of a pair that is proven to be apart up to `from`, asked no further than `until`: [`Impact::Never`] says
/// that it is apart from `from` until then, and a time that is not excluded is no earlier than `from`.
///
/// Both in [0, 1]; else, or if they are NaN, nothing is excluded. So a caller who has advanced pairs side by side
/// ([`batch`](crate::batch)), or who looks for the earliest contact, goes on from what is known.
#[inline]
pub fn time_of_impact_within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, from: S, until: S) -> Impact<S> {
    if !(from >= S::ZERO && from <= S::ONE && until >= from && until <= S::ONE) {
        return not_excluded(S::ZERO, Reason::NotFinite, Work::default()).0;
    }
    impact_within(pair, limits, [from, until])
}

/// Out of line: one such function for each format in a program, of 25 kB, and not one for each that calls it.
#[inline(never)]
fn impact_within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2]) -> Impact<S> {
    within(pair, limits, span).0
}

/// [`time_of_impact`], and how much work it was.
#[cfg(feature = "verification")]
#[inline]
pub fn time_of_impact_and_work<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> (Impact<S>, Work) {
    within(pair, limits, [S::ZERO, S::ONE])
}

/// [`time_of_impact_and_work`] of four points in numbers of any format, those of verification too. A separation must not be subnormal.
#[cfg(feature = "verification")]
#[inline(always)]
pub fn time_of_impact_of_points<P: PairShape, S: Number>(points: &PairPoints<S>, limits: &Limits<S>) -> (Impact<S>, Work) {
    advanced::<P, S>(points, limits, [S::ZERO, S::ONE])
}

/// Within a span of time, with a separation that every thread compares as what it is.
#[inline(always)]
fn within<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>, span: [S; 2]) -> (Impact<S>, Work) {
    let limits = Limits {
        separation: limits.separation.raised_to_normal(),
        ..*limits
    };
    of_kind!(pair.kind, P => advanced::<P, S>(&pair.into(), &limits, span))
}

/// From the first time of `span` to the second.
#[inline(always)]
fn advanced<P: PairShape, S: Number>(points: &PairPoints<S>, limits: &Limits<S>, span: [S; 2]) -> (Impact<S>, Work) {
    if limits.separation <= S::ZERO && points.are_apart_along_three_axes::<P>() {
        if limits.separation < S::ZERO {
            return not_excluded(S::ZERO, Reason::NotFinite, Work::default());
        }
        return (Impact::Never, Work::default());
    }
    match P::KIND {
        PairKind::VertexFace => {
            let corners = Corners::of_vertex_face(points);
            decide(points, corners, limits, span)
        }
        PairKind::EdgeEdge => {
            let corners = Corners::of_edge_edge(points);
            decide(points, corners, limits, span)
        }
    }
}

#[inline(always)]
const fn not_excluded<S: Copy>(time: S, reason: Reason, work: Work) -> (Impact<S>, Work) {
    (Impact::Possible { time, reason }, work)
}

/// Everything after the relative boxes.
#[inline(always)]
fn decide<S: Number, const N: usize>(
    points: &PairPoints<S>,
    corners: Corners<S, N>,
    limits: &Limits<S>,
    span: [S; 2],
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
        work: &mut work,
    }
    .run();
    (impact, work)
}

/// One pair on its way.
struct Advance<'a, S, const N: usize> {
    corners: &'a Corners<S, N>,
    volume: &'a SignedVolume<S>,
    limits: &'a Limits<S>,
    /// The separation, if it is not zero.
    separation: Option<S>,
    /// Up to when it is known to be apart, and when the time ends that is asked about.
    span: [S; 2],
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

    /// Away from the origin: in it the hull is beyond the closest point. Takes longest where that is very near, so that it is best asked
    /// for after the tolerance.
    #[inline(always)]
    fn direction(&self, corners: &Corners<S, N>) -> Vector<S> {
        let extent = corners.extent.largest();
        self.closest.direction(&self.positions, extent)
    }

    /// The direction, of unit length but for rounding.
    #[inline(always)]
    fn unit(&self, corners: &Corners<S, N>) -> Vector<S> {
        let direction = self.direction(corners);
        direction.scaled(S::ONE / direction.dot(direction).sqrt())
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
        while self.work.rounds < ROUNDS {
            self.work.rounds += 1;
            if now.closest.squared_distance <= near_squared {
                return possible(&now, Reason::WithinTolerance);
            }
            let proven = self
                .corners
                .apart_along(&self.direction(now.direction(self.corners)), &now.positions, true);
            if !(proven.is_apart && proven.until > now.time) {
                return possible(&now, Reason::WithinError);
            }
            let mut until = proven.until;
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
            let mut next = Snapshot::new(self.corners, until);
            if self.work.rounds > 3 && next.closest.squared_distance > near_squared {
                self.turn_on(&now, &mut next);
                if next.time >= S::ONE || next.time > end {
                    return Impact::Never;
                }
            }
            now = next;
        }
        possible(&now, Reason::OutOfRounds)
    }

    #[inline(always)]
    fn direction(&self, w: Vector<S>) -> Direction<S> {
        self.corners.direction(w, self.separation)
    }

    /// Until when the volume proves, from `time` on, that the pair is apart.
    #[inline(always)]
    fn clipped_volume(&mut self, time: S) -> Clipped<S> {
        let mut until = time;
        for _ in 0..CLIPS {
            self.work.volume_steps += 1;
            let next = self.volume.clipped::<false>(until);
            let step = next.until - until;
            until = next.until;
            // Steps as short as rounding errors lead nowhere.
            if next.to_the_end || !(step > S::small(16) * S::UNIT_ROUNDOFF) {
                return Clipped { until, ..next };
            }
        }
        Clipped {
            to_the_end: false,
            until,
        }
    }

    /// Moves on from `next`, to which one round has led from `now`, as far as a turning direction proves: nine tenths of the
    /// way to where the last round's approach predicts contact, or less, or not at all.
    #[inline(never)]
    fn turn_on(&mut self, now: &Snapshot<S, N>, next: &mut Snapshot<S, N>) {
        let separation = self.limits.separation;
        let gap = |at: &Snapshot<S, N>| at.closest.squared_distance.sqrt() - separation;
        let (gap_now, gap_next) = (gap(now), gap(next));
        let step = next.time - now.time;
        let mut goal = S::ONE;
        if gap_next < gap_now {
            let contact = step * gap_next / (gap_now - gap_next);
            goal = (next.time + contact * (S::small(9) / S::small(10))).smaller(S::ONE);
        }
        let before = self.direction(next.unit(self.corners));
        for widest in [32, 4, 4] {
            if !(goal > next.time) {
                return;
            }
            self.work.turns += 1;
            let later = Snapshot::new(self.corners, goal);
            let after = self.direction(later.unit(self.corners));
            if are_apart_turning(&before, &next.positions, &after, &later.positions) {
                *next = later;
                return;
            }
            let quarter = next.time + (goal - next.time) * (S::HALF * S::HALF);
            goal = quarter.smaller(next.time + S::small(widest) * step);
        }
    }
}
