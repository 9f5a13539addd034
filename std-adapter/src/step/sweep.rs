//! The stages after the broad phase, on a chunk of pairs that stays in a core's own cache.
//!
//! ```text
//! candidates       positions in the hierarchies, or a caller's own pairs
//!   │  filter      certified non-coplanarity, sixteen pairs at a time
//!   ▼
//! open pairs       chunk by chunk
//!   │  sweeps      one round of advancing for all that are open, again and again; f32 where positions are f32
//!   │  f64 sweeps  for f32 positions, which f64 holds exactly: those that f32 cannot decide
//!   │  one by one  the few that lanes cannot decide, or that are still open then; exact verdicts, if asked for
//!   ▼
//! contacts         in the order of the candidates
//! ```
//!
//! In f32 a pair's distance is lost in rounding errors at 2⁻⁹ of its size (`closest.rs` of the core), long before it is within
//! the tolerance. The first rounds need no more digits than that and have twice the lanes; f64 then goes on
//! from the time reached, with all that is proven in f64 true of the same positions.

use super::{Bound, Contact, Question, Wanted};
use crate::PairKind;
use crate::broad_phase::moving::{CHUNK, Hierarchies, Sink};
use crate::dispatch::Level;
use crate::mesh::Topology;
use crate::pair_kind::PairCounts;
use selvedge_core::batch::{
    LANES, Mask, Round, RoundQuestion, VertexRow, advance_from_rows, culled_from_rows,
};
use selvedge_core::elementary::advance::time_of_impact_within;
use selvedge_core::elementary::contact::settled;
use selvedge_core::elementary::{Contact as Verdict, Impact, Limits, Reason};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::points::Shape;
use selvedge_core::{EdgeEdge, Motion, Scalar, VertexFace};
use std::time::{Duration, Instant};

/// So many sweeps, then one by one. Measured on cloth-ball: 5 sweeps take 20 ms more than 16, of 60; 12 take 2 more.
const SWEEPS: usize = 16;

/// The first sweep that asks the signed volume as well: from the second on takes 7 ms more, from the third 1.
const VOLUME_SWEEP: usize = 3;

/// So many sweeps in f32 for f32 positions.
const NARROW_SWEEPS: usize = 3;

/// Whose numbers pairs have.
#[derive(Clone, Copy)]
pub(super) enum Numbers<'a, S: Scalar> {
    /// Positions in the hierarchies.
    Positions(&'a Hierarchies<S>),
    /// The mesh's own.
    Mesh(&'a Topology),
}

impl<S: Scalar> Numbers<'_, S> {
    /// The rows of a pair's vertices.
    #[inline(always)]
    fn vertices(&self, kind: PairKind, pair: [u32; 2]) -> [u32; 4] {
        match self {
            Self::Positions(hierarchies) => hierarchies.vertices(kind, pair),
            Self::Mesh(topology) => kind.vertices(pair, topology),
        }
    }

    fn in_mesh(&self, kind: PairKind, pair: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Positions(hierarchies) => hierarchies.in_mesh(kind, pair),
            Self::Mesh(_) => pair,
        }
    }
}

/// What all chunks of a step read.
#[derive(Clone, Copy)]
pub(super) struct StepInput<'a, S: Scalar> {
    pub(super) level: Level,
    pub(super) numbers: Numbers<'a, S>,
    pub(super) rows: &'a [VertexRow<S>],
    /// The same in f64, for narrower formats; else none.
    pub(super) wide_rows: &'a [VertexRow<f64>],
    pub(super) question: Question<S>,
    /// The earliest contact so far, of all threads.
    pub(super) bound: &'a Bound,
}

/// What was counted and how long it took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub(super) candidates: PairCounts,
    pub(super) filtered: PairCounts,
    pub(super) filter_time: Duration,
    pub(super) elementary_time: Duration,
}

/// What a share of the work has found.
#[derive(Debug)]
pub(super) struct Found<S> {
    pub(super) contacts: Vec<Contact<S>>,
    /// The pairs that the filter has kept, as the mesh numbers them, if they are wanted.
    pub(super) kept: Vec<[u32; 2]>,
    pub(super) tally: Tally,
}

impl<S> Found<S> {
    pub(super) const fn nothing() -> Self {
        Self {
            contacts: Vec::new(),
            kept: Vec::new(),
            tally: Tally {
                candidates: PairCounts::NONE,
                filtered: PairCounts::NONE,
                filter_time: Duration::ZERO,
                elementary_time: Duration::ZERO,
            },
        }
    }

