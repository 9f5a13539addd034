//! A billion pairs: every cull of the certified filters and box tests, and every "never" of the time of impact, checked by exact
//! arithmetic that is fast enough for it.
//!
//! Unlike [`false_culls`](super::false_culls) it is made for speed, a microsecond a pair: tests run in batches, and pairs come from
//! three [`Source`]s that cost little.
//!
//! # Who judges
//! A cull by the volume's signs is right if the exact control values ([`control_value_signs`](selvedge_core::verification::exact::control_value_signs)) have one strict sign. A claim that the
//! sets stay apart is right if so; or if one axis keeps them in the same order at both ends, which comparisons of coordinates tell;
//! or if [`touches`](selvedge_core::verification::exact::touches) says so, in whole numbers. Nothing else counts: what none of these proves is decided by the [`oracle`](crate::oracle), and
//! every [`SAMPLE`]th claim that they do prove is put before the oracle as well.

mod chunk;
mod judge;
mod pairs;

pub use pairs::{Points, Scenes, Source, sample};

use super::{Findings, run as run_chunks};
use chunk::Chunk;
use selvedge_core::batch::Level;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Of the claims that are proven, every this many the oracle confirms one.
pub const SAMPLE: u64 = 20_000;

/// What claims that a pair need not be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Claim {
    /// [`Tier::Permanent`](selvedge_core::filter::Tier::Permanent): never coplanar.
    Filter,
    /// [`Test::RelativeBoxes`](selvedge_core::batch::Test::RelativeBoxes): never touches, as all below.
    RelativeBoxes,
    /// [`Test::SegmentBox`](selvedge_core::batch::Test::SegmentBox).
    SegmentBox,
    /// [`time_of_impact`](selvedge_core::elementary::advance::time_of_impact) without a separation, tolerance zero or the default.
    TimeOfImpact,
    /// [`Plain`](selvedge_laboratory::baselines::plain::Plain): **not certified**, to show that false culls are found.
    Plain,
}

impl Claim {
    /// Those that are certified.
    pub const CERTIFIED: [Self; 4] = [Self::Filter, Self::RelativeBoxes, Self::SegmentBox, Self::TimeOfImpact];

    /// Whether it says that the points are never coplanar; else, that the sets never touch.
    const fn is_of_the_volume(self) -> bool {
        matches!(self, Self::Filter | Self::Plain)
    }
}

/// What was seen of one claim.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// How often it was made.
    pub claims: u64,
    /// Of these, proven by exact signs.
    pub by_signs: u64,
    /// By an axis.
    pub by_axis: u64,
    /// By whole numbers.
    pub by_whole_numbers: u64,
    /// Decided or confirmed by the oracle.
    pub by_oracle: u64,
    /// Wrong.
    pub wrong: u64,
    /// The first wrong one, by chunk.
    pub example: Option<(u64, String)>,
}

impl Tally {
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

/// What a run found, by claim.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Found {
    /// What is looked at.
    pub claims: Vec<Claim>,
    /// By format, source and claim.
    pub tallies: [[Vec<Tally>; 3]; 2],
}

/// How far a run has come. Chunks go round formats, sources and kinds of pair.
pub type Progress = super::Progress<Found>;

impl Progress {
    /// Nothing done yet; at least `pairs` pairs.
    #[must_use]
    pub fn new(seed: u64, pairs: u64, pairs_per_chunk: u64, scenes: &Scenes, claims: &[Claim]) -> Self {
        let nothing = || vec![Tally::default(); claims.len()];
        let of_format = || [nothing(), nothing(), nothing()];
        let found = Found {
            claims: claims.to_vec(),
            tallies: [of_format(), of_format()],
        };
        let depends_on = [("claims", format!("{claims:?}")), ("scenes", scenes.to_string())];
        Self::with_nothing_done(seed, pairs, pairs_per_chunk, &depends_on, found)
    }
}

impl Findings for Found {
    const CAMPAIGN: &'static str = "exact_campaign";
    type OfChunk = Vec<Tally>;

    fn add(&mut self, chunk: u64, tallies: Vec<Tally>) {
        let sums = &mut self.tallies[chunk::format(chunk)][chunk::source(chunk) as usize];
        for (sum, tally) in sums.iter_mut().zip(tallies) {
            sum.add(tally);
        }
    }

    fn join(&mut self, other: Self) {
        let tallies = other.tallies.into_iter().flatten().flatten();
        for (sum, tally) in self.tallies.iter_mut().flatten().flatten().zip(tallies) {
            sum.add(tally);
        }
    }

    fn wrong(&self) -> u64 {
        let all = self.tallies.iter().flatten().flatten();
        all.map(|tally| tally.wrong).sum()
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
        for (by_source, scalar) in self.found.tallies.iter().zip(["f32", "f64"]) {
            for (tallies, source) in by_source.iter().zip(Source::ALL) {
                for (tally, claim) in tallies.iter().zip(&self.found.claims) {
                    writeln!(
                        f,
                        "{:16} {scalar:6} {:12} {:13} {:13} {:13} {:13} {:9} {:6}",
                        format!("{claim:?}"),
                        format!("{source:?}"),
                        tally.claims,
                        tally.by_signs,
                        tally.by_axis,
                        tally.by_whole_numbers,
                        tally.by_oracle,
                        tally.wrong
                    )?;
                    if let Some((_, pair)) = &tally.example {
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

/// Does what is left, on as many threads, until `stops` says so. `after_chunk` sees each state that may be kept, one at a time.
///
/// # Panics
/// If a thread panics.
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
