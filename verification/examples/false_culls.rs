//! Counts the false culls of every tier over many pairs, random and adversarial, against exact arithmetic.
//!
//! `cargo run --release -p selvedge-verification --example false_culls -- [PAIRS] [--seed N] [--state FILE] [--threads N]`
//!
//! PAIRS for each of f32 and f64, by default 100 million. State is kept in FILE (by default `false_culls.json` in the folder for
//! temporary files): started again after a kill, the run goes on where it was. Exit status: 0 no certified tier has a false cull, 1 one
//! has, or the file is at fault, 2 the command line is.

use indicatif::{ProgressBar, ProgressStyle};
use selvedge_verification::false_culls::{Progress, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

const USAGE: &str = "usage: false_culls [PAIRS] [--seed N] [--state FILE] [--threads N]";
const PAIRS_PER_CHUNK: u64 = 50_000;

struct Options {
    pairs: u64,
    seed: Option<u64>,
    state: PathBuf,
    threads: usize,
}

fn main() -> ExitCode {
    let Some(options) = options(std::env::args().skip(1)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match count(&options) {
        Ok(progress) => {
            println!("seed {}\n{progress}", progress.seed);
            match progress.broken_promises() {
                0 => ExitCode::SUCCESS,
                _ => ExitCode::FAILURE,
            }
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn options(mut arguments: impl Iterator<Item = String>) -> Option<Options> {
    let mut options = Options {
        pairs: 100_000_000,
        seed: None,
        state: std::env::temp_dir().join("false_culls.json"),
        threads: std::thread::available_parallelism().map_or(1, usize::from),
    };
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--seed" => options.seed = Some(arguments.next()?.parse().ok()?),
            "--state" => options.state = arguments.next()?.into(),
            "--threads" => options.threads = arguments.next()?.parse().ok().filter(|&n| n > 0)?,
            pairs => options.pairs = pairs.replace('_', "").parse().ok().filter(|&n| n > 0)?,
        }
    }
    Some(options)
}

fn count(options: &Options) -> Result<Progress, String> {
    let path = &options.state;
    let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let progress = match fs::read_to_string(path) {
        Ok(text) => {
            let kept: Progress = serde_json::from_str(&text).map_err(|error| at(&error))?;
            let fresh = fresh(options, kept.seed);
            let is_same = kept.chunks == fresh.chunks
                && kept.pairs_per_chunk == fresh.pairs_per_chunk
                && kept
                    .rows
                    .iter()
                    .all(|rows| rows.len() == fresh.rows[0].len())
                && options.seed.is_none_or(|seed| seed == kept.seed);
            if !is_same {
                return Err(at(
                    &"the state of another run; delete it, or name another file",
                ));
            }
            kept
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let now = std::time::UNIX_EPOCH
                .elapsed()
                .map_or(0, |time| time.as_secs());
            fresh(options, options.seed.unwrap_or(now))
        }
        Err(error) => return Err(at(&error)),
    };
    eprintln!("seed {}, state in {}", progress.seed, path.display());
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} chunks, {eta} left{msg}");
    let bar = ProgressBar::new(2 * progress.chunks).with_style(style.expect("valid template"));
    bar.set_position(progress.done.len() as u64);
    bar.reset_eta();
    let (begin, before) = (Instant::now(), progress.done.len());
    let progress = run(
        progress,
        options.threads,
        |progress| {
            if let Err(error) = keep(path, progress) {
                bar.suspend(|| eprintln!("{}", at(&error)));
            }
            if progress.broken_promises() > 0 {
                bar.set_message(format!(", {} FALSE CULLS", progress.broken_promises()));
            }
            bar.inc(1);
        },
        || false,
    );
    bar.finish_and_clear();
    let pairs = (progress.done.len() - before) as u64 * PAIRS_PER_CHUNK;
    let seconds = begin.elapsed().as_secs_f64();
    eprintln!(
        "{pairs} pairs in {seconds:.0} s, {:.0} a second",
        pairs as f64 / seconds
    );
    Ok(progress)
}

fn fresh(options: &Options, seed: u64) -> Progress {
    Progress::new(seed, options.pairs, PAIRS_PER_CHUNK)
}

/// Replaces the file in one step: a kill leaves the old state or the new one.
fn keep(path: &Path, progress: &Progress) -> std::io::Result<()> {
    let next = path.with_extension("next");
    fs::write(&next, serde_json::to_vec(progress)?)?;
    fs::rename(next, path)
}
