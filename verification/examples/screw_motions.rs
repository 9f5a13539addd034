//! Bodies in screw motion that meet. Enclosures of their arcs check that no time of impact is late.
//!
//! `cargo run --release -p selvedge-verification --example screw_motions -- [CASES] [--seed N] [--shard I/N] [--state FILE]
//! [--threads N]`
//!
//! CASES is the number of cases, by default 100 million, of both kinds of pairs. The state is kept in FILE (by default
//! `screw_motions.json` in the folder for temporary files), and a run that was killed resumes from it. With `--shard I/N`, I from
//! 1 to N, and `--seed`, it is one of N parts of the run, which `--example merge` joins. The exit status is 0 if no time is late,
//! 1 if one is or the file is invalid, 2 for a wrong command line.

mod campaign;

use campaign::Options;
use selvedge_verification::campaign::screw_motions::{MotionPaths, Progress, run};
use std::process::ExitCode;

const USAGE: &str = "usage: screw_motions [CASES] [--seed N] [--shard I/N] [--state FILE] [--threads N]";
const CASES_PER_CHUNK: u64 = 50_000;

fn main() -> ExitCode {
    let Some(options) = Options::parse("screw_motions", 100_000_000, |_, _| Some(false)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    campaign::exit(
        &options,
        |seed| Progress::new(seed, options.pairs, CASES_PER_CHUNK, MotionPaths::Arcs),
        |progress, after_chunk| run(progress, MotionPaths::Arcs, options.threads, after_chunk, || false),
    )
}
