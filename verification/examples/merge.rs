//! Joins the shards of a campaign (`exact_campaign`) to the state that a single run would have, and prints it.
//!
//! `cargo run --release -p selvedge-verification --example merge -- SHARD... --state FILE`
//!
//! SHARDs are the state files of all shards, in any order. The joined state goes to FILE, which must not exist, unless it holds
//! the same state. Gaps, overlaps, unfinished shards, different commits and different settings are refused; the message names the
//! files. The exit status is 0 if no promise is broken, 1 if one is or shards are refused, 2 for a wrong command line.

use clap::Parser;
use selvedge_verification::campaign::exact::{ExactFindings, Progress};
use selvedge_verification::campaign::{Findings, StateFile, merge, read};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Parser)]
struct Options {
    #[arg(required = true)]
    shards: Vec<PathBuf>,
    /// The file of the joined state.
    #[arg(long)]
    state: PathBuf,
}

fn main() -> ExitCode {
    let Options { shards, state } = Options::parse();
    match join(&shards, &state) {
        Ok(wrong) => ExitCode::from(u8::from(wrong > 0)),
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

/// Joins the shards, keeps the state, and returns the number of broken promises.
fn join(shards: &[PathBuf], state: &Path) -> Result<u64, Box<dyn Error>> {
    let read_one = |file: &PathBuf| -> Result<_, Box<dyn Error>> {
        let shard = read::<ExactFindings>(file)?;
        let shard = shard.ok_or_else(|| format!("{}: there is no such file: was this shard started?", file.display()))?;
        Ok((file.clone(), shard))
    };
    let read_all: Result<Vec<_>, _> = shards.iter().map(read_one).collect();
    let mut joined = merge(read_all?)?;
    joined.command = std::env::args().collect::<Vec<_>>().join(" ");
    let file = StateFile::open(state, |message| eprintln!("{message}"))?;
    let is_another = |kept: Progress| kept.settings != joined.settings || kept.digest != joined.digest;
    if read::<ExactFindings>(state)?.is_some_and(is_another) {
        return Err(format!("{}: holds another state; delete it, or name another file", state.display()).into());
    }
    file.keep(&joined)?;
    let (seed, digest) = (joined.settings.seed, joined.digest);
    println!("seed {seed}, digest {digest}, of {} shards\n{joined}", shards.len());
    Ok(joined.found.wrong())
}
