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
//! **Candidates.** Vertices have room around their paths' boxes. Whatever a repair moves beyond that room has its box enlarged, and
//! candidates are found anew.

use super::detect::Counts;
use super::pair::{Pair, rounding_error};
use super::zones::{Cut, Motions};
use super::{Blocker, Contact};
use crate::PairKind;
use crate::simulation::plan::{FREE, Frame, StepInput};
use selvedge_core::boxes::Aabb;
use selvedge_core::glam::DVec3;
use std::time::Instant;

/// c of the module.
const KEPT: f64 = 1.0 - 1e-5;
/// The largest turn of a body in one step, in radians: cos(θ/2) ≥ 1 − θ²/8 ≥ 1 − ½·10⁻⁵.
pub(crate) const LARGEST_TURN: f64 = 6.3e-3;
/// More than any step has taken.
const ROUNDS: usize = 300;
/// Rounds of projection before zones.
const REPAIRS: usize = 3;
/// What a projection aims at, in separations.
const AIM: f64 = 1.05;

/// What one step's contacts were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ContactCounts {
    /// Candidate triangle pairs.
    pub triangle_pairs: u64,
    /// Primitive pairs distributed from them.
    pub primitive_pairs: u64,
    /// Primitive pairs whose own boxes overlap.
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
    /// Adds another step's.
    pub fn add(&mut self, other: &Self) {
        self.triangle_pairs += other.triangle_pairs;
        self.primitive_pairs += other.primitive_pairs;
        self.candidates += other.candidates;
        self.looked_at += other.looked_at;
        self.pushed += other.pushed;
        self.violated += other.violated;
        self.zone_rounds += other.zone_rounds;
        self.held += other.held;
        self.cuts += other.cuts;
    }
}

impl Contact {
    /// Turns the motion that is wanted, start to `end`, into one that is certainly free.
    ///
    /// # Errors
    /// If the step has to be cut; then nothing has changed but `end`.
    pub(crate) fn certify(
        &mut self,
        step: &StepInput<'_>,
        end: &mut [DVec3],
    ) -> Result<(), Blocker> {
        let start = step.start;
        self.error = rounding_error(largest(start).max(largest(end)));
        let begin = Instant::now();
        let paths = start.iter().zip(end.iter());
        self.paths.clear();
        self.paths
            .extend(paths.map(|(&a, &b)| bounds(a.min(b), a.max(b))));
        self.find_candidates();
        self.stages.candidates += begin.elapsed().as_secs_f64();

        let begin = Instant::now();
        let mut open = self.check_all(start, end);
        self.counts.violated += open.len() as u64;
        self.stages.certificates += begin.elapsed().as_secs_f64();
        if open.is_empty() {
            std::mem::swap(&mut self.pairs, &mut self.next);
            return Ok(());
        }
        let begin = Instant::now();
        for _ in 0..REPAIRS {
            self.project(&open, step, end);
            open = self.check_moved(&open, start, end);
            if open.is_empty() {
                break;
            }
        }
        let result = self.move_in_zones(open, step, end);
        self.stages.repairs += begin.elapsed().as_secs_f64();
        result?;
        std::mem::swap(&mut self.pairs, &mut self.next);
        Ok(())
    }

    /// Candidates for vertices that stay within their paths' boxes and the room around them.
    pub(super) fn find_candidates(&mut self) {
        let room = DVec3::splat(self.reach);
        self.boxes.clear();
        let widened = self.paths.iter().map(|path| {
            let [lower, upper] = corners(path);
            bounds(lower - room, upper + room)
        });
        self.boxes.extend(widened);
        let Counts {
            triangle_pairs,
            primitive_pairs,
            candidates,
        } = self.detector.candidates(&self.boxes, &mut self.next);
        self.counts.triangle_pairs += triangle_pairs;
        self.counts.primitive_pairs += primitive_pairs;
        self.counts.candidates += candidates;
        // Both lists ascend by key.
        let mut known = self.pairs.iter().peekable();
        for pair in &mut self.next {
            while known.next_if(|other| other.key < pair.key).is_some() {}
            if let Some(same) = known.next_if(|other| other.key == pair.key) {
                pair.remember(same);
            }
        }
    }

    /// The candidates that are not free, looked at for the first time in this step.
    fn check_all(&mut self, start: &[DVec3], end: &[DVec3]) -> Vec<usize> {
        let mut open = Vec::new();
        let mut looked_at = 0;
        for index in 0..self.next.len() {
            let Some(separation) = self.separation(&self.next[index]) else {
                self.next[index].gap = f32::NEG_INFINITY;
                continue;
            };
            let pair = &mut self.next[index];
            if pair.stays_apart(end, separation, self.error) {
                continue;
            }
            looked_at += 1;
            if !is_free(pair, [start, end], separation, self.error) {
                open.push(index);
            }
        }
        self.counts.looked_at += looked_at;
        open
    }

