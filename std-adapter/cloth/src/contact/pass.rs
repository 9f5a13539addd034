//! The certified pass: a step is accepted only if a proof exists that every candidate pair keeps its separation throughout.
//!
//! ```text
//! wanted motion ─▶ candidates ─▶ each free? ─▶ relaxation ─▶ each free? ─▶ accepted
//!                                                  └▶ base ─▶ truncation ─▶ accepted        (truncation)
//!                                                      └▶ cut: half the step
//! ```
//!
//! **The distance kept.** A pair keeps its [separation](super::separations), or a little less than its distance at the start if
//! it starts nearer: m_P of [core](selvedge_core::separation::carried). So a zone that is carried rigidly is free, as long as no
//! carrier turns by more than [`LARGEST_TURN`]. A simulation refuses to start with a pair that is nearer than rounding can
//! distinguish.
//!
//! **Relaxation.** Pairs that are not free become active, and positions are relaxed until all active pairs are kept apart. Then
//! the pass tests the pairs of the vertices that have moved. Those that are not free become active as well
//! ([`relaxation`](super::relaxation)). On sleeves that bend, of 1 to 134 thousand triangles, this was enough in every measured
//! step. Relaxation keeps momentum, and truncation does not. So relaxation gets all of its rounds, though jammed cloth spends
//! most of a step on them and is truncated all the same.
//!
//! **It ends.** Relaxation has a bounded number of rounds ([`Effort`]). The search for a base, and the truncation towards it, end
//! by themselves ([`truncation`](super::truncation)). A cut halves the step, a bounded number of times.
//!
//! **Candidates** last for several steps; the [detector](selvedge::coherent::NearPairs) states which pairs they hold.

use super::candidate::{Candidate, ClosestOfSome, impact, time_of_impact_of};
use super::report::Blocker;
use super::separations::Separations;
use super::solver::{ContactSolver, gap_error};
use crate::model::rigid::RigidMotion;
use crate::model::step::{FREE, TimeStep};
use selvedge::PairKind;
use selvedge::clock::Clock;
use selvedge::parallel;
use selvedge::simd::Level;
use selvedge_core::batch::LANES;
use selvedge_core::glam::DVec3;
#[cfg(doc)]
use selvedge_core::separation::carried::LARGEST_TURN;
use selvedge_core::separation::carried::kept_when_carried;
use selvedge_core::separation::gap::{GapError, distance_from_below};

/// The effort of a relaxation towards the wanted positions.
const EFFORT: Effort = Effort {
    closures: 12,
    rounds: 60,
    gives_up: false,
};

/// The limits of a relaxation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// The number of times that the active set may grow.
    pub(super) closures: usize,
    /// The number of rounds each time.
    pub(super) rounds: usize,
    /// True if the relaxation stops at the first time that all rounds do not keep the pairs apart.
    pub(super) gives_up: bool,
}

impl ContactSolver {
    /// Turns the wanted motion, from the start of the step to `end`, into one that is certainly free. `bodies` are the motions of
    /// free bodies, which it changes as well where cloth alone cannot give way.
    ///
    /// # Errors
    /// Returns an error if the step has to be cut; then only `end` has changed.
    pub(crate) fn certify(&mut self, step: &TimeStep<'_>, end: &mut [DVec3], bodies: &mut [RigidMotion]) -> Result<(), Blocker> {
        let start = step.start;
        let begin = Clock::now();
        self.candidates.cover(start, end, step.h);
        self.error = gap_error(&self.candidates, [start, end]);
        self.stages.candidates += begin.elapsed().as_secs_f64();
        self.counts.candidates += self.candidates.list.len() as u64;

        let begin = Clock::now();
        let open = self.check_all(start, end);
        self.counts.violated += open.len() as u64;
        self.stages.certificates += begin.elapsed().as_secs_f64();
        let mut result = Ok(());
        if !open.is_empty() {
            let begin = Clock::now();
            result = self.repair(open, step, end, bodies);
            self.stages.repairs += begin.elapsed().as_secs_f64();
        }
        match result {
            Ok(()) => self.candidates.advance(step.h),
            // The gaps are those at an end that the step does not reach.
            Err(_) => self.candidates.forget_gaps(),
        }
        result
    }