    /// Forgets the step before.
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.kept.clear();
        self.tally = Tally::default();
    }
}

/// One thread's chunk.
#[derive(Debug)]
pub(super) struct Chunk<S> {
    /// Pairs that the filter has kept, and the rows of their vertices.
    pairs: Vec<[u32; 2]>,
    indices: Vec<[u32; 4]>,
    masks: Vec<Mask>,
    open: Open<S>,
    /// Of narrower formats: those that f64 must decide.
    wide: Open<f64>,
    /// When contact is not excluded, for each of `pairs`.
    impacts: Vec<Option<S>>,
}

/// Pairs that are neither excluded nor near yet.
#[derive(Debug)]
struct Open<S> {
    /// Which of the chunk's pairs it is.
    places: Vec<u32>,
    /// The rows of its vertices.
    indices: Vec<[u32; 4]>,
    /// Up to when it is proven to be apart.
    times: Vec<S>,
    rounds: Vec<Round>,
    /// Pairs that the last sweep has found near, or could not advance.
    left: Vec<Left<S>>,
}

/// A pair that is not advanced any more.
#[derive(Clone, Copy, Debug)]
struct Left<S> {
    place: u32,
    indices: [u32; 4],
    time: S,
    is_near: bool,
}

impl<S: Scalar> Open<S> {
    fn new() -> Self {
        Self {
            places: Vec::with_capacity(MOST),
            indices: Vec::with_capacity(MOST),
            times: Vec::with_capacity(MOST),
            rounds: Vec::with_capacity(MOST.div_ceil(LANES)),
            left: Vec::with_capacity(MOST),
        }
    }

    fn clear(&mut self) {
        self.places.clear();
        self.indices.clear();
        self.times.clear();
    }

    fn push(&mut self, place: u32, indices: [u32; 4], time: S) {
        self.places.push(place);
        self.indices.push(indices);
        self.times.push(time);
    }

    /// One round for all; those that it decides are open no more.
    fn sweep(
        &mut self,
        level: Level,
        kind: PairKind,
        rows: &[VertexRow<S>],
        question: &RoundQuestion<S>,
    ) {
        let open = self.places.len();
        self.rounds.clear();
        self.rounds.resize(open.div_ceil(LANES), Round::default());
        advance_from_rows(
            level,
            shape(kind),
            question,
            rows,
            &self.indices,
            &mut self.times,
            &mut self.rounds,
        );
        self.left.clear();
        let mut kept = 0;
        for (first, round) in (0..).step_by(LANES).zip(&self.rounds) {
            let mut left = round.near | round.stuck;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                let index = first + lane;
                if index < open {
                    self.left.push(Left {
                        place: self.places[index],
                        indices: self.indices[index],
                        time: self.times[index],
                        is_near: round.near >> lane & 1 != 0,
                    });
                }
            }
            let closed = round.apart | round.near | round.stuck;
            for index in first..open.min(first + LANES) {
                self.places[kept] = self.places[index];
                self.indices[kept] = self.indices[index];
                self.times[kept] = self.times[index];
                kept += usize::from(closed >> (index - first) & 1 == 0);
            }
        }
        self.places.truncate(kept);
        self.indices.truncate(kept);
        self.times.truncate(kept);
    }
}

/// A chunk is swept when there are as many pairs as one visit brings, so there are never twice as many.
const MOST: usize = 3 * CHUNK;

impl<S: Scalar> Chunk<S> {
    pub(super) fn new() -> Self {
        Self {
            pairs: Vec::with_capacity(MOST),
            indices: Vec::with_capacity(MOST),
            masks: Vec::with_capacity(MOST.div_ceil(LANES)),
            open: Open::new(),
            wide: Open::new(),
            impacts: Vec::with_capacity(MOST),
        }
    }

