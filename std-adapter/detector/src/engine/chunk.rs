//! The stages after the broad phase, on a chunk of pairs that stays in a core's own cache.
//!
//! ```text
//! candidates       positions in the hierarchies, or listed pairs
//!   │  filter      certified non-coplanarity, sixteen pairs at a time
//!   ▼
//! open pairs       chunk by chunk
//!   │  sweeps      one round of advancing for all open pairs, again and again
//!   │  one by one  the few pairs that lanes cannot decide, or that are still open; exact verdicts on request
//!   ▼
//! contacts         in the order of the candidates
//! ```
//!
//! # `f32` first
//! If all positions are `f32` numbering, in either format, filter and sweeps run in `f32` first. A register then holds twice as
//! many pairs, and half as many bytes are read. A proof in `f32` holds for the positions themselves. The pairs that `f32` leaves
//! open continue in `f64`, from the times up to which they are proven apart. So contacts and times are as sharp as those of
//! `f64`. The separation and the end of the time range are rounded up.

use super::findings::{Findings, count_of};
use super::numbering::Numbering;
use super::question::{Bound, Question, Wanted};
use super::source::Source;
use super::stop::Stop;
use super::sweep::{MOST, Open, Sweep, Undecided};
use crate::broad_phase::{CHUNK, RowSlices, Sink};
use crate::clock::Clock;
use crate::simd::Level;
use crate::step::Contact;
use selvedge_core::PairKind;
use selvedge_core::batch::{LANES, Mask, VertexRow, culled_from_rows};
use selvedge_core::elementary::advance::time_of_impact_within;
use selvedge_core::elementary::contact::contact_given_impact;
use selvedge_core::elementary::{ContactVerdict as Verdict, Impact, Limits, Reason};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::narrowing::rounded_up;
use selvedge_core::{PrimitivePair, Scalar};

/// The number of sweeps in `f64` before pairs are decided one by one. On a large cloth, 5 sweeps take a third more time than 16,
/// and 12 take 3 % more.
const SWEEPS: usize = 16;

/// The number of sweeps in `f32` before those in `f64`, where `f32` is exact. On a large cloth, 4, 6 and 8 take the same time,
/// and 12 take a tenth more.
const SINGLE_SWEEPS: usize = 4;

#[derive(Clone, Copy)]
pub(super) struct StepInput<'a> {
    pub(super) level: Level,
    pub(super) numbering: Numbering<'a>,
    pub(super) rows: RowSlices<'a>,
    pub(super) question: Question,
    /// The latest time of interest.
    pub(super) bound: &'a Bound,
    pub(super) stop: &'a Stop,
}

impl<'a> StepInput<'a> {
    pub(super) fn new(source: &Source<'a>, bound: &'a Bound, stop: &'a Stop) -> Self {
        let &Source {
            level,
            numbering,
            rows,
            question,
            ..
        } = source;
        Self {
            level,
            numbering,
            rows,
            question,
            bound,
            stop,
        }
    }

    #[inline(always)]
    fn primitives(&self, kind: PairKind, rows: [u32; 4]) -> PrimitivePair<f64> {
        PrimitivePair::new(kind, rows.map(|row| self.rows.double[row as usize].motion()))
    }
}

#[derive(Debug)]
pub(super) struct Chunk {
    /// The pairs that the filter keeps, and the rows of their vertices.
    pairs: Vec<[u32; 2]>,
    indices: Vec<[u32; 4]>,
    masks: Vec<Mask>,
    /// The pairs that are open, in the sweeps of either format.
    single: Open<f32>,
    double: Open<f64>,
    /// The time from which contact is possible for each of `pairs`; [`NEVER`] if it is excluded.
    impacts: Vec<f64>,
}

/// The memory of a contact, which is held once for the engine and once for the caller.
const BYTES_OF_CONTACT: usize = 2 * size_of::<Contact<f64>>();