    /// The candidates that are not free, at the first test of this step, in order.
    fn check_all(&mut self, start: &[DVec3], end: &[DVec3]) -> Vec<usize> {
        let Self {
            candidates,
            settings,
            exempt,
            error,
            level,
            ..
        } = self;
        let separations = Separations::new(settings, exempt);
        let mut looked_at = LookedAt::default();
        let (path, error) = ([start, end], *error);
        parallel::map_chunks(
            &mut candidates.list,
            |first, pairs, looked_at: &mut LookedAt| {
                let mut unsettled = Unsettled::new(*level, path, error);
                for place in 0..pairs.len() {
                    let pair = &mut pairs[place];
                    let Some(separation) = separations.of(pair) else {
                        pair.forget_gap();
                        continue;
                    };
                    if pair.stays_apart(end, separation, error) {
                        continue;
                    }
                    looked_at.count += 1;
                    if pair.keeps_apart_as_before(path, separation, error) {
                        continue;
                    }
                    let kind = pair.kind;
                    if !unsettled.has_room_for(kind, pairs) {
                        unsettled.settle(pairs, |place| looked_at.open.push(first + place));
                    }
                    unsettled.pairs.push((place, separation));
                }
                unsettled.settle(pairs, |place| looked_at.open.push(first + place));
            },
            &mut looked_at,
            |all, own| {
                all.count += own.count;
                all.open.extend(own.open);
            },
        );
        self.counts.looked_at += looked_at.count;
        looked_at.open
    }

    /// The candidates that are not free after some vertices have moved (`self.moved`), of those in `open` and those of the
    /// vertices. Clears the marks.
    pub(super) fn check_moved(&mut self, open: &[usize], step: &TimeStep<'_>, end: &[DVec3]) -> Vec<usize> {
        let start = step.start;
        let strayed = self.candidates.find_strayed([start, end], step.h);
        let mut open = open.to_vec();
        let are_listed = strayed == 0 || self.add_candidates_of_strayed(strayed, &mut open, [start, end], step.h);
        if !are_listed {
            self.candidates.forget_gaps();
            self.candidates.find(start, end, step.h);
        }
        // Moved vertices may be farther out than any before.
        self.error = self.error.larger(gap_error(&self.candidates, [start, end]));
        if !are_listed {
            self.moved.fill(false);
            return self.check_all(start, end);
        }
        let Self {
            candidates,
            settings,
            exempt,
            error,
            moved,
            places,
            ..
        } = self;
        candidates.find_places(moved, places);
        moved.fill(false);
        // Most of the open candidates have a vertex that has moved.
        open.retain(|index| places.binary_search(index).is_err());
        if !open.is_empty() {
            places.extend(open);
            places.sort();
        }
        let separations = Separations::new(settings, exempt);
        let mut still_open = Vec::new();
        for &index in &*places {
            let pair = &mut candidates.list[index];
            let Some(separation) = separations.of(pair) else {
                continue;
            };
            // The stored direction was valid for the way to the earlier positions: its gap at the start is large enough.
            if pair.stays_apart(end, separation, *error) {
                continue;
            }
            if !keeps_separation(pair, [start, end], separation, *error) {
                still_open.push(index);
            }
        }
        still_open
    }

    /// Adds the candidates of vertices that have strayed during repairs, and updates `open` so that it means the same pairs as
    /// before. Returns whether that was possible: it is not if many have strayed, or the motion has ended.
    fn add_candidates_of_strayed(&mut self, strayed: usize, open: &mut [usize], motion: [&[DVec3]; 2], h: f64) -> bool {
        let keys: Vec<_> = open.iter().map(|&index| self.candidates.list[index].key()).collect();
        if !self.candidates.add_of_strayed(strayed, motion, h) {
            return false;
        }
        // New candidates have a vertex that has strayed.
        let all = self.moved.iter_mut().zip(self.candidates.strayed());
        all.for_each(|(moved, &strayed)| *moved |= strayed);
        for (index, key) in open.iter_mut().zip(keys) {
            *index = self.candidates.place_of(key).expect("what was there still is");
        }
        true
    }

    /// Moves `end` until all pairs are free; `open` are those that are not.
    fn repair(
        &mut self,
        open: Vec<usize>,
        step: &TimeStep<'_>,
        end: &mut [DVec3],
        bodies: &mut [RigidMotion],
    ) -> Result<(), Blocker> {
        let open = self.relax(open, EFFORT, step, end);
        if open.is_empty() {
            return Ok(());
        }
        let (wanted, wanted_bodies) = (end.to_vec(), bodies.to_vec());
        let wanted = (&wanted[..], &wanted_bodies[..]);
        self.find_base(open, step, wanted, (end, bodies))?;
        self.truncate(step, wanted, (end, bodies))
    }

    /// Relaxes `end`, for which the pairs in `open` are not free; returns the pairs that are not free afterwards.
    pub(super) fn relax(&mut self, mut open: Vec<usize>, effort: Effort, step: &TimeStep<'_>, end: &mut [DVec3]) -> Vec<usize> {
        self.relaxation.reset();
        for _ in 0..effort.closures {
            if open.is_empty() {
                break;
            }
            for &index in &open {
                let pair = &self.candidates.list[index];
                let kept = self.kept(pair, step.start);
                self.relaxation.add(pair, kept, step);
            }
            let are_kept = self.relaxation.relax(effort.rounds, step, end, &mut self.moved);
            open = self.check_moved(&open, step, end);
            if effort.gives_up && !are_kept {
                break;
            }
        }
        open
    }

