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

use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "usage: time_of_impact alarms COUNT [SEED] | witnesses COUNT [SEED] | sliding COUNT PLOT.svg";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let number = |text: &str| text.parse::<u64>().ok();
    let broken = match *arguments {
        [task @ ("alarms" | "witnesses"), count, ref seed @ ..] if seed.len() < 2 => {
            let task = if task == "alarms" {
                alarms::alarms
            } else {
                witnesses::witnesses
            };
            let seed = seed.first().map_or(Some(1), |seed| number(seed));
            number(count).zip(seed).map(|(count, seed)| task(count, seed))
        }
        ["sliding", count, plot] => number(count).map(|count| match sliding::sliding(count, Path::new(plot)) {
            Ok(()) => 0,
            Err(error) => {
                eprintln!("{plot}: {error}");
                1
            }
        }),
        _ => None,
    };
    match broken {
        Some(0) => ExitCode::SUCCESS,
        Some(_) => ExitCode::FAILURE,
        None => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
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
