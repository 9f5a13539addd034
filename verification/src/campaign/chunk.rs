//! One chunk of the run: its pairs, the claims about them, and whether the claims are right.

use super::judge::Judge;
use super::pairs::{Maker, random};
use super::{CaseSource, ClaimCounts, Run, TestedClaim};
use crate::generator::{Format, PairCase};
use crate::plain;
use selvedge_core::PairKind;
use selvedge_core::batch::{LANES, culled};
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::filter::Filter;

/// Returns the number format of a chunk: 0 is `f32`, 1 is `f64`.
pub(super) const fn format(chunk: u64) -> usize {
    (chunk % 2) as usize
}

pub(super) const fn source(chunk: u64) -> CaseSource {
    CaseSource::ALL[(chunk / 2 % 3) as usize]
}

const fn kind(chunk: u64) -> PairKind {
    if (chunk / 6).is_multiple_of(2) {
        PairKind::VertexFace
    } else {
        PairKind::EdgeEdge
    }
}

/// Makes the pairs of a chunk, tests them, and judges every claim. Returns counts for each claim.
pub(super) fn counts(run: &Run<'_>, index: u64) -> Vec<ClaimCounts> {
    match format(index) {
        0 => counts_in::<f32>(run, index),
        _ => counts_in::<f64>(run, index),
    }
}

fn counts_in<S: Format>(run: &Run<'_>, chunk: u64) -> Vec<ClaimCounts> {
    const BLOCK: u64 = 1024;
    let mut maker = Maker::new(source(chunk), kind(chunk), run.scenes, random(run.seed, chunk));
    let mut counts = vec![ClaimCounts::default(); run.claims.len()];
    let mut cases = Vec::new();
    let mut masks = vec![[0; BLOCK as usize / LANES]; run.claims.len()];
    let mut left = run.pairs_per_chunk;
    while left > 0 {
        let block = left.min(BLOCK);
        left -= block;
        cases.clear();
        maker.make(block as usize, &mut cases);
        let pairs: Vec<_> = cases.iter().map(PairCase::<S>::pair).collect();
        for (claim, masks) in run.claims.iter().zip(&mut masks) {
            if let Some(tier) = claim.tier() {
                culled(run.level, Filter::new(tier), &pairs, masks);
            } else if let Some(test) = claim.test() {
                culled(run.level, test, &pairs, masks);
            }
        }
        for (index, (case, pair)) in cases.iter().zip(&pairs).enumerate() {
            let mut judge = Judge::new(case, pair);
            for ((claim, masks), count) in run.claims.iter().zip(&masks).zip(&mut counts) {
                let is_claimed = match claim {
                    TestedClaim::TimeOfImpact => {
                        let limits = if index % 2 == 0 {
                            Limits::default()
                        } else {
                            Limits::accurate_to(S::ZERO)
                        };
                        time_of_impact(pair, &limits) == Impact::Never
                    }
                    TestedClaim::Plain => plain::culls(case),
                    _ => masks[index / LANES] >> (index % LANES) & 1 != 0,
                };
                if is_claimed {
                    judge.judge(*claim, count, chunk);
                }
            }
        }
    }
    counts
}