    /// The pair to report if the step cannot be made: the first one that touches a body or a pin.
    pub(super) fn blocker(&self, open: &[usize], step: &TimeStep<'_>) -> Blocker {
        let is_kinematic = |pair: &Candidate| pair.vertices.iter().any(|&v| self.carriers[v as usize] != FREE);
        let first = open.iter().find(|&&index| is_kinematic(&self.candidates.list[index]));
        let index = first.or(open.first()).copied().unwrap_or_default();
        let pair = &self.candidates.list[index];
        Blocker {
            time: step.time,
            kind: pair.kind,
            vertices: pair.vertices,
            body: pair.data.is_with_body().then_some(pair.data.body as usize),
        }
    }

    /// The distance m_P that a pair keeps.
    pub(super) fn kept(&self, pair: &Candidate, start: &[DVec3]) -> f64 {
        kept(pair, start, self.separation(pair).unwrap_or(0.0), self.error)
    }

    pub(super) fn separation(&self, pair: &Candidate) -> Option<f64> {
        Separations::new(&self.settings, &self.exempt).of(pair)
    }
}

/// The result of a test of pairs that their stored directions did not decide.
#[derive(Default)]
struct LookedAt {
    count: u64,
    /// The pairs that are not free.
    open: Vec<usize>,
}

/// Up to sixteen pairs of one kind for which no stored direction proves that they stay apart. Their next direction is that of
/// their closest points, found for all at once.
struct Unsettled<'a> {
    level: Level,
    path: [&'a [DVec3]; 2],
    error: GapError<f64>,
    /// The place of each, and its separation.
    pairs: Vec<(usize, f64)>,
    closest: ClosestOfSome,
}

impl<'a> Unsettled<'a> {
    fn new(level: Level, path: [&'a [DVec3]; 2], error: GapError<f64>) -> Self {
        Self {
            level,
            path,
            error,
            pairs: Vec::new(),
            closest: ClosestOfSome::default(),
        }
    }

    fn has_room_for(&self, kind: PairKind, all: &[Candidate]) -> bool {
        self.pairs.len() < LANES && self.pairs.last().is_none_or(|&(place, _)| all[place].kind == kind)
    }

    /// Tests which of the pairs are free, passes the places of the others to `tell`, in order, and removes all pairs.
    fn settle(&mut self, all: &mut [Candidate], mut tell: impl FnMut(usize)) {
        let (path, error) = (self.path, self.error);
        let pairs = self.pairs.iter().map(|&(place, _)| &all[place]);
        let closest = self.closest.find(self.level, pairs, path[1]);
        for ((place, separation), closest) in self.pairs.drain(..).zip(closest) {
            let pair = &mut all[place];
            let is_free = pair.keeps_apart_along(closest.direction, path, separation, error)
                || keeps_separation_by_time(pair, path, separation, error);
            if !is_free {
                tell(place);
            }
        }
    }
}

/// Returns whether the pair keeps its separation, or a reduced one if it starts nearer.
pub(super) fn keeps_separation(pair: &mut Candidate, path: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> bool {
    pair.keeps_apart(path, separation, error) || keeps_separation_by_time(pair, path, separation, error)
}

/// The result of [`keeps_separation`] for a pair that no direction keeps apart by its separation.
fn keeps_separation_by_time(pair: &mut Candidate, path: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> bool {
    if time_of_impact_of(pair, path, separation).is_none() {
        return true;
    }
    let kept = kept(pair, path[0], separation, error);
    kept < separation && (is_kept_along_start(pair, path, kept, error) || impact(pair, path, kept, error).is_none())
}

/// Returns whether the direction of the closest points at the start certainly keeps the pair more than `kept` apart on the way.
/// The gap along it is linear in time.
fn is_kept_along_start(pair: &Candidate, path: [&[DVec3]; 2], kept: f64, error: GapError<f64>) -> bool {
    let direction = pair.closest(path[0]).direction;
    let bound = |positions| distance_from_below(pair.kind, pair.points(positions), direction, error);
    path.into_iter().all(|positions| bound(positions) > kept)
}

/// The distance m_P that a pair keeps.
fn kept(pair: &Candidate, start: &[DVec3], separation: f64, error: GapError<f64>) -> f64 {
    kept_when_carried(separation, pair.distance_from_below(start, error), error)
}
