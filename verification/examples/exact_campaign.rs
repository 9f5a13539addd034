//! A billion pairs through the certified filters, box tests and the time of impact. Exact arithmetic checks every claim.
//!
//! `cargo run --release -p selvedge-verification --example exact_campaign -- [PAIRS] [--seed N] [--shard I/N] [--state FILE]
//! [--threads N] [--mesh START END]...`
//!
//! PAIRS is the number of pairs, by default a billion: `f32` and `f64`, random, adversarial and from scenes in equal parts. The
//! scenes are a bending tube and the steps between the named meshes. The state is kept in FILE (by default `exact_campaign.json`
//! in the folder for temporary files), and a run that was killed resumes from it. With `--shard I/N`, I from 1 to N, and
//! `--seed`, it is one of N parts of the run, which `--example merge` joins. The exit status is 0 if no claim is wrong, 1 if one
//! is or a file is invalid, 2 for a wrong command line.

mod campaign;

use campaign::{Failure, Options};
use selvedge::simd::best_level;
use selvedge_files::mesh::read_step;
use selvedge_verification::campaign::exact::{Claim, Progress, Scenes, run};
use selvedge_verification::generator::BendingTube;
use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "usage: exact_campaign [PAIRS] [--seed N] [--shard I/N] [--state FILE] [--threads N] [--mesh START END]...";
const PAIRS_PER_CHUNK: u64 = 1 << 20;
/// The largest number of pairs of each kind that a step gives, evenly spaced.
const PAIRS_OF_A_STEP: usize = 200_000;

fn main() -> ExitCode {
    let mut meshes = Vec::new();
    let options = Options::parse("exact_campaign", 1_000_000_000, |argument, following| {
        if argument != "--mesh" {
            return Some(false);
        }
        meshes.push([following.next()?.into(), following.next()?.into()]);
        Some(true)
    });
    let Some(options) = options else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let scenes = match scenes(&meshes) {
        Ok(scenes) => scenes,
        Err(failure) => return campaign::failed(&failure),
    };
    let (level, threads) = (best_level(), options.threads);
    campaign::exit(
        &options,
        |seed| Progress::new(seed, options.pairs, PAIRS_PER_CHUNK, &scenes, &Claim::CERTIFIED),
        |progress, after_chunk| run(progress, &scenes, level, threads, after_chunk, || false),
    )
}

fn scenes(meshes: &[[PathBuf; 2]]) -> Result<Scenes, Failure> {
    let mut scenes = Scenes::default();
    let tube = BendingTube::new(1);
    for step in [30, 45, BendingTube::STEPS - 1] {
        scenes.add_step(tube.topology(), &tube.frame(step), &tube.frame(step + 1), PAIRS_OF_A_STEP)?;
    }
    for [start, end] in meshes {
        let step = read_step(start, end)?;
        scenes.add_step(&step.topology, &step.start, &step.end, PAIRS_OF_A_STEP)?;
    }
    eprintln!(
        "scenes: {} VF and {} EE pairs",
        scenes.vertex_face.len(),
        scenes.edge_edge.len()
    );
    Ok(scenes)
}