    /// Forgets what was left when a traversal ended early.
    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.indices.clear();
    }

    /// Takes candidates. Returns whether to go on.
    pub(super) fn take(
        &mut self,
        step: &StepInput<'_, S>,
        kind: PairKind,
        candidates: &[[u32; 2]],
        found: &mut Found<S>,
    ) -> bool {
        let begin = Instant::now();
        let first = self.pairs.len();
        self.pairs.extend_from_slice(candidates);
        let indices = |&pair| step.numbers.vertices(kind, pair);
        self.indices.extend(candidates.iter().map(indices));
        self.filter(step, kind, first);
        let kept = &self.pairs[first..];
        *count(&mut found.tally.candidates, kind) += candidates.len() as u64;
        *count(&mut found.tally.filtered, kind) += kept.len() as u64;
        if step.question.keeps_filtered {
            let in_mesh = |&pair| step.numbers.in_mesh(kind, pair);
            found.kept.extend(kept.iter().map(in_mesh));
        }
        found.tally.filter_time += begin.elapsed();
        self.pairs.len() < CHUNK || self.finish(step, kind, found)
    }

    /// Drops the pairs from `first` on that are never coplanar.
    fn filter(&mut self, step: &StepInput<'_, S>, kind: PairKind, first: usize) {
        let filter = Filter::new(Tier::Permanent);
        let separation = step.question.limits.separation;
        let filter = filter.with_separation(separation).unwrap_or(filter);
        let indices = &mut self.indices[first..];
        let pairs = &mut self.pairs[first..];
        self.masks.clear();
        self.masks.resize(indices.len().div_ceil(LANES), 0);
        let shape = shape(kind);
        culled_from_rows(
            step.level,
            shape,
            filter,
            step.rows,
            indices,
            &mut self.masks,
        );
        let mut kept = 0;
        for read in 0..pairs.len() {
            pairs[kept] = pairs[read];
            indices[kept] = indices[read];
            kept += usize::from(self.masks[read / LANES] >> (read % LANES) & 1 == 0);
        }
        self.pairs.truncate(first + kept);
        self.indices.truncate(first + kept);
    }

    /// Decides all pairs that there are. Returns whether to go on.
    pub(super) fn finish(
        &mut self,
        step: &StepInput<'_, S>,
        kind: PairKind,
        found: &mut Found<S>,
    ) -> bool {
        let begin = Instant::now();
        let until: S = step.bound.get();
        self.impacts.clear();
        self.impacts.resize(self.pairs.len(), None);
        self.open.clear();
        self.open.places.extend(0..self.pairs.len() as u32);
        self.open.indices.append(&mut self.indices);
        self.open.times.resize(self.pairs.len(), S::ZERO);
        self.wide.clear();
        if step.wide_rows.is_empty() {
            let rows = step.rows;
            let (level, limits) = (step.level, step.question.limits);
            run_sweeps(
                level,
                kind,
                rows,
                limits,
                until,
                &mut self.open,
                &mut self.impacts,
            );
        } else {
            self.sweep_narrowly(step, kind, until);
            let limits = Limits {
                separation: step.question.limits.separation.to_f64(),
                tolerance: step.question.limits.tolerance.to_f64(),
            };
            run_sweeps(
                step.level,
                kind,
                step.wide_rows,
                limits,
                until.to_f64(),
                &mut self.wide,
                &mut self.impacts,
            );
        }
        for (&pair, &impact) in self.pairs.iter().zip(&self.impacts) {
            if let Some(time) = impact
                && (!step.question.is_exact || touches(step, kind, pair, time))
            {
                step.bound.lower(step.question.wanted, time);
                found.contacts.push(Contact {
                    kind,
                    pair: step.numbers.in_mesh(kind, pair),
                    time,
                });
            }
        }
        self.pairs.clear();
        self.indices.clear();
        found.tally.elementary_time += begin.elapsed();
        !(step.question.wanted == Wanted::Any && step.bound.is_lowered())
    }

    /// As far as the format itself decides anything soon; the others are left to f64.
    fn sweep_narrowly(&mut self, step: &StepInput<'_, S>, kind: PairKind, until: S) {
        let Self { open, wide, .. } = self;
        let question = RoundQuestion {
            limits: step.question.limits,
            until,
            with_volume: false,
        };
        for _ in 0..NARROW_SWEEPS {
            if open.places.is_empty() {
                return;
            }
            open.sweep(step.level, kind, step.rows, &question);
            for left in &open.left {
                wide.push(left.place, left.indices, left.time.to_f64());
            }
        }
        for ((&place, &indices), time) in open.places.iter().zip(&open.indices).zip(&open.times) {
            wide.push(place, indices, time.to_f64());
        }
    }
}

