//! Checks the proofs of the certified time of impact on many random pairs, and measures the cost of pairs that slide.
//!
//! `cargo run --release -p selvedge-verification --example time_of_impact -- witnesses COUNT [SEED]`
//! `cargo run --release -p selvedge-verification --example time_of_impact -- sliding COUNT`
//!
//! `witnesses` makes COUNT pairs that slide, and as many by the tests' generator, in each format. It checks the proof that comes
//! with each answer, in exact numbers. The exit status is 1 if one is refused.
//!
//! `sliding` measures COUNT pairs of each kind at each of several distances.

mod sliding;
mod witnesses;

use clap::Parser;
use selvedge_verification::random::Random;
use std::process::ExitCode;

#[derive(Parser)]
enum Task {
    Witnesses {
        count: u64,
        #[arg(default_value_t = 1)]
        seed: u64,
    },
    Sliding {
        count: u64,
    },
}

fn main() -> ExitCode {
    let refused = match Task::parse() {
        Task::Witnesses { count, seed } => witnesses::witnesses(count, seed),
        Task::Sliding { count } => {
            sliding::sliding(count);
            0
        }
    };
    ExitCode::from(u8::from(refused > 0))
}

/// Returns one of several streams of numbers from a seed.
const fn stream(seed: u64, number: u64) -> Random {
    Random(seed ^ number << 40)
}
