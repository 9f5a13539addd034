//! Checks the proofs that come with the times of impact of many pairs.

use super::stream;
use selvedge_core::PairKind;
use selvedge_core::elementary::{Impact, Limits, advance::witness};
use selvedge_verification::generator::{Choices, Format, PairCase};
use selvedge_verification::random::Random;
use selvedge_verification::witness::Claim;

/// The sources of pairs: those that slide, and all that the tests' generator makes.
const SOURCES: [&str; 2] = ["sliding", "generated"];

/// Prints a table of `count` pairs of each source and format. Returns how many proofs are refused.
pub(crate) fn witnesses(count: u64, seed: u64) -> u64 {
    println!("source    scalar    pairs      never  parts: mean, most | refused");
    let sources = SOURCES.into_iter().enumerate();
    sources
        .map(|(source, name)| {
            let mut random = stream(seed, source as u64);
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

/// Chooses a pair and its limits.
fn chosen<S: Format>(source: &str, index: usize, random: &mut Random) -> (PairCase<S>, Limits<S>) {
    let bytes = random.bytes::<{ Choices::ENOUGH }>();
    let mut choices = Choices::new(&bytes);
    let kind = PairKind::ALL[index % 2];
    let case = if source == SOURCES[0] {
        PairCase::<S>::choose_sliding(kind, &mut choices)
    } else {
        PairCase::<S>::choose(kind, &mut choices)
    };
    // A quarter of the sliding pairs are to keep a separation of about the distance at which they slide.
    let separation = if source == SOURCES[0] && index % 8 < 2 {
        S::exact(1, -choices.pick(&[10, 14, 20, 26]))
    } else {
        S::ZERO
    };
    (case, Limits::within(separation))
}
