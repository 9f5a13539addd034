//! A billion pairs through the certified filter, box tests and the time of impact. Exact arithmetic checks every claim.
//!
//! `cargo run --release -p selvedge-verification --example exact_campaign -- --help`
//!
//! The pairs are `f32` and `f64`, random, adversarial and from scenes in equal parts. The scenes are a bending tube and the steps
//! between the named meshes. A run that was killed resumes from its state. The shards of a run are joined by `--example merge`. The
//! exit status is 0 if no claim is wrong, 1 if one is or a file is invalid, 2 for a wrong command line.

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use selvedge::simd::best_level;
use selvedge_files::mesh::read_step;
use selvedge_verification::campaign::exact::{Claim, ExactFindings, Progress, Scenes, run};
use selvedge_verification::campaign::{Findings, Shard, StateFile, read};
use selvedge_verification::generator::BendingTube;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Instant, UNIX_EPOCH};

type Failure = Box<dyn std::error::Error + Send + Sync>;

const PAIRS_PER_CHUNK: u64 = 1 << 20;
/// The largest number of pairs of each kind that a step gives, evenly spaced.
const PAIRS_OF_A_STEP: usize = 200_000;
/// The commit from which `verification/cluster/build.sh` builds. Without it shards cannot be joined.
const COMMIT: Option<&str> = option_env!("SELVEDGE_COMMIT");

#[derive(Parser)]
struct Options {
    /// The number of pairs.
    #[arg(default_value = "1_000_000_000", value_parser = |text: &str| text.replace('_', "").parse::<u64>())]
    pairs: u64,
    /// The seed of the run, by default the time.
    #[arg(long)]
    seed: Option<u64>,
    /// Run one of N parts: I/N, I from 1 to N. All parts have the same seed.
    #[arg(long, default_value_t = Shard::WHOLE, requires = "seed")]
    shard: Shard,
    /// The file of the state, by default in the folder for temporary files.
    #[arg(long)]
    state: Option<PathBuf>,
    #[arg(long)]
    threads: Option<usize>,
    /// A step between two meshes.
    #[arg(long, num_args = 2, value_names = ["START", "END"])]
    mesh: Vec<PathBuf>,
}

fn main() -> ExitCode {
    match go_on(&Options::parse()) {
        Ok(progress) => {
            println!("seed {}, digest {}\n{progress}", progress.settings.seed, progress.digest);
            ExitCode::from(u8::from(progress.found.wrong() > 0))
        }
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn scenes(meshes: &[PathBuf]) -> Result<Scenes, Failure> {
    let mut scenes = Scenes::default();
    let tube = BendingTube::new(1);
    for step in [30, 45, BendingTube::STEPS - 1] {
        scenes.add_step(tube.topology(), &tube.frame(step), &tube.frame(step + 1), PAIRS_OF_A_STEP)?;
    }
    for ends in meshes.chunks(2) {
        let step = read_step(&ends[0], &ends[1])?;
        scenes.add_step(&step.topology, &step.start, &step.end, PAIRS_OF_A_STEP)?;
    }
    eprintln!(
        "scenes: {} VF and {} EE pairs",
        scenes.vertex_face.len(),
        scenes.edge_edge.len()
    );
    Ok(scenes)
}

/// Resumes the kept state, or starts a run, and runs to the end.
fn go_on(options: &Options) -> Result<Progress, Failure> {
    let scenes = scenes(&options.mesh)?;
    let shard = options.shard;
    let name = match shard {
        Shard::WHOLE => "exact_campaign.json".to_owned(),
        _ => format!("exact_campaign-{}.json", shard.to_string().replace('/', "-of-")),
    };
    let path = options.state.clone().unwrap_or_else(|| std::env::temp_dir().join(name));
    let file = StateFile::open(&path, |message| eprintln!("{message}"))?;
    let command: Vec<String> = std::env::args().collect();
    let fresh = |seed| {
        let fresh = Progress::new(seed, options.pairs, PAIRS_PER_CHUNK, &scenes, &Claim::CERTIFIED);
        fresh.of_shard(shard, COMMIT, &command.join(" "))
    };
    let progress = match read::<ExactFindings>(&path)? {
        Some(kept) => {
            let asked = fresh(options.seed.unwrap_or(kept.settings.seed));
            let resume = kept.resume(asked);
            resume.map_err(|why| format!("{}: {why}; delete it, or name another file", path.display()))?
        }
        None => fresh(
            options
                .seed
                .unwrap_or_else(|| UNIX_EPOCH.elapsed().map_or(0, |time| time.as_secs())),
        ),
    };
    // A shard without chunks needs a file, too.
    file.keep(&progress)?;
    eprintln!("seed {}, shard {shard}, state in {}", progress.settings.seed, path.display());

    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} chunks, {eta} left{msg}")?;
    let bar = ProgressBar::new(progress.range.end - progress.range.start).with_style(style);
    bar.set_position(progress.done.len());
    bar.reset_eta();
    let (begin, before) = (Instant::now(), progress.cases());
    let after_chunk = |progress: &Progress| {
        if let Err(failure) = file.keep(progress) {
            bar.suspend(|| eprintln!("{failure}"));
        }
        if progress.found.wrong() > 0 {
            bar.set_message(format!(", {} WRONG", progress.found.wrong()));
        }
        bar.inc(1);
    };
    let threads = options
        .threads
        .or_else(|| std::thread::available_parallelism().ok().map(usize::from));
    let progress = run(
        progress,
        &scenes,
        best_level(),
        threads.unwrap_or(1).max(1),
        after_chunk,
        || false,
    );
    bar.finish_and_clear();
    let pairs = progress.cases() - before;
    let seconds = begin.elapsed().as_secs_f64();
    let rate = pairs as f64 / seconds;
    eprintln!("{pairs} pairs in {seconds:.0} s, {rate:.0} a second");
    Ok(progress)
}
