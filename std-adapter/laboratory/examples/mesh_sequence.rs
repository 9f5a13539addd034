//! Finds the contacts of a mesh sequence, step by step, as an engine would.
//!
//! ```sh
//! cargo run --release -p selvedge-laboratory --example mesh_sequence -- frame-0.ply frame-1.ply frame-2.ply …
//! cargo run --release -p selvedge-laboratory --example mesh_sequence      # a sleeve on a bending arm
//! ```
//!
//! Meshes are OBJ or PLY files of equal topology. The detector is made once. Each step takes two slices of positions and fills
//! the same list of contacts. The table shows the earliest contact, at which the whole mesh would have to stop. Beside it is the
//! result of truncation: the number of vertices held back, and the share of the motion that is kept.

use selvedge::Topology;
use selvedge::glam::DVec3;
use selvedge::{CollisionDetector, Threads};
use selvedge_files::mesh::read_step;
use selvedge_laboratory::scene::ArmScene;
use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (topology, frames) = match &files[..] {
        [] => arm()?,
        [_] => return Err("a sequence has two meshes at least".into()),
        files => read(files)?,
    };

    // With 0 there is a thread for each core.
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.set_threads(Threads::EachCore)?;
    let (mut contacts, mut end) = (Vec::new(), Vec::new());
    println!(" step   candidates   contacts   earliest         ms  held back     kept  rounds  in contact         ms");
    for (step, frames) in frames.windows(2).enumerate() {
        detector.contacts(&frames[0], &frames[1], &mut contacts)?;
        let tally = *detector.statistics();
        let earliest = contacts.iter().map(|contact| contact.time);
        let earliest = earliest.min_by(f64::total_cmp);
        let begin = Instant::now();
        let truncation = detector.truncate(&frames[0], &frames[1], &mut end)?;
        let seconds = begin.elapsed().as_secs_f64();
        println!(
            "{step:>5} {:>12} {:>10} {:>10} {:>10.3} {:>10} {:>8.4} {:>7} {:>11} {:>10.3}",
            tally.candidates.total(),
            contacts.len(),
            earliest.map_or_else(String::new, |time| format!("{time:.6}")),
            tally.seconds * 1e3,
            truncation.held_back,
            motion(&frames[0], &end) / motion(&frames[0], &frames[1]),
            truncation.rounds,
            truncation.in_contact,
            seconds * 1e3,
        );
    }
    Ok(())
}

/// Returns the sum of the lengths of all vertices' paths.
fn motion(start: &[DVec3], end: &[DVec3]) -> f64 {
    start.iter().zip(end).map(|(from, to)| from.distance(*to)).sum()
}

type Sequence = (Topology, Vec<Vec<DVec3>>);

fn read(files: &[PathBuf]) -> Result<Sequence, Box<dyn Error>> {
    let mut sequence: Option<Sequence> = None;
    for pair in files.windows(2) {
        let step = read_step(&pair[0], &pair[1])?;
        let (_, frames) = sequence.get_or_insert((step.topology, vec![step.start]));
        frames.push(step.end);
    }
    sequence.ok_or_else(|| "no meshes".into())
}

fn arm() -> Result<Sequence, Box<dyn Error>> {
    let scene = ArmScene::new(10)?;
    let frames = (0..=ArmScene::STEPS).map(|frame| scene.frame(frame));
    Ok((scene.topology().clone(), frames.collect()))
}
