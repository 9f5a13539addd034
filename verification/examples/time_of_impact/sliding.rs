//! Measures the cost of pairs that slide past each other, by their distance.

use super::stream;
use selvedge_core::PairKind;
use selvedge_core::PrimitivePair;
use selvedge_core::elementary::Limits;
use selvedge_core::elementary::advance::{time_of_impact, time_of_impact_and_work};
use selvedge_verification::generator::{Choices, PairCase};
use std::hint::black_box;
use std::time::Instant;

/// The negated exponents of the distances, which are powers of two.
const EXPONENTS: std::ops::RangeInclusive<i32> = 2..=32;

/// The costs at one distance.
struct Cost {
    nanoseconds: f64,
    mean_rounds: f64,
    most_rounds: u32,
}

/// Measures `count` pairs of each kind at each distance in `f64`, and prints a table.
pub(crate) fn sliding(count: u64) {
    println!("kind        distance  ns a pair  rounds: mean, most");
    for (name, kind) in [("vertex and face", PairKind::VertexFace), ("two edges", PairKind::EdgeEdge)] {
        for exponent in EXPONENTS.step_by(2) {
            let cost = cost(kind, exponent, count);
            println!(
                "{name:15} 2^-{exponent:<3} {:9.0} {:8.2} {:5}",
                cost.nanoseconds, cost.mean_rounds, cost.most_rounds
            );
        }
    }
}

fn cost(kind: PairKind, exponent: i32, count: u64) -> Cost {
    let mut random = stream(1, exponent as u64);
    let pairs: Vec<PrimitivePair<f64>> = (0..count)
        .map(|_| {
            let bytes = random.bytes::<{ Choices::ENOUGH }>();
            PairCase::choose_sliding_at(kind, exponent, &mut Choices::new(&bytes)).pair()
        })
        .collect();
    let limits = Limits::default();
    let rounds = pairs.iter().map(|pair| time_of_impact_and_work(pair, &limits).1.rounds);
    let (sum, most_rounds) = rounds.fold((0, 0), |(sum, most), rounds| (sum + u64::from(rounds), most.max(rounds)));
    let seconds = [(); 5].map(|()| {
        let begin = Instant::now();
        for pair in &pairs {
            let _ = black_box(time_of_impact(black_box(pair), &limits));
        }
        begin.elapsed().as_secs_f64()
    });
    let nanoseconds = 1e9 * seconds.into_iter().fold(f64::INFINITY, f64::min);
    Cost {
        nanoseconds: nanoseconds / count as f64,
        mean_rounds: sum as f64 / count as f64,
        most_rounds,
    }
}
