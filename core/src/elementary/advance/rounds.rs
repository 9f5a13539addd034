//! The rounds of one pair that advances.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison is false with NaN, which must then take the side that proves nothing"
)]

use super::witness::{Proof, Record};
use super::{Impact, Limits, Reason, TURNS};
use crate::kernels::advance::Work;
use crate::kernels::advance::closest::{Closest, Feature, closest, closest_of_thin};
use crate::kernels::advance::corners::Corners;
use crate::kernels::advance::directions::{Direction, are_apart_curving, are_apart_turning, beyond};
use crate::kernels::advance::turning::{along_face, along_side, balanced, farthest, in_the_middle};
use crate::kernels::advance::volume::{Clipped, SignedVolume};
use crate::lanes::Number;
use crate::separation_lanes::SeparationLanes;
use crate::vector::Vector;

/// The number of rounds after which a pair is hard: it slides, or its closest points are hard to find.
pub(super) const EASY_ROUNDS: u32 = 3;

/// The largest number of times that the volume is clipped in one round.
const CLIPS: u32 = 8;

pub(super) struct Advance<'a, S, R, const N: usize> {
    pub(super) corners: &'a Corners<S, N>,
    pub(super) volume: &'a SignedVolume<S>,
    pub(super) limits: &'a Limits<S>,
    pub(super) separation: SeparationLanes<S>,
    /// The time up to which it is proven to be apart, and the end of the requested time.
    pub(super) span: [S; 2],
    pub(super) rounds: u32,
    pub(super) work: &'a mut Work,
    pub(super) record: &'a mut R,
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

impl<S: Number, R: Record<S>, const N: usize> Advance<'_, S, R, N> {
    #[inline(always)]
    pub(super) fn run(&mut self) -> Impact<S> {
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
            let (mut until, w) = match self.apart_until(&now) {
                Ok(proven) => proven,
                Err(reason) => return possible(&now, reason),
            };
            self.record.add(until, Proof::Held(w.into()));
            if until >= beyond(until) {
                return Impact::Never;
            }
            if self.work.rounds > 1 && now.closest.feature == Feature::Interior {
                let Clipped {
                    to_the_end,
                    until: later,
                } = self.clipped_volume(now.time);
                if to_the_end {
                    self.record.replace(S::ONE, Proof::Volume);
                    return Impact::Never;
                }
                if later > until {
                    self.record.replace(later, Proof::Volume);
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

    /// Returns a later time until which a constant direction keeps the pair apart, and the direction; or the reason why there is
    /// none.
    #[inline(always)]
    fn apart_until(&self, now: &Snapshot<S, N>) -> Result<(S, Vector<S>), Reason> {
        let w = now.direction(self.corners);
        self.apart_along(w, now)
            .map_or_else(|| self.apart_at_second_sight(w, now), Ok)
    }

    #[inline(always)]
    fn apart_along(&self, w: Vector<S>, now: &Snapshot<S, N>) -> Option<(S, Vector<S>)> {
        let proven = self.corners.apart_along(&self.direction(w), &now.positions, true);
        (proven.is_apart && proven.until > now.time).then_some((proven.until, w))
    }

    /// Handles a direction of the closest point, `w`, that proves nothing: either the sets are too close, or that point is wrong.
    #[cold]
    fn apart_at_second_sight(&self, w: Vector<S>, now: &Snapshot<S, N>) -> Result<(S, Vector<S>), Reason> {
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
        self.corners.direction_beyond(w, &self.separation)
    }

    /// Returns the time until which the volume proves, from `time` on, that the pair is apart.
    #[inline(always)]
    fn clipped_volume(&mut self, time: S) -> Clipped<S> {
        let mut until = time;
        for _ in 0..CLIPS {
            self.work.volume_steps += 1;
            let next = self.volume.clipped(until);
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
            if let Some(proof) = self.keeps_apart(&before, next, &later) {
                self.record.add(later.time, proof);
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

    /// Returns a proof by a direction that turns from `before` to another that the pair is apart between two times.
    #[inline(always)]
    fn keeps_apart(&self, before: &Direction<S>, from: &Snapshot<S, N>, to: &Snapshot<S, N>) -> Option<Proof<S>> {
        let after = self.turning(to);
        let straight = |after: Direction<S>| {
            are_apart_turning(before, &from.positions, &after, &to.positions)
                .then(|| Proof::Turning([before.w.into(), after.w.into()]))
        };
        let curved = |curve: [Vector<S>; 3]| {
            are_apart_curving(&curve.map(|w| self.direction(w)), &from.positions, &to.positions)
                .then(|| Proof::Curving(curve.map(<[S; 3]>::from)))
        };
        let balanced = || self.direction(balanced(before.w, &from.positions, after.w, &to.positions));
        let face = || (to.closest.feature == Feature::Interior).then(|| along_face(&from.positions, &to.positions))?;
        let side = || along_side([before.w, after.w], &from.positions, &to.positions, &to.closest);
        straight(after)
            .or_else(|| straight(balanced()))
            .or_else(|| face().and_then(curved))
            .or_else(|| side().and_then(curved))
    }
}
