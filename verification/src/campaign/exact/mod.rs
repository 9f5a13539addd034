//! A billion pairs: exact arithmetic checks every cull of the certified filters and box tests, and every "never" of the time of impact.
//!
//! A pair takes about a microsecond: tests run in batches, and pairs come from three cheap [`Source`]s.
//!
//! # Verdicts
//! A cull by the volume's signs is right if the exact control values
//! ([`control_value_signs`](selvedge_core::kernels::exact::control_value_signs)) have one strict sign. A claim that two sets
//! stay apart is right in three cases. The signs prove it, one axis keeps the sets in the same order at both ends, or the integer
//! test [`touches`](selvedge_core::kernels::exact::touches) finds no contact. The [`oracle`](crate::oracle) decides all
//! other claims. It also confirms every [`SAMPLE`]th claim that these prove.

mod chunk;
mod judge;
mod pairs;

pub use pairs::{Points, Scenes, Source, sample};

use super::{Findings, run as run_chunks};
use chunk::Chunk;
use selvedge_core::batch::{Level, Test};
use selvedge_core::filter::Tier;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The share of the proven claims that the oracle confirms: one in this many.
pub const SAMPLE: u64 = 20_000;

/// A test that claims something about a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Claim {
    /// [`Tier::Permanent`] claims that the points are never coplanar, as the tiers below do.
    Filter,
    /// [`Tier::Widened`].
    Widened,
    /// [`Tier::Exact`].
    Exact,
    /// [`Test::RelativeBoxes`] claims that the sets never touch, as the tests below do.
    RelativeBoxes,
    /// [`Test::SegmentBox`].
    SegmentBox,
    /// [`time_of_impact`](selvedge_core::elementary::advance::time_of_impact) without a separation, with tolerance zero or the default.
    TimeOfImpact,
    /// The paper's filter, [`plain`](crate::plain). **It is not certified**; it shows that false culls are found.
    Plain,
}

impl Claim {
    pub const CERTIFIED: [Self; 6] = [
        Self::Filter,
        Self::Widened,
        Self::Exact,
        Self::RelativeBoxes,
        Self::SegmentBox,
        Self::TimeOfImpact,
    ];

    const fn tier(self) -> Option<Tier> {
        match self {
            Self::Filter => Some(Tier::Permanent),
            Self::Widened => Some(Tier::Widened),
            Self::Exact => Some(Tier::Exact),
            _ => None,
        }
    }

    /// Returns the test that runs in batches, for a claim about the sets.
    const fn test(self) -> Option<Test> {
        match self {
            Self::RelativeBoxes => Some(Test::RelativeBoxes),
            Self::SegmentBox => Some(Test::SegmentBox),
            _ => None,
        }
    }

    /// Returns true if the claim is that the points are never coplanar, false if it is that the sets never touch.
    const fn is_of_the_volume(self) -> bool {
        matches!(self, Self::Plain) || self.tier().is_some()
    }
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClaimCounts {
    pub claims: u64,
    pub by_signs: u64,
    pub by_axis: u64,
    pub by_whole_numbers: u64,
    /// The number of claims that the oracle decided or confirmed.
    pub by_oracle: u64,
    pub wrong: u64,
    /// The first wrong claim: its chunk and the pair.
    pub example: Option<(u64, String)>,
}

impl ClaimCounts {
    fn add(&mut self, other: Self) {
        self.claims += other.claims;
        self.by_signs += other.by_signs;
        self.by_axis += other.by_axis;
        self.by_whole_numbers += other.by_whole_numbers;
        self.by_oracle += other.by_oracle;
        self.wrong += other.wrong;
        self.example = self.example.take().into_iter().chain(other.example).min();
    }
}

/// The findings of a run, by claim.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ExactFindings {
    pub claims: Vec<Claim>,
    /// Counts by format, source and claim.
    pub counts: [[Vec<ClaimCounts>; 3]; 2],
}

/// The state of a run. Chunks cycle through formats, sources and kinds of pair.
pub type Progress = super::Progress<ExactFindings>;

impl Progress {
    /// Starts a run over at least `pairs` pairs.
    pub fn new(seed: u64, pairs: u64, pairs_per_chunk: u64, scenes: &Scenes, claims: &[Claim]) -> Self {
        let nothing = || vec![ClaimCounts::default(); claims.len()];
        let of_format = || [nothing(), nothing(), nothing()];
        let found = ExactFindings {
            claims: claims.to_vec(),
            counts: [of_format(), of_format()],
        };
        let depends_on = [("claims", format!("{claims:?}")), ("scenes", scenes.to_string())];
        Self::with_nothing_done(seed, pairs, pairs_per_chunk, &depends_on, found)
    }
}

impl Findings for ExactFindings {
    const CAMPAIGN: &'static str = "exact_campaign";
    type OfChunk = Vec<ClaimCounts>;

    fn add(&mut self, chunk: u64, counts: Vec<ClaimCounts>) {
        let sums = &mut self.counts[chunk::format(chunk)][chunk::source(chunk) as usize];
        for (sum, count) in sums.iter_mut().zip(counts) {
            sum.add(count);
        }
    }

    fn join(&mut self, other: Self) {
        let counts = other.counts.into_iter().flatten().flatten();
        for (sum, count) in self.counts.iter_mut().flatten().flatten().zip(counts) {
            sum.add(count);
        }
    }

    fn wrong(&self) -> u64 {
        let all = self.counts.iter().flatten().flatten();
        all.map(|count| count.wrong).sum()
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:16} {:6} {:12} {:>13} {:>13} {:>13} {:>13} {:>9} {:>6}",
            "claim", "scalar", "source", "claims", "by signs", "by axis", "whole numbers", "by oracle", "wrong"
        )?;
        let mut examples = Vec::new();
        for (by_source, scalar) in self.found.counts.iter().zip(["f32", "f64"]) {
            for (counts, source) in by_source.iter().zip(Source::ALL) {
                for (count, claim) in counts.iter().zip(&self.found.claims) {
                    writeln!(
                        f,
                        "{:16} {scalar:6} {:12} {:13} {:13} {:13} {:13} {:9} {:6}",
                        format!("{claim:?}"),
                        format!("{source:?}"),
                        count.claims,
                        count.by_signs,
                        count.by_axis,
                        count.by_whole_numbers,
                        count.by_oracle,
                        count.wrong
                    )?;
                    if let Some((_, pair)) = &count.example {
                        examples.push(format!("{claim:?}, {scalar}, is wrong of\n{pair}"));
                    }
                }
            }
        }
        let pairs = self.cases();
        writeln!(f, "{pairs} pairs, {} wrong claims", self.found.wrong())?;
        examples.iter().try_for_each(|example| writeln!(f, "\n{example}"))
    }
}

/// Runs the remaining chunks on `threads` threads until `stops` returns true. `after_chunk` gets each state that may be kept, one at a time.
///
/// # Panics
/// Panics if a thread panics.
pub fn run(
    progress: Progress,
    scenes: &Scenes,
    level: Level,
    threads: usize,
    after_chunk: impl Fn(&Progress) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress {
    let (seed, pairs) = (progress.settings.seed, progress.settings.cases_per_chunk);
    let claims = progress.found.claims.clone();
    let look_at = |index| {
        let chunk = Chunk {
            index,
            seed,
            pairs,
            scenes,
            level,
            claims: &claims,
        };
        chunk.look_at()
    };
    run_chunks(progress, threads, look_at, after_chunk, stops)
}
