//! Counts the false culls of every tier over many pairs, random and adversarial, against exact arithmetic.
//!
//! `cargo run --release -p selvedge-verification --example false_culls -- [PAIRS] [--seed N] [--shard I/N] [--state FILE]
//! [--threads N]`
//!
//! PAIRS for each of f32 and f64, by default 100 million. State is kept in FILE (by default `false_culls.json` in the folder for
//! temporary files): started again after a kill, the run goes on where it was. With
//! `--shard I/N`, I from 1 to N, and `--seed`, it is one of N parts of the run, which `--example merge` joins. Exit status: 0 no certified tier has a false cull, 1
//! one has, or the file is at fault, 2 the command line is.

mod campaign;

use campaign::Options;
use selvedge_verification::campaign::false_culls::{Progress, run};
use std::process::ExitCode;

const USAGE: &str = "usage: false_culls [PAIRS] [--seed N] [--shard I/N] [--state FILE] [--threads N]";
const PAIRS_PER_CHUNK: u64 = 50_000;

fn main() -> ExitCode {
    let Some(options) = Options::parse("false_culls", 100_000_000, |_, _| Some(false)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    campaign::exit(
        &options,
        |seed| Progress::new(seed, options.pairs, PAIRS_PER_CHUNK),
        |progress, after_chunk| run(progress, options.threads, after_chunk, || false),
    )
}
