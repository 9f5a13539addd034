//! What the long runs share: their options, a state that survives a kill, and a progress bar.

use indicatif::{ProgressBar, ProgressStyle};
use selvedge_verification::campaign::{Findings, Progress};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Display;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Instant, UNIX_EPOCH};

pub(crate) type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Of the command line.
pub(crate) struct Options {
    pub(crate) pairs: u64,
    pub(crate) seed: Option<u64>,
    pub(crate) state: PathBuf,
    pub(crate) threads: usize,
}

impl Options {
    /// `[PAIRS] [--seed N] [--state FILE] [--threads N]`; by default `pairs`, and a file of `name` in the folder for temporary
    /// files. `takes` is asked first whether an argument is one of its own, and takes what follows it; `None` if the command line
    /// is at fault.
    pub(crate) fn parse(
        name: &str,
        pairs: u64,
        mut takes: impl FnMut(&str, &mut dyn Iterator<Item = String>) -> Option<bool>,
    ) -> Option<Self> {
        let mut options = Self {
            pairs,
            seed: None,
            state: std::env::temp_dir().join(name).with_extension("json"),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
        };
        let arguments = &mut std::env::args().skip(1);
        while let Some(argument) = arguments.next() {
            if takes(&argument, arguments)? {
                continue;
            }
            match argument.as_str() {
                "--seed" => options.seed = Some(arguments.next()?.parse().ok()?),
                "--state" => options.state = arguments.next()?.into(),
                "--threads" => {
                    options.threads = arguments.next()?.parse().ok().filter(|&n| n > 0)?;
                }
                pairs => options.pairs = pairs.replace('_', "").parse().ok().filter(|&n| n > 0)?,
            }
        }
        Some(options)
    }
}

/// Goes on from the state that is kept, or from `fresh` of a seed, to the end: `run` does it, and tells the function that it is
/// given of each state that may be kept. Then prints what was found, and says how the program ends: 0 nothing is wrong, 1 something
/// is, or a file is at fault.
pub(crate) fn exit<F>(
    options: &Options,
    fresh: impl Fn(u64) -> Progress<F>,
    run: impl FnOnce(Progress<F>, &(dyn Fn(&Progress<F>) + Sync)) -> Progress<F>,
) -> ExitCode
where
    F: Findings + Serialize + DeserializeOwned,
    Progress<F>: Display,
{
    match go_on(options, fresh, run) {
        Ok(progress) => {
            println!("seed {}\n{progress}", progress.seed);
            match progress.found.wrong() {
                0 => ExitCode::SUCCESS,
                _ => ExitCode::FAILURE,
            }
        }
        Err(failure) => failed(&*failure),
    }
}

/// Says what went wrong.
pub(crate) fn failed(failure: &dyn Display) -> ExitCode {
    eprintln!("{failure}");
    ExitCode::FAILURE
}

fn go_on<F>(
    options: &Options,
    fresh: impl Fn(u64) -> Progress<F>,
    run: impl FnOnce(Progress<F>, &(dyn Fn(&Progress<F>) + Sync)) -> Progress<F>,
) -> Result<Progress<F>, Failure>
where
    F: Findings + Serialize + DeserializeOwned,
{
    let path = &options.state;
    let progress = match kept(path)? {
        Some(kept) => {
            let seed = options.seed.unwrap_or(kept.seed);
            if !kept.is_of_the_same_run(&fresh(seed)) {
                return Err(at(path, &"the state of another run; delete it, or name another file"));
            }
            kept
        }
        None => {
            let now = UNIX_EPOCH.elapsed().map_or(0, |time| time.as_secs());
            fresh(options.seed.unwrap_or(now))
        }
    };
    eprintln!("seed {}, state in {}", progress.seed, path.display());

    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} chunks, {eta} left{msg}")?;
    let bar = ProgressBar::new(progress.chunks).with_style(style);
    bar.set_position(progress.done.len() as u64);
    bar.reset_eta();
    let (begin, before) = (Instant::now(), progress.done.len());
    let progress = run(progress, &|progress| {
        if let Err(failure) = keep(path, progress) {
            bar.suspend(|| eprintln!("{failure}"));
        }
        if progress.found.wrong() > 0 {
            bar.set_message(format!(", {} WRONG", progress.found.wrong()));
        }
        bar.inc(1);
    });
    bar.finish_and_clear();
    let pairs = (progress.done.len() - before) as u64 * progress.pairs_per_chunk;
    let seconds = begin.elapsed().as_secs_f64();
    let rate = pairs as f64 / seconds;
    eprintln!("{pairs} pairs in {seconds:.0} s, {rate:.0} a second");
    Ok(progress)
}

fn kept<F: DeserializeOwned>(path: &Path) -> Result<Option<Progress<F>>, Failure> {
    match fs::read(path) {
        Ok(bytes) => {
            let progress = serde_json::from_slice(&bytes).map_err(|error| at(path, &error))?;
            Ok(Some(progress))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(at(path, &error)),
    }
}

/// Replaces the file in one step: a kill leaves the old state or the new one.
fn keep<F: Serialize>(path: &Path, progress: &Progress<F>) -> Result<(), Failure> {
    let next = path.with_extension("next");
    let bytes = serde_json::to_vec(progress)?;
    fs::write(&next, bytes)
        .and_then(|()| fs::rename(&next, path))
        .map_err(|error| at(path, &error))
}

fn at(path: &Path, message: &dyn Display) -> Failure {
    format!("{}: {message}", path.display()).into()
}