/// A time after the step.
const NEVER: f64 = 2.0;

impl Chunk {
    pub(super) fn new() -> Self {
        Self {
            pairs: Vec::with_capacity(MOST),
            indices: Vec::with_capacity(MOST),
            masks: Vec::with_capacity(MOST.div_ceil(LANES)),
            single: Open::new(),
            double: Open::new(),
            impacts: Vec::with_capacity(MOST),
        }
    }

    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.indices.clear();
    }

    /// Takes candidates. Returns whether to continue.
    pub(super) fn take(
        &mut self,
        step: &StepInput<'_>,
        kind: PairKind,
        candidates: &[[u32; 2]],
        findings: &mut Findings,
    ) -> bool {
        if !step.stop.continues(candidates.len()) {
            return false;
        }
        let begin = Clock::now();
        let first = self.pairs.len();
        self.pairs.extend_from_slice(candidates);
        self.indices.resize(first + candidates.len(), [0; 4]);
        step.numbering.vertices_of_all(kind, candidates, &mut self.indices[first..]);
        let Self {
            pairs, indices, masks, ..
        } = self;
        drop_never_coplanar(step, kind, first, pairs, indices, masks);
        let kept = &self.pairs[first..];
        *count_of(&mut findings.counts.candidates, kind) += candidates.len() as u64;
        *count_of(&mut findings.counts.filtered, kind) += kept.len() as u64;
        if step.question.keeps_filtered {
            let in_mesh = |&pair| step.numbering.in_mesh(kind, pair);
            findings.kept[kind as usize].extend(kept.iter().map(in_mesh));
        }
        findings.counts.filter_time += begin.elapsed();
        self.pairs.len() < CHUNK || self.finish(step, kind, findings)
    }

    /// Decides all pairs of the chunk. Returns whether to continue.
    pub(super) fn finish(&mut self, step: &StepInput<'_>, kind: PairKind, findings: &mut Findings) -> bool {
        let begin = Clock::now();
        let until = step.bound.get();
        self.impacts.clear();
        self.impacts.resize(self.pairs.len(), NEVER);
        let sweeps = match step.rows.single {
            Some(rows) => self.sweep_in_single(step, kind, until, rows),
            None => {
                self.double.fill(&self.indices);
                0
            }
        };
        self.sweep_in_double(step, kind, until, sweeps);
        let before = findings.contacts.len();
        for (&pair, &time) in self.pairs.iter().zip(&self.impacts) {
            if time < NEVER && (!step.question.is_exact || touches(step, kind, pair, time)) {
                step.bound.lower(step.question.wanted, time);
                findings.contacts.push(Contact {
                    kind,
                    pair: step.numbering.in_mesh(kind, pair),
                    time,
                });
            }
        }
        let found = findings.contacts.len() - before;
        *count_of(&mut findings.counts.contacts, kind) += found as u64;
        if step.question.wanted == Wanted::Earliest {
            findings.keep_earliest();
        } else {
            step.stop.stores(found * BYTES_OF_CONTACT);
        }
        self.clear();
        findings.counts.elementary_time += begin.elapsed();
        let has_enough = step.question.wanted == Wanted::Any && step.bound.is_lowered();
        !has_enough && !step.stop.has_stopped()
    }

    /// Sweeps in `f32`. Pairs that this does not prove apart until the end continue in `f64` from the proven time. Returns the
    /// number of sweeps.
    fn sweep_in_single(&mut self, step: &StepInput<'_>, kind: PairKind, until: f64, rows: &[VertexRow<f32>]) -> usize {
        let Self { single, double, .. } = self;
        single.fill(&self.indices);
        double.clear();
        let limits = &step.question.limits;
        let sweep = Sweep {
            level: step.level,
            kind,
            rows,
            limits: Limits {
                // This tolerance is not part of a proof: it only decides when a pair goes to `f64`.
                tolerance: f32::from_f64(limits.tolerance),
                separation: rounded_up(limits.separation),
            },
            until: rounded_up::<f32>(until).min(1.0),
        };
        for number in 0..SINGLE_SWEEPS {
            sweep.run(number, single, |place, indices, time, _| {
                double.push(place, indices, time.into());
            });
        }
        for (place, indices, time) in single.all() {
            double.push(place, indices, time.into());
        }
        SINGLE_SWEEPS
    }

    /// Decides the open pairs in `f64`, after this number of sweeps.
    fn sweep_in_double(&mut self, step: &StepInput<'_>, kind: PairKind, until: f64, sweeps: usize) {
        let Self { double, impacts, .. } = self;
        let sweep = Sweep {
            level: step.level,
            kind,
            rows: step.rows.double,
            limits: step.question.limits,
            until,
        };
        for number in sweeps..sweeps + SWEEPS {
            sweep.run(number, double, |place, indices, time, outcome| {
                impacts[place as usize] = match outcome {
                    Undecided::Near => time,
                    Undecided::Stuck => advanced(step, kind, indices, time, until),
                };
            });
        }
        for (place, indices, time) in double.all() {
            impacts[place as usize] = advanced(step, kind, indices, time, until);
        }
    }
}

