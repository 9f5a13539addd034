//! Sweeps: one round of advancing for all open pairs, after which those that it decides are dropped.

use crate::broad_phase::CHUNK;
use crate::simd::Level;
use selvedge_core::PairKind;
use selvedge_core::Scalar;
use selvedge_core::batch::{LANES, Round, RoundQuestion, VertexRow, advance_from_rows};
use selvedge_core::elementary::Limits;

/// The first sweep that asks the signed volume as well: from the second on takes 7 ms more on cloth-ball, from the third 1.
const VOLUME_SWEEP: usize = 3;

/// A chunk is swept when there are as many pairs as one visit brings, so there are never twice as many.
pub(super) const MOST: usize = 3 * CHUNK;

/// Open pairs: their places in the chunk, the rows of their vertices, and up to when they are proven to be apart.
#[derive(Debug)]
pub(super) struct Open<F> {
    places: Vec<u32>,
    indices: Vec<[u32; 4]>,
    times: Vec<F>,
    rounds: Vec<Round>,
}

impl<F: Scalar> Open<F> {
    pub(super) fn new() -> Self {
        Self {
            places: Vec::with_capacity(MOST),
            indices: Vec::with_capacity(MOST),
            times: Vec::with_capacity(MOST),
            rounds: Vec::with_capacity(MOST.div_ceil(LANES)),
        }
    }

    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.indices.clear();
        self.times.clear();
    }

    /// All pairs of a chunk, from the start.
    pub(super) fn fill(&mut self, indices: &[[u32; 4]]) {
        self.clear();
        self.places.extend(0..indices.len() as u32);
        self.indices.extend_from_slice(indices);
        self.times.resize(indices.len(), F::ZERO);
    }

    pub(super) fn push(&mut self, place: u32, indices: [u32; 4], time: F) {
        self.places.push(place);
        self.indices.push(indices);
        self.times.push(time);
    }

    pub(super) fn all(&self) -> impl Iterator<Item = (u32, [u32; 4], F)> + '_ {
        let pairs = self.places.iter().zip(&self.indices).zip(&self.times);
        pairs.map(|((&place, &indices), &time)| (place, indices, time))
    }
}

/// Why a pair that is not proven to be apart is open no more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Undecided {
    /// Within the tolerance of the separation, at its time.
    Near,
    /// Lanes can prove nothing more.
    Stuck,
}

/// Sweeps that all ask the same.
pub(super) struct Sweep<'a, F> {
    pub(super) level: Level,
    pub(super) kind: PairKind,
    pub(super) rows: &'a [VertexRow<F>],
    pub(super) limits: Limits<F>,
    /// Up to when pairs are of interest.
    pub(super) until: F,
}

impl<F: Scalar> Sweep<'_, F> {
    /// One round for all open pairs, the sweep with this number. Those that it decides are open no more; `leave` gets the ones that are
    /// not proven to be apart: place, rows, time and why.
    pub(super) fn run(&self, number: usize, open: &mut Open<F>, mut leave: impl FnMut(u32, [u32; 4], F, Undecided)) {
        let Open {
            places,
            indices,
            times,
            rounds,
        } = open;
        let len = places.len();
        rounds.clear();
        rounds.resize(len.div_ceil(LANES), Round::default());
        let question = RoundQuestion {
            limits: self.limits,
            until: self.until,
            with_volume: number >= VOLUME_SWEEP,
        };
        let (level, kind) = (self.level, self.kind);
        advance_from_rows(level, kind, &question, self.rows, indices, times, rounds);
        let mut kept = 0;
        for (first, round) in (0..).step_by(LANES).zip(rounds.iter()) {
            let mut leaving = round.near | round.stuck;
            while leaving != 0 {
                let lane = leaving.trailing_zeros() as usize;
                leaving &= leaving - 1;
                let index = first + lane;
                if index < len {
                    let is_near = round.near >> lane & 1 != 0;
                    let why = if is_near { Undecided::Near } else { Undecided::Stuck };
                    leave(places[index], indices[index], times[index], why);
                }
            }
            let closed = round.apart | round.near | round.stuck;
            for index in first..len.min(first + LANES) {
                places[kept] = places[index];
                indices[kept] = indices[index];
                times[kept] = times[index];
                kept += usize::from(closed >> (index - first) & 1 == 0);
            }
        }
        places.truncate(kept);
        indices.truncate(kept);
        times.truncate(kept);
    }
}
