//! Joins the shards of a campaign (`exact_campaign`, `screw_motions`) to the state that a single run would have, and prints it.
//!
//! `cargo run --release -p selvedge-verification --example merge -- SHARD... --state FILE`
//!
//! SHARDs are the state files of all shards, in any order. The joined state goes to FILE, which must not exist, unless it holds
//! the same state. Gaps, overlaps, unfinished shards, different commits and different settings are refused; the message names the
//! files. The exit status is 0 if no promise is broken, 1 if one is or shards are refused, 2 for a wrong command line.

use selvedge_verification::campaign::{Findings, Progress, StateFile, exact, merge, read, screw_motions};
use serde::Deserialize;
use std::error::Error;
use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "usage: merge SHARD... --state FILE";

fn main() -> ExitCode {
    let Some((shards, state)) = parse() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match join(&shards, &state) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn parse() -> Option<(Vec<PathBuf>, PathBuf)> {
    let (mut shards, mut state) = (Vec::new(), None);
    let mut arguments = std::env::args_os().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--state" {
            state = Some(arguments.next()?.into());
        } else {
            shards.push(argument.into());
        }
    }
    Some((shards, state?)).filter(|(shards, _)| !shards.is_empty())
}

/// Joins the shards, keeps the state, and returns the number of broken promises.
fn join(shards: &[PathBuf], state: &Path) -> Result<u64, Box<dyn Error>> {
    match campaign(&shards[0])?.as_str() {
        exact::ExactFindings::CAMPAIGN => join_of::<exact::ExactFindings>(shards, state),
        screw_motions::ScrewFindings::CAMPAIGN => join_of::<screw_motions::ScrewFindings>(shards, state),
        other => Err(format!("{}: there is no campaign {other:?}", shards[0].display()).into()),
    }
}

fn campaign(file: &Path) -> Result<String, Box<dyn Error>> {
    #[derive(Deserialize)]
    struct OfAny {
        campaign: String,
    }
    let at = |error: &dyn Display| format!("{}: {error}", file.display());
    let bytes = fs::read(file).map_err(|error| at(&error))?;
    let state: OfAny = serde_json::from_slice(&bytes).map_err(|error| at(&error))?;
    Ok(state.campaign)
}

fn join_of<F: Findings>(shards: &[PathBuf], state: &Path) -> Result<u64, Box<dyn Error>>
where
    Progress<F>: Display,
{
    let read_one = |file: &PathBuf| -> Result<_, Box<dyn Error>> {
        let shard = read::<F>(file)?;
        let shard = shard.ok_or_else(|| format!("{}: there is no such file: was this shard started?", file.display()))?;
        Ok((file.clone(), shard))
    };
    let read_all: Result<Vec<_>, _> = shards.iter().map(read_one).collect();
    let mut joined = merge(read_all?)?;
    joined.command = std::env::args().collect::<Vec<_>>().join(" ");
    let file = StateFile::open(state, |message| eprintln!("{message}"))?;
    let is_another = |kept: Progress<F>| kept.settings != joined.settings || kept.digest != joined.digest;
    if read::<F>(state)?.is_some_and(is_another) {
        return Err(format!("{}: holds another state; delete it, or name another file", state.display()).into());
    }
    file.keep(&joined)?;
    let (seed, digest) = (joined.settings.seed, joined.digest);
    println!("seed {seed}, digest {digest}, of {} shards\n{joined}", shards.len());
    Ok(joined.found.wrong())
}