    /// The candidates that are not free after some vertices have moved (`self.moved`): of those in `open`, and those of the
    /// vertices. Clears the marks.
    fn check_moved(&mut self, open: &[usize], start: &[DVec3], end: &[DVec3]) -> Vec<usize> {
        if self.grow_boxes(end) {
            self.find_candidates();
            self.moved.fill(false);
            return self.check_all(start, end);
        }
        let mut still_open = Vec::new();
        let mut was_open = open.iter().copied().peekable();
        for index in 0..self.next.len() {
            let was_open = was_open.next_if_eq(&index).is_some();
            let touched = self.next[index]
                .vertices
                .iter()
                .any(|&v| self.moved[v as usize]);
            if !(was_open || touched) {
                continue;
            }
            let Some(separation) = self.separation(&self.next[index]) else {
                continue;
            };
            if !is_free(&mut self.next[index], [start, end], separation, self.error) {
                still_open.push(index);
            }
        }
        self.moved.fill(false);
        still_open
    }

    /// Makes room for vertices that have moved out of it; whether there were any.
    fn grow_boxes(&mut self, end: &[DVec3]) -> bool {
        let mut grown = false;
        for (vertex, path) in self.paths.iter_mut().enumerate() {
            if !self.moved[vertex] {
                continue;
            }
            let [lower, upper] = corners(path);
            let room = DVec3::splat(self.room);
            let position = end[vertex];
            if !(position.cmpge(lower - room).all() && position.cmple(upper + room).all()) {
                *path = bounds(lower.min(position), upper.max(position));
                grown = true;
            }
        }
        grown
    }

    /// Projects each open pair, in order, to a little more than its separation.
    fn project(&mut self, open: &[usize], step: &StepInput<'_>, end: &mut [DVec3]) {
        for &index in open {
            let pair = &self.next[index];
            let Some(separation) = self.separation(pair) else {
                continue;
            };
            let closest = pair.closest(step.start);
            let mut missing = AIM * separation;
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

    fn move_in_zones(
        &mut self,
        mut open: Vec<usize>,
        step: &StepInput<'_>,
        end: &mut [DVec3],
    ) -> Result<(), Blocker> {
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
            let pairs: Vec<&Pair> = open.iter().map(|&index| &self.next[index]).collect();
            let (error, start) = (self.error, step.start);
            let settings = &self.settings;
            let separation = |pair: &Pair| {
                let asked = settings
                    .of(pair)
                    .map_or(0.0, |thickness| thickness.separation);
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
            let resolved = self
                .zones
                .resolve(&pairs, separation, motions, end, &mut scratch);
            if let Err(Cut) = resolved {
                return Err(self.blocker(&open, step));
            }
            for vertex in 0..end.len() {
                self.moved[vertex] = end[vertex] != before[vertex];
            }
            open = self.check_moved(&open, start, end);
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
        let prescribed = |pair: &Pair| {
            pair.vertices
                .iter()
                .any(|&v| self.carriers[v as usize] != FREE)
        };
        let first = open.iter().find(|&&index| prescribed(&self.next[index]));
        let index = first.or(open.first()).copied().unwrap_or_default();
        let pair = &self.next[index];
        Blocker {
            time: step.time,
            kind: pair.kind,
            vertices: pair.vertices,
            body: (pair.body != FREE).then_some(pair.body as usize),
        }
    }

    /// The separation that a pair is asked to keep; `None` if none is promised.
    fn separation(&self, pair: &Pair) -> Option<f64> {
        if pair.is_with_body() && self.yielding[pair.body as usize] {
            return None;
        }
        self.settings.of(pair).map(|thickness| thickness.separation)
    }
}

/// Whether the pair keeps its separation, or what is left of it.
fn is_free(pair: &mut Pair, path: [&[DVec3]; 2], separation: f64, error: f64) -> bool {
    if pair.impact(path, separation, error).is_none() {
        return true;
    }
    let kept = kept(pair, path[0], separation, error);
    kept < separation && pair.impact(path, kept, error).is_none()
}

/// m_P of the module.
fn kept(pair: &Pair, start: &[DVec3], separation: f64, error: f64) -> f64 {
    separation.min(KEPT * pair.distance_from_below(start, error))
}

fn largest(positions: &[DVec3]) -> f64 {
    positions
        .iter()
        .fold(0.0, |largest: f64, p| largest.max(p.abs().max_element()))
}

fn bounds(lower: DVec3, upper: DVec3) -> Aabb<f64> {
    Aabb {
        lower: lower.to_array(),
        upper: upper.to_array(),
    }
}

fn corners(bounds: &Aabb<f64>) -> [DVec3; 2] {
    [bounds.lower, bounds.upper].map(DVec3::from_array)
}

/// `vertex-face pair of vertices 1, 2, 3, 4`.
pub(super) fn described(kind: PairKind, vertices: [u32; 4]) -> String {
    let [a, b, c, d] = vertices;
    format!("the {kind} pair of vertices {a}, {b}, {c}, {d}")
}
