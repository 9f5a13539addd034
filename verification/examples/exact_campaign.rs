//! A billion pairs through the certified filters, box tests and the time of impact, every claim checked by exact arithmetic.
//!
//! `cargo run --release -p selvedge-verification --example exact_campaign -- [PAIRS] [--seed N] [--state FILE] [--threads N]
//! [--mesh START END]...`
//!
//! PAIRS in all, by default a billion: of `f32` and `f64`, random, adversarial and from scenes in equal parts. Scenes are the built-in arm, and
//! the steps between meshes that are named. State is kept in FILE (by default `exact_campaign.json` in the folder for temporary
//! files): started again after a kill, the run goes on where it was. Exit status: 0 no claim is wrong, 1 one is, or a file is at
//! fault, 2 the command line is.

use indicatif::{ProgressBar, ProgressStyle};
use selvedge::dispatch::best_level;
use selvedge::glam::DVec3;
use selvedge::mesh::read_step;
use selvedge::study::{ArmFrames, Frames, PairSet, TwoFrames};
use selvedge_verification::exact_campaign::{Claim, Progress, Scenes, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

const USAGE: &str =
    "usage: exact_campaign [PAIRS] [--seed N] [--state FILE] [--threads N] [--mesh START END]...";
const PAIRS_PER_CHUNK: u64 = 1 << 20;
/// From each scene, evenly spaced runs.
const SCENE_PAIRS: usize = 400_000;

type Failure = Box<dyn std::error::Error + Send + Sync>;

struct Options {
    pairs: u64,
    seed: Option<u64>,
    state: PathBuf,
    threads: usize,
    meshes: Vec<[PathBuf; 2]>,
}

fn main() -> ExitCode {
    let Some(options) = options(std::env::args().skip(1)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match campaign(&options) {
        Ok(progress) => {
            println!("seed {}\n{progress}", progress.seed);
            if progress.wrong() == 0 {
                ExitCode::SUCCESS
            } else {
                ExitCode::FAILURE
            }
        }
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn options(mut arguments: impl Iterator<Item = String>) -> Option<Options> {
    let mut options = Options {
        pairs: 1_000_000_000,
        seed: None,
        state: std::env::temp_dir().join("exact_campaign.json"),
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        meshes: Vec::new(),
    };
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--seed" => options.seed = Some(arguments.next()?.parse().ok()?),
            "--state" => options.state = arguments.next()?.into(),
            "--threads" => options.threads = arguments.next()?.parse().ok().filter(|&n| n > 0)?,
            "--mesh" => options
                .meshes
                .push([arguments.next()?.into(), arguments.next()?.into()]),
            pairs => options.pairs = pairs.replace('_', "").parse().ok().filter(|&n| n > 0)?,
        }
    }
    Some(options)
}

fn campaign(options: &Options) -> Result<Progress, Failure> {
    let scenes = scenes(options)?;
    let path = &options.state;
    let fresh = |seed| {
        Progress::new(
            seed,
            options.pairs,
            PAIRS_PER_CHUNK,
            &scenes,
            &Claim::CERTIFIED,
        )
    };
    let progress = match fs::read(path) {
        Ok(bytes) => {
            let kept: Progress = serde_json::from_slice(&bytes)?;
            let seed = options.seed.unwrap_or(kept.seed);
            if !kept.is_of_the_same_run(&fresh(seed)) {
                let path = path.display();
                return Err(format!(
                    "{path}: the state of another run; delete it, or name another file"
                )
                .into());
            }
            kept
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let now = std::time::UNIX_EPOCH
                .elapsed()
                .map_or(0, |time| time.as_secs());
            fresh(options.seed.unwrap_or(now))
        }
        Err(error) => return Err(format!("{}: {error}", path.display()).into()),
    };
    eprintln!("seed {}, state in {}", progress.seed, path.display());

    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} million pairs, {eta} left{msg}");
    let bar = ProgressBar::new(progress.chunks).with_style(style?);
    bar.set_position(progress.done.len() as u64);
    bar.reset_eta();
    let (begin, before) = (Instant::now(), progress.done.len());
    let after_chunk = |progress: &Progress| {
        if let Err(error) = keep(path, progress) {
            bar.suspend(|| eprintln!("{}: {error}", path.display()));
        }
        if progress.wrong() > 0 {
            bar.set_message(format!(", {} WRONG CLAIMS", progress.wrong()));
        }
        bar.inc(1);
    };
    let progress = run(
        progress,
        &scenes,
        best_level(),
        options.threads,
        after_chunk,
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

fn scenes(options: &Options) -> Result<Scenes, Failure> {
    let mut scenes = Scenes::default();
    let arm = ArmFrames::new(1, 120)?;
    let last = arm.step_count() - 1;
    let steps = [last / 2, 3 * last / 4, last].map(|frame| (frame, DVec3::ZERO));
    let set = PairSet::of_steps("arm".to_owned(), &arm, &steps, SCENE_PAIRS)?;
    add(&mut scenes, &set);
    for [start, end] in &options.meshes {
        let step = read_step(start, end)?;
        let frames = TwoFrames {
            name: "mesh".to_owned(),
            topology: step.topology,
            start: step.start,
            end: step.end,
        };
        let set = PairSet::of_steps("mesh".to_owned(), &frames, &[(0, DVec3::ZERO)], SCENE_PAIRS)?;
        add(&mut scenes, &set);
    }
    eprintln!(
        "scenes: {} VF and {} EE pairs",
        scenes.vertex_face.len(),
        scenes.edge_edge.len()
    );
    Ok(scenes)
}

fn add(scenes: &mut Scenes, set: &PairSet) {
    let points = |indices: &[u32; 4]| {
        indices.map(|index| set.points[index as usize].map(|position| position.to_array()))
    };
    scenes
        .vertex_face
        .extend(set.vertex_face.iter().map(points));
    scenes.edge_edge.extend(set.edge_edge.iter().map(points));
}

/// Replaces the file in one step: a kill leaves the old state or the new one.
fn keep(path: &Path, progress: &Progress) -> std::io::Result<()> {
    let next = path.with_extension("next");
    fs::write(&next, serde_json::to_vec(progress)?)?;
    fs::rename(next, path)
}
