//! A billion pairs through the certified filters, box tests and the time of impact, every claim checked by exact arithmetic.
//!
//! `cargo run --release -p selvedge-verification --example exact_campaign -- [PAIRS] [--seed N] [--shard I/N] [--state FILE]
//! [--threads N] [--mesh START END]...`
//!
//! PAIRS in all, by default a billion: of `f32` and `f64`, random, adversarial and from scenes in equal parts. Scenes are the built-in arm, and
//! the steps between meshes that are named. State is kept in FILE (by default `exact_campaign.json` in the folder for temporary
//! files): started again after a kill, the run goes on where it was. With
//! `--shard I/N`, I from 1 to N, and `--seed`, it is one of N parts of the run, which `--example merge` joins. Exit status: 0 no claim is wrong, 1 one is, or a file is at
//! fault, 2 the command line is.

mod campaign;

use campaign::{Failure, Options};
use selvedge::glam::DVec3;
use selvedge::simd::best_level;
use selvedge_files::mesh::read_step;
use selvedge_laboratory::study::{ArmFrames, Frames, PairSet, TwoFrames};
use selvedge_verification::campaign::exact::{Claim, Progress, Scenes, run};
use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "usage: exact_campaign [PAIRS] [--seed N] [--shard I/N] [--state FILE] [--threads N] [--mesh START END]...";
const PAIRS_PER_CHUNK: u64 = 1 << 20;
/// From each scene, evenly spaced runs.
const SCENE_PAIRS: usize = 400_000;

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
    let arm = ArmFrames::new(1, 120)?;
    let last = arm.step_count() - 1;
    let steps = [last / 2, 3 * last / 4, last].map(|frame| (frame, DVec3::ZERO));
    let set = PairSet::from_steps("arm".to_owned(), &arm, &steps, SCENE_PAIRS)?;
    add(&mut scenes, &set);
    for [start, end] in meshes {
        let step = read_step(start, end)?;
        let frames = TwoFrames {
            name: "mesh".to_owned(),
            topology: step.topology,
            start: step.start,
            end: step.end,
        };
        let set = PairSet::from_steps("mesh".to_owned(), &frames, &[(0, DVec3::ZERO)], SCENE_PAIRS)?;
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
    let points = |indices: &[u32; 4]| indices.map(|index| set.points[index as usize].map(|position| position.to_array()));
    scenes.vertex_face.extend(set.vertex_face.iter().map(points));
    scenes.edge_edge.extend(set.edge_edge.iter().map(points));
}
