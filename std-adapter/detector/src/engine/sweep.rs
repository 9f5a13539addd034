//! Sweeps. Each is one round of advancing for all open pairs, and drops the pairs that it decides.

use crate::broad_phase::CHUNK;
use crate::simd::Level;
use selvedge_core::PairKind;
use selvedge_core::Scalar;
use selvedge_core::batch::{LANES, Round, RoundQuestion, VertexRow, advance_from_rows};
use selvedge_core::elementary::Limits;

/// The first sweep that also tests the signed volume. Earlier sweeps with that test cost more than they save.
const VOLUME_SWEEP: usize = 3;

/// The largest number of pairs of a chunk, which is swept as soon as it holds as many as one visit brings.
pub(super) const MOST: usize = 3 * CHUNK;

/// Open pairs: their places in the chunk, the rows of their vertices, and the times up to which they are proven apart.
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

    /// Takes all pairs of a chunk, from the start of the step.
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

/// The reason why a pair leaves the sweeps without a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Undecided {
    /// The pair is within the tolerance of the separation at its time.
    Near,
    /// The lanes cannot prove more.
    Stuck,
}

pub(super) struct Sweep<'a, F> {
    pub(super) level: Level,
    pub(super) kind: PairKind,
    pub(super) rows: &'a [VertexRow<F>],
    pub(super) limits: Limits<F>,
    /// The latest time of interest.
    pub(super) until: F,
}

impl<F: Scalar> Sweep<'_, F> {
    /// Runs one round for all open pairs. Drops the pairs that it decides, and calls `leave` with those that it does not prove
    /// apart: place, rows, time and reason.
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
