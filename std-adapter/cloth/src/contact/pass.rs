//! The certified pass: a step is accepted only when every candidate pair provably keeps its separation throughout.
//!
//! ```text
//! wanted motion ─▶ candidates ─▶ each free? ─▶ A: project what is not, at most three rounds ─▶ B: zones ─▶ accepted
//!                                                                                              └▶ cut: half the step
//! ```
//!
//! **What is kept.** A pair keeps m_P = min(m, c·d_P), m the separation asked for and d_P its distance at the start: so a pair
//! that starts nearer than m may stay, and a zone that is carried rigidly is free: translations change no distance, and a frame
//! that turns by θ shrinks distances on the straight paths of its points by cos(θ/2) at most, which [`LARGEST_TURN`] keeps above
//! c. The margin 1 − c = 10⁻⁵ is far above all rounding.
//!
//! **It ends.** Each pair that is not free merges zones, gives a zone a frame, raises a zone's level, or cuts the step; there are
//! finitely many of each. [`ROUNDS`] is for certainty.
//!
//! **Candidates** are found for several steps at once ([`horizon`](super::horizon)): whatever is none keeps, along a direction d of length one,
//! h + b·(|d₁| + |d₂| + |d₃|), h the thickness and b what is looked for beyond it ([`sieve`](super::sieve)). While no vertex strays from the
//! motion they were found for by more than b/2 along any axis, they hold every pair within h; while repairs take none farther than
//! b/2 + (h − m)/(2√3), which along d is at most half of b·(|d₁| + |d₂| + |d₃|) + h − m, every pair that may come within m. If few stray
//! farther, the candidates of these are found again and added; else all are found anew.

use super::pair::Pair;
use super::zones::{Cut, Motions};
use super::{Blocker, Contact, ContactSettings};
use crate::plan::{FREE, Frame, StepInput};
use selvedge::PairKind;
use selvedge::verification::parallel;
use selvedge_core::Lanes;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::gap::GapError;
use selvedge_core::separation::largest_coordinate;
use std::time::Instant;

/// c of the module.
const KEPT: f64 = 1.0 - 1e-5;
/// The largest turn of a body in one step, in radians: cos(θ/2) ≥ 1 − θ²/8 ≥ 1 − ½·10⁻⁵.
pub(crate) const LARGEST_TURN: f64 = 6.3e-3;
/// More than any step has taken.
const ROUNDS: usize = 300;
/// If one vertex in so many or more has strayed, all candidates are found anew.
const MANY: usize = 4;
/// Rounds of projection before zones.
const REPAIRS: usize = 3;
/// What a projection aims at, in separations that are kept.
const AIM: f64 = 1.05;

/// What one step's contacts were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ContactCounts {
    /// Pairs that moving boxes leave, as far as an effect asks for them.
    pub candidates: u64,
    /// Those that the direction remembered from the step before did not settle.
    pub looked_at: u64,
    /// Contacts that pushed.
    pub pushed: u64,
    /// Pairs that were not free on the motion that the solver wanted.
    pub violated: u64,
    /// Rounds with zones.
    pub zone_rounds: u64,
    /// Vertices that did not get all of their motion.
    pub held: u64,
    /// Times the step was cut in half.
    pub cuts: u64,
}