/// Decides all that are open, in lanes of the format `T`: when contact with them is not excluded.
fn run_sweeps<T: Scalar, S: Scalar>(
    level: Level,
    kind: PairKind,
    rows: &[VertexRow<T>],
    limits: Limits<T>,
    until: T,
    open: &mut Open<T>,
    impacts: &mut [Option<S>],
) {
    let alone = |indices, from| advanced(kind, rows, indices, &limits, from, until);
    for sweep in 0..SWEEPS {
        if open.places.is_empty() {
            return;
        }
        let question = RoundQuestion {
            limits,
            until,
            with_volume: sweep >= VOLUME_SWEEP,
        };
        open.sweep(level, kind, rows, &question);
        for left in &open.left {
            let time = if left.is_near {
                Some(left.time)
            } else {
                alone(left.indices, left.time)
            };
            impacts[left.place as usize] = time.map(rounded_down);
        }
    }
    for ((&place, &indices), &from) in open.places.iter().zip(&open.indices).zip(&open.times) {
        impacts[place as usize] = alone(indices, from).map(rounded_down);
    }
}

/// A time that is not negative, or a little less, in the format `S`, which may be narrower.
fn rounded_down<T: Scalar, S: Scalar>(time: T) -> S {
    let time = time.to_f64();
    let rounded = S::from_f64(time);
    if rounded.to_f64() <= time {
        return rounded;
    }
    // One unit in the last place is at most 2u of a normal number, so this is below it by three at least, in any direction of
    // rounding; of a subnormal one it may not be.
    let lower = rounded * (S::ONE - S::small(8) * S::UNIT_ROUNDOFF);
    if lower.to_f64() <= time {
        lower
    } else {
        S::ZERO
    }
}

/// The pair of four vertices.
enum Primitives<S: Scalar> {
    VertexFace(VertexFace<S>),
    EdgeEdge(EdgeEdge<S>),
}

#[inline(always)]
fn primitives<S: Scalar>(kind: PairKind, rows: &[VertexRow<S>], pair: [u32; 4]) -> Primitives<S> {
    let [a, b, c, d] = pair.map(|row| -> Motion<S> { rows[row as usize].motion() });
    match kind {
        PairKind::VertexFace => Primitives::VertexFace(VertexFace {
            vertex: a,
            face: [b, c, d],
        }),
        PairKind::EdgeEdge => Primitives::EdgeEdge(EdgeEdge {
            first: [a, b],
            second: [c, d],
        }),
    }
}

/// One pair alone, from the time up to which it is proven to be apart.
fn advanced<S: Scalar>(
    kind: PairKind,
    rows: &[VertexRow<S>],
    indices: [u32; 4],
    limits: &Limits<S>,
    from: S,
    until: S,
) -> Option<S> {
    let impact = match primitives(kind, rows, indices) {
        Primitives::VertexFace(pair) => time_of_impact_within(&pair, limits, from, until),
        Primitives::EdgeEdge(pair) => time_of_impact_within(&pair, limits, from, until),
    };
    impact.time()
}

/// Whether a pair for which contact is not excluded from `time` on truly touches.
fn touches<S: Scalar>(step: &StepInput<'_, S>, kind: PairKind, pair: [u32; 2], time: S) -> bool {
    let impact = Impact::Possible {
        time,
        reason: Reason::WithinTolerance,
    };
    let (verdict, _) = match primitives(kind, step.rows, step.numbers.vertices(kind, pair)) {
        Primitives::VertexFace(pair) => settled(&pair, &impact),
        Primitives::EdgeEdge(pair) => settled(&pair, &impact),
    };
    verdict != Verdict::Never
}

fn shape(kind: PairKind) -> Shape {
    match kind {
        PairKind::VertexFace => Shape::VertexFace,
        PairKind::EdgeEdge => Shape::EdgeEdge,
    }
}

fn count(counts: &mut PairCounts, kind: PairKind) -> &mut u64 {
    match kind {
        PairKind::VertexFace => &mut counts.vertex_face,
        PairKind::EdgeEdge => &mut counts.edge_edge,
    }
}

/// A chunk that takes what a traversal finds.
pub(super) struct ChunkSink<'a, S: Scalar> {
    pub(super) chunk: &'a mut Chunk<S>,
    pub(super) found: &'a mut Found<S>,
    pub(super) step: &'a StepInput<'a, S>,
    pub(super) kind: PairKind,
}

impl<S: Scalar> Sink for ChunkSink<'_, S> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        self.chunk.take(self.step, self.kind, pairs, self.found)
    }
}