/// Drops pairs from `first` on that are never coplanar, with their rows.
pub(super) fn drop_never_coplanar(
    step: &StepInput<'_>,
    kind: PairKind,
    first: usize,
    pairs: &mut Vec<[u32; 2]>,
    indices: &mut Vec<[u32; 4]>,
    masks: &mut Vec<Mask>,
) {
    masks.clear();
    masks.resize((indices.len() - first).div_ceil(LANES), 0);
    let (level, of_pairs, separation) = (step.level, &indices[first..], step.question.limits.separation);
    // A separation beyond the range of the format excludes no pair.
    match step.rows.single {
        Some(rows) => {
            if let Some(filter) = Filter::new(Tier::Widened).with_separation(rounded_up(separation)) {
                culled_from_rows(level, kind, filter, rows, of_pairs, masks);
            }
        }
        None => {
            if let Some(filter) = Filter::new(Tier::Permanent).with_separation(separation) {
                culled_from_rows(level, kind, filter, step.rows.double, of_pairs, masks);
            }
        }
    }
    let mut kept = first;
    for read in first..pairs.len() {
        let place = read - first;
        pairs[kept] = pairs[read];
        indices[kept] = indices[read];
        kept += usize::from(masks[place / LANES] >> (place % LANES) & 1 == 0);
    }
    pairs.truncate(kept);
    indices.truncate(kept);
}

/// Decides one pair, from the time up to which it is proven apart. Returns the time of contact, or [`NEVER`].
fn advanced(step: &StepInput<'_>, kind: PairKind, indices: [u32; 4], from: f64, until: f64) -> f64 {
    let limits = &step.question.limits;
    let impact = time_of_impact_within(&step.primitives(kind, indices), limits, from, until);
    impact.time().unwrap_or(NEVER)
}

/// Returns whether a pair truly touches that may be in contact from `time` on.
fn touches(step: &StepInput<'_>, kind: PairKind, pair: [u32; 2], time: f64) -> bool {
    let impact = Impact::Possible {
        time,
        reason: Reason::WithinTolerance,
    };
    let pair = step.primitives(kind, step.numbering.vertices(kind, pair));
    contact_given_impact(&pair, &impact) != Verdict::Never
}

/// A sink that takes the pairs of a traversal into a chunk.
pub(super) struct ChunkSink<'a> {
    pub(super) chunk: &'a mut Chunk,
    pub(super) findings: &'a mut Findings,
    pub(super) step: &'a StepInput<'a>,
    pub(super) kind: PairKind,
}

impl Sink for ChunkSink<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        self.chunk.take(self.step, self.kind, pairs, self.findings)
    }
}
