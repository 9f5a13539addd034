//! Checks that the certified time of impact keeps its promises on many random pairs, and measures the cost of pairs that slide.
//!
//! `cargo run --release -p selvedge-verification --example time_of_impact -- alarms COUNT [SEED]`
//! `cargo run --release -p selvedge-verification --example time_of_impact -- witnesses COUNT [SEED]`
//! `cargo run --release -p selvedge-verification --example time_of_impact -- sliding COUNT PLOT.svg`
//!
//! `alarms` makes COUNT pairs that slide, and as many by the tests' generator, in each format. Every contact must come as near as
//! the documentation says, and no excluded pair may touch. The exit status is 1 if a promise is broken.
//!
//! `witnesses` makes the same pairs and checks the proof that comes with each answer, in exact numbers. Exit status 1 if one is
//! refused.
//!
//! `sliding` measures COUNT pairs of each kind at each of several distances. It prints a table and draws a plot.

mod alarms;
mod sliding;
mod witnesses;

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

#[derive(Parser)]
enum Task {
    Alarms {
        count: u64,
        #[arg(default_value_t = 1)]
        seed: u64,
    },
    Witnesses {
        count: u64,
        #[arg(default_value_t = 1)]
        seed: u64,
    },
    Sliding {
        count: u64,
        plot: PathBuf,
    },
}

fn main() -> ExitCode {
    let broken = match Task::parse() {
        Task::Alarms { count, seed } => alarms::alarms(count, seed),
        Task::Witnesses { count, seed } => witnesses::witnesses(count, seed),
        Task::Sliding { count, plot } => sliding::sliding(count, &plot).map_or_else(
            |error| {
                eprintln!("{}: {error}", plot.display());
                1
            },
            |()| 0,
        ),
    };
    ExitCode::from(u8::from(broken > 0))
}

/// Reproducible pseudo-random numbers by Marsaglia's xorshift.
struct Random(u64);

impl Random {
    const fn new(seed: u64, stream: u64) -> Self {
        // A state of zero is excluded, since the generator would never leave it.
        Self((seed ^ stream << 40).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        for four in bytes.chunks_mut(4) {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            four.copy_from_slice(&((self.0 >> 32) as u32).to_le_bytes()[..four.len()]);
        }
        bytes
    }
}
