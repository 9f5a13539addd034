//! A billion pairs: exact arithmetic checks every cull of the certified filters and box tests, and every "never" of the time of
//! impact.
//!
//! A pair takes about a microsecond: tests run in batches, and pairs come from three cheap [`CaseSource`]s. A run consists of
//! chunks. Each has random numbers of its own, so the findings depend on the seed alone, not on threads. Runs with other seeds
//! share no pairs: a campaign on many machines is one seed for each, and [`CampaignFindings::add`] sums what they count.
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

pub use pairs::{CaseSource, Points, Scenes, sample};

use selvedge_core::batch::{Level, Test};
use selvedge_core::filter::Tier;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// The share of the proven claims that the oracle confirms: one in this many.
pub const SAMPLE: u64 = 20_000;

/// A test that claims something about a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TestedClaim {
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
    /// [`time_of_impact`](selvedge_core::elementary::advance::time_of_impact) without a separation, with tolerance zero or the
    /// default.
    TimeOfImpact,
    /// The paper's filter, [`plain`](crate::plain). **It is not certified**; it shows that false culls are found.
    Plain,
}

impl TestedClaim {
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
pub struct CampaignFindings {
    /// The number of pairs.
    pub pairs: u64,
    pub claims: Vec<TestedClaim>,
    /// Counts by format, source and claim.
    pub counts: [[Vec<ClaimCounts>; 3]; 2],
}

impl CampaignFindings {
    /// Makes the findings of no pairs.
    #[must_use]
    pub fn nothing(claims: &[TestedClaim]) -> Self {
        let none = || vec![ClaimCounts::default(); claims.len()];
        let of_format = || [none(), none(), none()];
        Self {
            pairs: 0,
            claims: claims.to_vec(),
            counts: [of_format(), of_format()],
        }
    }

    /// Adds the findings of another run with the same claims. The sum does not depend on the order.
    ///
    /// # Errors
    /// Returns the claims of the other run if they differ.
    pub fn add(&mut self, other: Self) -> Result<(), Vec<TestedClaim>> {
        if other.claims != self.claims {
            return Err(other.claims);
        }
        self.pairs += other.pairs;
        let counts = other.counts.into_iter().flatten().flatten();
        for (sum, count) in self.counts.iter_mut().flatten().flatten().zip(counts) {
            sum.add(count);
        }
        Ok(())
    }

    #[must_use]
    pub fn wrong(&self) -> u64 {
        self.counts.iter().flatten().flatten().map(|count| count.wrong).sum()
    }
}

impl fmt::Display for CampaignFindings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:16} {:6} {:12} {:>13} {:>13} {:>13} {:>13} {:>9} {:>6}",
            "claim", "scalar", "source", "claims", "by signs", "by axis", "whole numbers", "by oracle", "wrong"
        )?;
        let mut examples = Vec::new();
        for (by_source, scalar) in self.counts.iter().zip(["f32", "f64"]) {
            for (counts, source) in by_source.iter().zip(CaseSource::ALL) {
                for (count, claim) in counts.iter().zip(&self.claims) {
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
        writeln!(f, "{} pairs, {} wrong claims", self.pairs, self.wrong())?;
        examples.iter().try_for_each(|example| writeln!(f, "\n{example}"))
    }
}

/// A run over chunks, which cycle through formats, sources and kinds of pair.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    pub seed: u64,
    pub chunks: u64,
    pub pairs_per_chunk: u64,
    pub scenes: &'a Scenes,
    pub claims: &'a [TestedClaim],
    pub level: Level,
}

impl Run<'_> {
    /// Runs all chunks on `threads` threads. `after_chunk` gets the sum of the finished chunks, one call at a time.
    ///
    /// # Panics
    /// Panics if a thread panics.
    pub fn findings(&self, threads: usize, after_chunk: impl Fn(&CampaignFindings) + Sync) -> CampaignFindings {
        let next = AtomicU64::new(0);
        let found = Mutex::new(CampaignFindings::nothing(self.claims));
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    loop {
                        let index = next.fetch_add(1, Ordering::Relaxed);
                        if index >= self.chunks {
                            break;
                        }
                        let counts = chunk::counts(self, index);
                        let mut found = found.lock().expect("no panic");
                        found.pairs += self.pairs_per_chunk;
                        let sums = &mut found.counts[chunk::format(index)][chunk::source(index) as usize];
                        sums.iter_mut().zip(counts).for_each(|(sum, count)| sum.add(count));
                        after_chunk(&found);
                    }
                });
            }
        });
        found.into_inner().expect("no panic")
    }
}