impl ContactCounts {
    /// Pairs that are left after each stage, in the order of the data flow.
    #[must_use]
    pub fn pairs(&self) -> [(&'static str, u64); 3] {
        [
            ("candidate pairs", self.candidates),
            ("not settled by remembered directions", self.looked_at),
            ("not free, repaired", self.violated),
        ]
    }

    /// What else happened.
    #[must_use]
    pub fn events(&self) -> [(&'static str, u64); 4] {
        [
            ("pairs pushed apart", self.pushed),
            ("rounds with zones", self.zone_rounds),
            ("vertices held", self.held),
            ("times cut in half", self.cuts),
        ]
    }
}

impl Contact {
    /// Turns the motion that is wanted, start to `end`, into one that is certainly free.
    ///
    /// # Errors
    /// If the step has to be cut; then nothing has changed but `end`.
    pub(crate) fn certify(&mut self, step: &StepInput<'_>, end: &mut [DVec3]) -> Result<(), Blocker> {
        let start = step.start;
        self.error = error(start, end);
        let begin = Instant::now();
        self.cover(start, end, step.h);
        self.stages.candidates += begin.elapsed().as_secs_f64();
        self.counts.candidates += self.pairs.len() as u64;

        let begin = Instant::now();
        let mut open = self.check_all(start, end);
        self.counts.violated += open.len() as u64;
        self.stages.certificates += begin.elapsed().as_secs_f64();
        let mut result = Ok(());
        if !open.is_empty() {
            let begin = Instant::now();
            for _ in 0..REPAIRS {
                self.project(&open, step, end);
                open = self.check_moved(&open, step, end);
                if open.is_empty() {
                    break;
                }
            }
            result = self.move_in_zones(open, step, end);
            self.stages.repairs += begin.elapsed().as_secs_f64();
        }
        match result {
            Ok(()) => self.horizon.advance(step.h),
            // They are of an end that is not reached.
            Err(_) => self.forget_gaps(),
        }
        result
    }

    /// Sees to it that the candidates are good for the step from `start` to `end`.
    fn cover(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        if !self.horizon.lasts(h) {
            return self.find_candidates(start, end, h);
        }
        let strayed = self.horizon.find_strayed(end, h, self.slack, &mut self.strayed);
        match strayed {
            0 => {}
            few if few < end.len() / MANY => {
                self.find_candidates_of_strayed(start, end, h);
            }
            _ => self.find_candidates(start, end, h),
        }
    }

    /// Adds the candidates that vertices have which have strayed. Returns whether it is so; else all were found anew.
    fn find_candidates_of_strayed(&mut self, start: &[DVec3], end: &[DVec3], h: f64) -> bool {
        let motion = self.horizon.lead_back(&self.strayed, start, end, h);
        let is_narrow = self.detector.candidates_of(&self.strayed, motion, &mut self.found);
        if is_narrow {
            add(&mut self.pairs, &mut self.found);
        } else {
            self.take_found();
        }
        is_narrow
    }

    /// Candidates for a motion.
    pub(super) fn find_candidates(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        let motion = self.horizon.begin(start, end, h, self.slack);
        self.detector.candidates(motion, &mut self.found);
        self.take_found();
    }

    /// Replaces the candidates by those that were found, with what is known of them.
    fn take_found(&mut self) {
        // Both lists ascend by key.
        let mut known = self.pairs.iter().peekable();
        for pair in &mut self.found {
            while known.next_if(|other| other.key < pair.key).is_some() {}
            if let Some(same) = known.next_if(|other| other.key == pair.key) {
                pair.remember(same);
            }
        }
        std::mem::swap(&mut self.pairs, &mut self.found);
    }

    fn forget_gaps(&mut self) {
        self.pairs.iter_mut().for_each(Pair::forget_gap);
    }

    /// The candidates that are not free, looked at for the first time in this step, in order.
    fn check_all(&mut self, start: &[DVec3], end: &[DVec3]) -> Vec<usize> {
        let Self {
            pairs,
            settings,
            yielding,
            error,
            ..
        } = self;
        let mut looked_at = LookedAt::default();
        parallel::map_chunks(
            pairs,
            |first, pairs, looked_at: &mut LookedAt| {
                for (index, pair) in pairs.iter_mut().enumerate() {
                    let Some(separation) = settings.separation(pair, yielding) else {
                        pair.forget_gap();
                        continue;
                    };
                    if pair.stays_apart(end, separation, *error) {
                        continue;
                    }
                    looked_at.count += 1;
                    if !is_free(pair, [start, end], separation, *error) {
                        looked_at.open.push(first + index);
                    }
                }
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

    /// The candidates that are not free after some vertices have moved (`self.moved`): of those in `open`, and those of the
    /// vertices. Clears the marks.
    fn check_moved(&mut self, open: &[usize], step: &StepInput<'_>, end: &[DVec3]) -> Vec<usize> {
        let start = step.start;
        // What was moved may be farther out than anything before.
        self.error = self.error.larger(error(start, end));
        let strayed = self.horizon.find_strayed(end, step.h, self.room, &mut self.strayed);
        let mut open = open.to_vec();
        if strayed > 0 && !self.add_candidates_of_strayed(strayed, &mut open, [start, end], step.h) {
            self.forget_gaps();
            self.find_candidates(start, end, step.h);
            self.moved.fill(false);
            return self.check_all(start, end);
        }
        let mut still_open = Vec::new();
        let mut was_open = open.iter().copied().peekable();
        for index in 0..self.pairs.len() {
            let was_open = was_open.next_if_eq(&index).is_some();
            let touched = self.pairs[index].vertices.iter().any(|&v| self.moved[v as usize]);
            if !(was_open || touched) {
                continue;
            }
            let Some(separation) = self.separation(&self.pairs[index]) else {
                continue;
            };
            if !is_free(&mut self.pairs[index], [start, end], separation, self.error) {
                still_open.push(index);
            }
        }
        self.moved.fill(false);
        still_open
    }

    /// Adds the candidates of vertices that have strayed in the course of repairs, and lets `open` name the same pairs as before.
    /// Returns whether that was possible: not if many have strayed, or the motion has ended.
    fn add_candidates_of_strayed(&mut self, strayed: usize, open: &mut [usize], [start, end]: [&[DVec3]; 2], h: f64) -> bool {
        if strayed >= end.len() / MANY || !self.horizon.lasts(h) {
            return false;
        }
        let keys: Vec<u64> = open.iter().map(|&index| self.pairs[index].key).collect();
        if !self.find_candidates_of_strayed(start, end, h) {
            return false;
        }
        // What is new has a vertex that has strayed.
        let all = self.moved.iter_mut().zip(&self.strayed);
        all.for_each(|(moved, &strayed)| *moved |= strayed);
        for (index, key) in open.iter_mut().zip(keys) {
            // Those that were there still are.
            *index = self.pairs.partition_point(|pair| pair.key < key);
        }
        true
    }

    /// Projects each open pair, in order, to a little more than the separation that it keeps.
    fn project(&mut self, open: &[usize], step: &StepInput<'_>, end: &mut [DVec3]) {
        for &index in open {
            let pair = &self.pairs[index];
            let Some(separation) = self.separation(pair) else {
                continue;
            };
            let closest = pair.closest(step.start);
            let mut missing = AIM * kept(pair, step.start, separation, self.error);
            let mut mobility = 0.0;
            for (vertex, weight) in pair.vertices.into_iter().zip(closest.weights) {
                let vertex = vertex as usize;
                missing -= weight * closest.direction.dot(end[vertex]);
                mobility += weight * weight * step.inverse_masses[vertex];
            }
            if !(missing > 0.0 && mobility > 0.0) {
                continue;
            }
            let along = closest.direction * (missing / mobility);
            for (vertex, weight) in pair.vertices.into_iter().zip(closest.weights) {
                let vertex = vertex as usize;
                if step.inverse_masses[vertex] > 0.0 {
                    end[vertex] += along * (weight * step.inverse_masses[vertex]);
                    self.moved[vertex] = true;
                }
            }
        }
    }

    fn move_in_zones(&mut self, mut open: Vec<usize>, step: &StepInput<'_>, end: &mut [DVec3]) -> Result<(), Blocker> {
        if open.is_empty() {
            return Ok(());
        }
        let wanted = end.to_vec();
        let frames = self.frames_of_the_step(step);
        let carry = |frame: Frame, point: DVec3| {
            let [before, now] = &step.poses[frame as usize];
            before.carry(now, point)
        };
        let mut scratch = Vec::new();
        let mut before = Vec::new();
        self.zones.reset(end.len());
        for _ in 0..ROUNDS {
            self.counts.zone_rounds += 1;
            let pairs: Vec<&Pair> = open.iter().map(|&index| &self.pairs[index]).collect();
            let (error, start) = (self.error, step.start);
            let settings = &self.settings;
            let separation = |pair: &Pair| {
                let asked = settings.of(pair).map_or(0.0, |thickness| thickness.separation);
                kept(pair, start, asked, error)
            };
            let motions = Motions {
                start,
                wanted: &wanted,
                inverse_masses: step.inverse_masses,
                frames: &frames,
                carry: &carry,
            };
            before.clear();
            before.extend_from_slice(end);
            let resolved = self.zones.resolve(&pairs, separation, motions, end, &mut scratch);
            if let Err(Cut) = resolved {
                return Err(self.blocker(&open, step));
            }
            for vertex in 0..end.len() {
                self.moved[vertex] = end[vertex] != before[vertex];
            }
            open = self.check_moved(&open, step, end);
            if open.is_empty() {
                self.counts.held += self.zones.held() as u64;
                return Ok(());
            }
        }
        Err(self.blocker(&open, step))
    }

    /// Each vertex's frame, those that rest in this step taken for one: a zone may touch any number of them.
    fn frames_of_the_step(&self, step: &StepInput<'_>) -> Vec<Frame> {
        let rests = |frame: usize| step.poses[frame][0] == step.poses[frame][1];
        let first_at_rest = (0..step.poses.len()).find(|&frame| rests(frame));
        let merged = |&carrier: &Frame| match first_at_rest {
            Some(first) if carrier != FREE && rests(carrier as usize) => first as Frame,
            _ => carrier,
        };
        self.carriers.iter().map(merged).collect()
    }

    /// Whom to name when the step cannot be made: the first pair that touches a body or a pin.
    fn blocker(&self, open: &[usize], step: &StepInput<'_>) -> Blocker {
        let prescribed = |pair: &Pair| pair.vertices.iter().any(|&v| self.carriers[v as usize] != FREE);
        let first = open.iter().find(|&&index| prescribed(&self.pairs[index]));
        let index = first.or(open.first()).copied().unwrap_or_default();
        let pair = &self.pairs[index];
        Blocker {
            time: step.time,
            kind: pair.kind,
            vertices: pair.vertices,
            body: (pair.body != FREE).then_some(pair.body as usize),
        }
    }

    fn separation(&self, pair: &Pair) -> Option<f64> {
        self.settings.separation(pair, &self.yielding)
    }
}

impl ContactSettings {
    /// The separation that a pair is asked to keep; `None` if none is promised.
    fn separation(&self, pair: &Pair, yielding: &[bool]) -> Option<f64> {
        if pair.is_with_body() && yielding[pair.body as usize] {
            return None;
        }
        self.of(pair).map(|thickness| thickness.separation)
    }
}

/// Adds to `pairs` those of `found` that are not there yet. Both ascend by key, and do so afterwards.
fn add(pairs: &mut Vec<Pair>, found: &mut Vec<Pair>) {
    found.retain(|new| pairs.binary_search_by_key(&new.key, |known| known.key).is_err());
    // From the end, so that every pair is moved at most once, and those before the first new one not at all.
    let mut known = pairs.len();
    pairs.extend_from_slice(found);
    while let Some(&new) = found.last() {
        let place = known + found.len() - 1;
        if known > 0 && pairs[known - 1].key > new.key {
            known -= 1;
            pairs[place] = pairs[known];
        } else {
            pairs[place] = new;
            found.pop();
        }
    }
}

/// What came of looking at pairs that their remembered directions did not settle.
#[derive(Default)]
struct LookedAt {
    count: u64,
    /// Those that are not free.
    open: Vec<usize>,
}

/// Whether the pair keeps its separation, or what is left of it.
fn is_free(pair: &mut Pair, path: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> bool {
    if pair.impact(path, separation, error).is_none() {
        return true;
    }
    let kept = kept(pair, path[0], separation, error);
    kept < separation && pair.impact(path, kept, error).is_none()
}

/// m_P of the module.
fn kept(pair: &Pair, start: &[DVec3], separation: f64, error: GapError<f64>) -> f64 {
    separation.min(KEPT * pair.distance_from_below(start, error))
}

/// Of gaps between these positions.
pub(super) fn error(start: &[DVec3], end: &[DVec3]) -> GapError<f64> {
    GapError::of_coordinates(largest_coordinate(start).larger(largest_coordinate(end)))
}

/// `the vertex-face pair of vertices 1, 2, 3, 4`.
pub(super) fn described(kind: PairKind, vertices: [u32; 4]) -> String {
    let [a, b, c, d] = vertices;
    format!("the {kind} pair of vertices {a}, {b}, {c}, {d}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn pairs(keys: &std::collections::BTreeSet<u64>, body: Frame) -> Vec<Pair> {
        let pair = |&key: &u64| Pair::new(key, PairKind::EdgeEdge, [0; 4], body);
        keys.iter().map(pair).collect()
    }

    proptest! {
        #[test]
        fn what_is_new_is_added_in_order_and_what_is_known_stays(
            known in prop::collection::btree_set(0..60_u64, 0..30),
            found in prop::collection::btree_set(0..60_u64, 0..30),
        ) {
            let mut all = pairs(&known, 1);
            add(&mut all, &mut pairs(&found, 2));
            let keys: Vec<_> = all.iter().map(|pair| pair.key).collect();
            prop_assert_eq!(keys, known.union(&found).copied().collect::<Vec<_>>());
            prop_assert!(all.iter().all(|pair| (pair.body == 1) == known.contains(&pair.key)));
        }
    }
}
