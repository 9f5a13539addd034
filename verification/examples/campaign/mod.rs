//! The common part of the long runs: their options, a state that survives a kill, and a progress bar.

use indicatif::{ProgressBar, ProgressStyle};
use selvedge_verification::campaign::{Findings, Progress, Shard, StateFile, read};
use std::fmt::Display;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Instant, UNIX_EPOCH};

pub(crate) type Failure = Box<dyn std::error::Error + Send + Sync>;

/// The commit from which `verification/cluster/build.sh` builds. Without it shards cannot be joined.
const COMMIT: Option<&str> = option_env!("SELVEDGE_COMMIT");

/// The options of the command line.
pub(crate) struct Options {
    pub(crate) pairs: u64,
    pub(crate) seed: Option<u64>,
    pub(crate) shard: Shard,
    pub(crate) state: PathBuf,
    pub(crate) threads: usize,
}

impl Options {
    /// Parses `[PAIRS] [--seed N] [--shard I/N] [--state FILE] [--threads N]`. The defaults are `pairs`, and a file named after
    /// `name` and the shard in the folder for temporary files.
    ///
    /// `takes` gets each argument first, with those that follow, and returns whether it has used it. Returns `None` if the
    /// command line is invalid.
    pub(crate) fn parse(
        name: &str,
        pairs: u64,
        mut takes: impl FnMut(&str, &mut dyn Iterator<Item = String>) -> Option<bool>,
    ) -> Option<Self> {
        let (mut seed, mut shard, mut state, mut pairs) = (None, Shard::WHOLE, None, pairs);
        let mut threads = std::thread::available_parallelism().map_or(1, usize::from);
        let arguments = &mut std::env::args().skip(1);
        while let Some(argument) = arguments.next() {
            if takes(&argument, arguments)? {
                continue;
            }
            match argument.as_str() {
                "--seed" => seed = Some(arguments.next()?.parse().ok()?),
                "--shard" => shard = arguments.next()?.parse().ok()?,
                "--state" => state = Some(arguments.next()?.into()),
                "--threads" => threads = arguments.next()?.parse().ok().filter(|&n| n > 0)?,
                number => pairs = number.replace('_', "").parse().ok().filter(|&n| n > 0)?,
            }
        }
        // Shards examine the same run only if they have the same seed.
        if shard != Shard::WHOLE && seed.is_none() {
            return None;
        }
        let of_shard = if shard == Shard::WHOLE {
            format!("{name}.json")
        } else {
            format!("{name}-{}.json", shard.to_string().replace('/', "-of-"))
        };
        Some(Self {
            pairs,
            seed,
            shard,
            state: state.unwrap_or_else(|| std::env::temp_dir().join(of_shard)),
            threads,
        })
    }
}

/// Resumes the kept state, or starts `fresh` with a seed, and runs to the end. `run` gets a function to call with each state that
/// may be kept. Prints the findings, and returns the exit status: 0 if nothing is wrong, 1 if something is or a file is invalid.
pub(crate) fn exit<F>(
    options: &Options,
    fresh: impl Fn(u64) -> Progress<F>,
    run: impl FnOnce(Progress<F>, &(dyn Fn(&Progress<F>) + Sync)) -> Progress<F>,
) -> ExitCode
where
    F: Findings,
    Progress<F>: Display,
{
    match go_on(options, fresh, run) {
        Ok(progress) => {
            println!("seed {}, digest {}\n{progress}", progress.settings.seed, progress.digest);
            match progress.found.wrong() {
                0 => ExitCode::SUCCESS,
                _ => ExitCode::FAILURE,
            }
        }
        Err(failure) => failed(&*failure),
    }
}

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
    F: Findings,
{
    let path = &options.state;
    let file = StateFile::open(path, |message| eprintln!("{message}"))?;
    let command: Vec<String> = std::env::args().collect();
    let fresh = |seed| fresh(seed).of_shard(options.shard, COMMIT, &command.join(" "));
    let progress = match read::<F>(path)? {
        Some(kept) => {
            let asked = fresh(options.seed.unwrap_or(kept.settings.seed));
            let resume = kept.resume(asked);
            resume.map_err(|why| format!("{}: {why}; delete it, or name another file", path.display()))?
        }
        None => {
            let now = UNIX_EPOCH.elapsed().map_or(0, |time| time.as_secs());
            fresh(options.seed.unwrap_or(now))
        }
    };
    // A shard without chunks needs a file, too.
    file.keep(&progress)?;
    let shard = options.shard;
    eprintln!("seed {}, shard {shard}, state in {}", progress.settings.seed, path.display());

    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} chunks, {eta} left{msg}")?;
    let bar = ProgressBar::new(progress.range.end - progress.range.start).with_style(style);
    bar.set_position(progress.done.len());
    bar.reset_eta();
    let (begin, before) = (Instant::now(), progress.cases());
    let progress = run(progress, &|progress| {
        if let Err(failure) = file.keep(progress) {
            bar.suspend(|| eprintln!("{failure}"));
        }
        if progress.found.wrong() > 0 {
            bar.set_message(format!(", {} WRONG", progress.found.wrong()));
        }
        bar.inc(1);
    });
    bar.finish_and_clear();
    let pairs = progress.cases() - before;
    let seconds = begin.elapsed().as_secs_f64();
    let rate = pairs as f64 / seconds;
    eprintln!("{pairs} pairs in {seconds:.0} s, {rate:.0} a second");
    Ok(progress)
}
