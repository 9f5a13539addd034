//! Bodies in screw motion that meet: no time of impact may be later than a time at which the two are certainly within the separation.
//!
//! # Verdicts
//! A case is made backwards. Two sets of points, one on each body, are put together at a chosen time, and turned back to their
//! starts in floating point. Then the true places to which the rounded starts lead are computed in [256
//! bits](crate::oracle::arcs). So is the distance, at that time, of a point on one set and a point on the other. The distance is
//! at most a few roundings, about 10⁻¹⁵ of the coordinates. **The search uses a bound of it as its separation**, so on the exact
//! arcs the two sets are within it at that time. A later time, or none, is wrong.

mod case;

use super::{Findings, run as run_chunks};
use crate::generator::Choices;
use case::Case;
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use selvedge_core::PairKind;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The paths that the search gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MotionPaths {
    /// The arcs themselves.
    Arcs,
    /// Their chords. **They are not certified**; they show that misses are found.
    Chords,
}

/// Counts of one kind of pair.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeetingCounts {
    /// The number of pairs that meet.
    pub cases: u64,
    /// The number of pairs whose time is found in the last hundredth of the time until they meet.
    pub sharp: u64,
    /// The number of pairs that are found at the start of the step.
    pub at_once: u64,
    /// The number of pairs that are found too late, or not at all.
    pub missed: u64,
    /// The first missed pair: its chunk and the case.
    pub example: Option<(u64, String)>,
}

/// The findings of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScrewFindings {
    /// Counts of vertex–face and of edge–edge pairs.
    pub counts: [MeetingCounts; 2],
}

/// The state of a run.
pub type Progress = super::Progress<ScrewFindings>;

impl Progress {
    /// Starts a run over at least `cases` cases.
    #[must_use]
    pub fn new(seed: u64, cases: u64, cases_per_chunk: u64, paths: MotionPaths) -> Self {
        let depends_on = [("paths", format!("{paths:?}"))];
        Self::with_nothing_done(seed, cases, cases_per_chunk, &depends_on, ScrewFindings::default())
    }
}

impl Findings for ScrewFindings {
    const CAMPAIGN: &'static str = "screw_motions";
    type OfChunk = [MeetingCounts; 2];

    fn add(&mut self, _: u64, counts: [MeetingCounts; 2]) {
        self.join(Self { counts });
    }

    fn join(&mut self, other: Self) {
        for (sum, count) in self.counts.iter_mut().zip(other.counts) {
            sum.cases += count.cases;
            sum.sharp += count.sharp;
            sum.at_once += count.at_once;
            sum.missed += count.missed;
            sum.example = sum.example.take().into_iter().chain(count.example).min();
        }
    }

    fn wrong(&self) -> u64 {
        self.counts.iter().map(|count| count.missed).sum()
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [kind, cases, sharp, at_once, missed] = ["pair", "that meet", "sharp", "at once", "missed"];
        writeln!(f, "{kind:12} {cases:>14} {sharp:>14} {at_once:>14} {missed:>10}")?;
        for (kind, count) in KINDS.iter().zip(&self.found.counts) {
            let MeetingCounts {
                cases,
                sharp,
                at_once,
                missed,
                ..
            } = count;
            writeln!(f, "{kind:12} {cases:14} {sharp:14} {at_once:14} {missed:10}")?;
        }
        let examples = self.found.counts.iter().filter_map(|count| count.example.as_ref());
        for (chunk, example) in examples {
            writeln!(f, "\nmissed, in chunk {chunk}:\n{example}")?;
        }
        Ok(())
    }
}

const KINDS: [PairKind; 2] = [PairKind::VertexFace, PairKind::EdgeEdge];

/// Runs the remaining chunks on `threads` threads until `stops` returns true. `after_chunk` gets each state that may be kept, one at a time.
///
/// # Panics
/// Panics if a thread panics.
pub fn run(
    progress: Progress,
    paths: MotionPaths,
    threads: usize,
    after_chunk: impl Fn(&Progress) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress {
    let (seed, cases) = (progress.settings.seed, progress.settings.cases_per_chunk);
    run_chunks(
        progress,
        threads,
        |chunk| look_at(seed, chunk, cases, paths),
        after_chunk,
        stops,
    )
}

fn look_at(seed: u64, chunk: u64, cases: u64, paths: MotionPaths) -> [MeetingCounts; 2] {
    let mut random = random(seed, chunk);
    let mut bytes = [0; Choices::ENOUGH];
    let mut counts = <[MeetingCounts; 2]>::default();
    let mut left = cases;
    while left > 0 {
        random.fill_bytes(&mut bytes);
        let Some(case) = Case::choose(&mut Choices::new(&bytes)) else {
            continue;
        };
        left -= 1;
        let count = &mut counts[usize::from(case.kind == PairKind::EdgeEdge)];
        count.cases += 1;
        let found = case.first_time(paths == MotionPaths::Chords);
        match found {
            Some(time) if time <= case.time => {
                let is_sharp = case.time - time <= 0.01 * case.time;
                count.sharp += u64::from(is_sharp && time > 0.0);
                count.at_once += u64::from(time == 0.0);
            }
            _ => {
                count.missed += 1;
                let text = format!("found {found:?}, but at {} within {}: {case:?}", case.time, case.distance);
                count.example.get_or_insert((chunk, text));
            }
        }
    }
    counts
}

fn random(seed: u64, chunk: u64) -> TestRng {
    let mut bytes = [0; 16];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    // The seed is never zero, since this generator would stay there.
    bytes[8..].copy_from_slice(&(chunk + 1).to_le_bytes());
    let mut random = TestRng::from_seed(RngAlgorithm::XorShift, &bytes);
    // The first numbers of similar seeds are similar.
    random.fill_bytes(&mut [0; Choices::ENOUGH]);
    random
}
