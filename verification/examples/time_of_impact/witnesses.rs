//! Checks the proofs that come with the times of impact of many pairs.

use super::Random;
use super::alarms::{SOURCES, chosen};
use selvedge_core::elementary::{Impact, advance::witness};
use selvedge_verification::generator::Format;
use selvedge_verification::witness::Claim;

/// Prints a table of `count` pairs of each source and format. Returns how many proofs are refused.
pub(crate) fn witnesses(count: u64, seed: u64) -> u64 {
    println!("source    scalar    pairs      never  parts: mean, most | refused");
    let sources = SOURCES.into_iter().enumerate();
    sources
        .map(|(source, name)| {
            let mut random = Random::new(seed, source as u64);
            checked::<f64>(name, count, &mut random) + checked::<f32>(name, count, &mut random)
        })
        .sum()
}

fn checked<S: Format>(source: &str, count: u64, random: &mut Random) -> u64 {
    let (mut never, mut parts, mut most, mut refused) = (0, 0, 0, 0);
    for index in 0..count as usize {
        let (case, limits) = chosen::<S>(source, index, random);
        let pair = case.pair();
        let (impact, witness) = witness(&pair, &limits);
        never += u64::from(impact == Impact::Never);
        parts += witness.parts().len();
        most = most.max(witness.parts().len());
        if case.is_finite() && !Claim::new(&pair, limits.separation, impact, &witness).is_proven() {
            refused += 1;
            println!("refused: {limits:?}, {impact:?}, {witness:?} {case:?}");
        }
    }
    let mean = parts as f64 / count as f64;
    println!("{source:9} {:6} {count:8} {never:10}  {mean:.3} {most} | {refused}", S::NAME);
    refused
}
