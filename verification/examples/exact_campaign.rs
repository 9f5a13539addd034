//! A billion pairs through the certified filter, box tests and the time of impact. Exact arithmetic checks every claim.
//!
//! `cargo run --release -p selvedge-verification --example exact_campaign -- --help`
//!
//! The pairs are `f32` and `f64`, random, adversarial and from scenes in equal parts. The scenes are a bending tube and the steps
//! between the named meshes. Several machines take a seed each; `--sum` adds the files that they write. The exit status is 0 if
//! no claim is wrong, 1 if one is or a file is invalid, 2 for a wrong command line.

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use selvedge::simd::best_level;
use selvedge_files::mesh::read_step;
use selvedge_verification::campaign::{CampaignFindings, Run, Scenes, TestedClaim};
use selvedge_verification::generator::BendingTube;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Instant, UNIX_EPOCH};

type Failure = Box<dyn std::error::Error + Send + Sync>;

const PAIRS_PER_CHUNK: u64 = 1 << 20;
/// The largest number of pairs of each kind that a step gives, evenly spaced.
const PAIRS_OF_A_STEP: usize = 200_000;

#[derive(Parser)]
struct Options {
    /// The number of pairs.
    #[arg(default_value = "1_000_000_000", value_parser = |text: &str| text.replace('_', "").parse::<u64>())]
    pairs: u64,
    /// The seed of the run, by default the time. Runs with other seeds test other pairs.
    #[arg(long)]
    seed: Option<u64>,
    /// Write the counts to this file, as JSON.
    #[arg(long)]
    json: Option<PathBuf>,
    /// Add the counts of these files instead of running.
    #[arg(long, num_args = 1.., value_name = "JSON")]
    sum: Vec<PathBuf>,
    #[arg(long)]
    threads: Option<usize>,
    /// A step between two meshes.
    #[arg(long, num_args = 2, value_names = ["START", "END"])]
    mesh: Vec<PathBuf>,
}

fn main() -> ExitCode {
    let options = Options::parse();
    let found = if options.sum.is_empty() {
        run(&options)
    } else {
        sum(&options.sum)
    };
    match found {
        Ok(found) => {
            println!("{found}");
            ExitCode::from(u8::from(found.wrong() > 0))
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
    Ok(scenes)
}

fn sum(files: &[PathBuf]) -> Result<CampaignFindings, Failure> {
    let mut sum: Option<CampaignFindings> = None;
    for file in files {
        let wrong = |why: &dyn std::fmt::Display| format!("{}: {why}", file.display());
        let text = std::fs::read_to_string(file).map_err(|error| wrong(&error))?;
        let found: CampaignFindings = serde_json::from_str(&text).map_err(|error| wrong(&error))?;
        sum.get_or_insert_with(|| CampaignFindings::nothing(&found.claims))
            .add(found)
            .map_err(|claims| wrong(&format!("counts of other claims, {claims:?}")))?;
    }
    sum.ok_or_else(|| "no file to add".into())
}

fn run(options: &Options) -> Result<CampaignFindings, Failure> {
    let scenes = scenes(&options.mesh)?;
    let seed = options
        .seed
        .unwrap_or_else(|| UNIX_EPOCH.elapsed().map_or(0, |time| time.as_secs()));
    let run = Run {
        seed,
        chunks: options.pairs.div_ceil(PAIRS_PER_CHUNK),
        pairs_per_chunk: PAIRS_PER_CHUNK,
        scenes: &scenes,
        claims: &TestedClaim::CERTIFIED,
        level: best_level(),
    };
    let (vertex_face, edge_edge) = (scenes.vertex_face.len(), scenes.edge_edge.len());
    eprintln!("seed {seed}, {vertex_face} VF and {edge_edge} EE pairs of scenes");
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} chunks, {eta} left{msg}")?;
    let bar = ProgressBar::new(run.chunks).with_style(style);
    let begin = Instant::now();
    let threads = options
        .threads
        .or_else(|| std::thread::available_parallelism().ok().map(usize::from));
    let found = run.findings(threads.unwrap_or(1).max(1), |found| {
        if found.wrong() > 0 {
            bar.set_message(format!(", {} WRONG", found.wrong()));
        }
        bar.inc(1);
    });
    bar.finish_and_clear();
    let seconds = begin.elapsed().as_secs_f64();
    eprintln!("{:.0} s, {:.0} pairs a second", seconds, found.pairs as f64 / seconds);
    if let Some(path) = &options.json {
        let text = serde_json::to_string(&found)?;
        std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(found)
}
