//! Bodies in screw motion that meet: a hundred million times of impact, none of which may be later than a time at which the two certainly
//! are as near as the separation that is asked for.
//!
//! # Who judges
//! A case is made backwards: two sets of points, one on each body, are put together at a time, and turned back to where they start, in
//! floating point. Where the starts, as they are rounded, truly lead is then enclosed: sine and cosine correctly rounded to 64 bits, the rest in
//! intervals of `f64` rounded outwards. So is the distance, at that time, of a point on the one set and a point on the other. It is at most
//! some rounding, 10⁻¹⁵ of the coordinates or so, and **this bound is the separation that the time of impact is asked for**: on the exact
//! arcs the two are within it at that time. A time that is told later, or none, is wrong.

mod case;
mod interval;

use super::{Findings, run as run_chunks};
use crate::generator::Choices;
use case::Case;
use proptest::prelude::Rng;
use selvedge_core::PairKind;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What is asked for times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Ways {
    /// The arcs themselves.
    Arcs,
    /// Their chords: **not certified**, to show that misses are found.
    Chords,
}

/// What was seen of one kind of pair.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Pairs that meet.
    pub cases: u64,
    /// Those whose time is told not long before: in the last hundredth of the time until they meet.
    pub sharp: u64,
    /// Those that meet where they start, or so soon that nothing could be told of it.
    pub at_once: u64,
    /// Told too late, or not at all.
    pub missed: u64,
    /// The first of these, by chunk.
    pub example: Option<(u64, String)>,
}

/// What a run found, of vertex–face and edge–edge pairs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Found {
    /// Of either kind.
    pub tallies: [Tally; 2],
}

/// How far a run has come.
pub type Progress = super::Progress<Found>;

impl Progress {
    /// Nothing done yet; at least `cases` cases.
    #[must_use]
    pub fn new(seed: u64, cases: u64, cases_per_chunk: u64, ways: Ways) -> Self {
        let depends_on = [("ways", format!("{ways:?}"))];
        Self::with_nothing_done(seed, cases, cases_per_chunk, &depends_on, Found::default())
    }
}

impl Findings for Found {
    const CAMPAIGN: &'static str = "screw_motions";
    type OfChunk = [Tally; 2];

    fn add(&mut self, _: u64, tallies: [Tally; 2]) {
        self.join(Self { tallies });
    }

    fn join(&mut self, other: Self) {
        for (sum, tally) in self.tallies.iter_mut().zip(other.tallies) {
            sum.cases += tally.cases;
            sum.sharp += tally.sharp;
            sum.at_once += tally.at_once;
            sum.missed += tally.missed;
            sum.example = sum.example.take().into_iter().chain(tally.example).min();
        }
    }

    fn wrong(&self) -> u64 {
        self.tallies.iter().map(|tally| tally.missed).sum()
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [kind, cases, sharp, at_once, missed] = ["pair", "that meet", "sharp", "at once", "missed"];
        writeln!(f, "{kind:12} {cases:>14} {sharp:>14} {at_once:>14} {missed:>10}")?;
        for (kind, tally) in KINDS.iter().zip(&self.found.tallies) {
            let Tally {
                cases,
                sharp,
                at_once,
                missed,
                ..
            } = tally;
            writeln!(f, "{kind:12} {cases:14} {sharp:14} {at_once:14} {missed:10}")?;
        }
        let examples = self.found.tallies.iter().filter_map(|tally| tally.example.as_ref());
        for (chunk, example) in examples {
            writeln!(f, "\nmissed, in chunk {chunk}:\n{example}")?;
        }
        Ok(())
    }
}

const KINDS: [PairKind; 2] = [PairKind::VertexFace, PairKind::EdgeEdge];

/// Does what is left, on as many threads, until `stops` says so. `after_chunk` sees each state that may be kept, one at a time.
///
/// # Panics
/// If a thread panics.
pub fn run(
    progress: Progress,
    ways: Ways,
    threads: usize,
    after_chunk: impl Fn(&Progress) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress {
    let (seed, cases) = (progress.settings.seed, progress.settings.cases_per_chunk);
    run_chunks(
        progress,
        threads,
        |chunk| look_at(seed, chunk, cases, ways),
        after_chunk,
        stops,
    )
}

fn look_at(seed: u64, chunk: u64, cases: u64, ways: Ways) -> [Tally; 2] {
    let mut random = super::random(seed, chunk);
    let mut bytes = [0; Choices::ENOUGH];
    let mut tallies = <[Tally; 2]>::default();
    let mut left = cases;
    while left > 0 {
        random.fill_bytes(&mut bytes);
        let Some(case) = Case::choose(&mut Choices::new(&bytes)) else {
            continue;
        };
        left -= 1;
        let tally = &mut tallies[usize::from(case.kind == PairKind::EdgeEdge)];
        tally.cases += 1;
        let told = case.told(ways == Ways::Chords);
        match told {
            Some(time) if time <= case.time => {
                let is_sharp = case.time - time <= 0.01 * case.time;
                tally.sharp += u64::from(is_sharp && time > 0.0);
                tally.at_once += u64::from(time == 0.0);
            }
            _ => {
                tally.missed += 1;
                let text = format!("told {told:?}, but at {} within {}: {case:?}", case.time, case.distance);
                tally.example.get_or_insert((chunk, text));
            }
        }
    }
    tallies
}
