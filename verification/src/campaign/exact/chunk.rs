//! One chunk of the run: its pairs, what claims something of them, and whether the claims are right.

use super::judge::Judge;
use super::pairs::{Maker, Random};
use super::{Claim, Scenes, Source, Tally};
use crate::generator::{Format, PairCase};
use selvedge_core::PairKind;
use selvedge_core::batch::{ByPoints, LANES, Level, Test, culled};
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::filter::{Filter, Tier};
use selvedge_laboratory::baselines::plain::Plain;

/// The number format of a chunk: 0 is `f32`, 1 is `f64`.
pub(super) const fn format(chunk: u64) -> usize {
    (chunk % 2) as usize
}

pub(super) const fn source(chunk: u64) -> Source {
    Source::ALL[(chunk / 2 % 3) as usize]
}

const fn kind(chunk: u64) -> PairKind {
    if (chunk / 6).is_multiple_of(2) {
        PairKind::VertexFace
    } else {
        PairKind::EdgeEdge
    }
}

/// A chunk: one format, one source, one kind of pair.
pub(super) struct Chunk<'a> {
    pub(super) index: u64,
    pub(super) seed: u64,
    pub(super) pairs: u64,
    pub(super) scenes: &'a Scenes,
    pub(super) level: Level,
    pub(super) claims: &'a [Claim],
}

impl Chunk<'_> {
    /// Makes its pairs, tests them, and judges every claim: a tally for each.
    pub(super) fn look_at(&self) -> Vec<Tally> {
        match format(self.index) {
            0 => self.tallies::<f32>(),
            _ => self.tallies::<f64>(),
        }
    }

    fn tallies<S: Format>(&self) -> Vec<Tally> {
        const BLOCK: u64 = 1024;
        let mut maker = Maker::new(
            source(self.index),
            kind(self.index),
            self.scenes,
            Random::new(self.seed, self.index),
        );
        let mut tallies = vec![Tally::default(); self.claims.len()];
        let mut cases = Vec::new();
        let mut masks = vec![[0; BLOCK as usize / LANES]; self.claims.len()];
        let mut left = self.pairs;
        while left > 0 {
            let count = left.min(BLOCK);
            left -= count;
            cases.clear();
            maker.make(count as usize, &mut cases);
            let pairs: Vec<_> = cases.iter().map(PairCase::<S>::pair).collect();
            for (claim, masks) in self.claims.iter().zip(&mut masks) {
                let test = match claim {
                    Claim::Filter => {
                        culled(self.level, Filter::new(Tier::Permanent), &pairs, masks);
                        continue;
                    }
                    Claim::RelativeBoxes => Test::RelativeBoxes,
                    Claim::SegmentBox => Test::SegmentBox,
                    Claim::Plain => {
                        culled(self.level, ByPoints(Plain), &pairs, masks);
                        continue;
                    }
                    Claim::TimeOfImpact => continue,
                };
                culled(self.level, test, &pairs, masks);
            }
            for (index, (case, pair)) in cases.iter().zip(&pairs).enumerate() {
                let mut judge = Judge::new(case, pair);
                for ((claim, masks), tally) in self.claims.iter().zip(&masks).zip(&mut tallies) {
                    let is_claimed = match claim {
                        Claim::TimeOfImpact => {
                            let limits = if index % 2 == 0 {
                                Limits::default()
                            } else {
                                Limits {
                                    tolerance: S::ZERO,
                                    separation: S::ZERO,
                                }
                            };
                            time_of_impact(pair, &limits) == Impact::Never
                        }
                        _ => masks[index / LANES] >> (index % LANES) & 1 != 0,
                    };
                    if is_claimed {
                        judge.judge(*claim, tally, self.index);
                    }
                }
            }
        }
        tallies
    }
}
