//! Measures what the detector's mode for coherent motion saves. Both modes run in turn over the steps of a simulated scene, in
//! one process, on one thread.
//!
//! ```sh
//! cargo run --release -p selvedge-laboratory --example coherent_motion -- SCENE.toml FIRST STEPS [SEPARATION in metres]...
//! ```
//!
//! The scene is simulated for FIRST steps. The next STEPS are measured for each separation, in several passes. The fastest run of
//! each step counts, so that an interruption does not. Contacts must be the same, times included.

use selvedge::core::elementary::Limits;
use selvedge::glam::DVec3;
use selvedge::{CollisionDetector, Contact, Criterion, Topology};
use selvedge_cloth::{Scene, Simulation};
use std::error::Error;
use std::sync::Arc;
use std::time::Instant;

/// The number of passes over all steps.
const PASSES: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, first, steps, separations @ ..] = &arguments[..] else {
        return Err("usage: SCENE.toml FIRST STEPS [SEPARATION]...".into());
    };
    let (first, steps) = (first.parse::<usize>()?, steps.parse::<usize>()?);
    let mut simulation = Simulation::new(Scene::read(path.as_ref())?, 0)?;
    let mut frames = Vec::new();
    for step in 0..=first + steps {
        if step >= first {
            frames.push(simulation.positions().to_vec());
        }
        if step < first + steps {
            simulation.step()?;
        }
    }
    let topology = Arc::new(Topology::new(frames[0].len(), simulation.triangles().to_vec())?);
    let triangles = topology.triangles().len();
    println!(
        "{}: {triangles} triangles, steps {first} to {}",
        simulation.name(),
        first + steps
    );
    if separations.is_empty() {
        return compare(&topology, &frames, 0.0);
    }
    separations
        .iter()
        .try_for_each(|separation| compare(&topology, &frames, separation.parse()?))
}

fn compare(topology: &Arc<Topology>, frames: &[Vec<DVec3>], separation: f64) -> Result<(), Box<dyn Error>> {
    let limits = Limits::within(separation);
    let mut seconds = [(); 2].map(|()| vec![f64::INFINITY; frames.len() - 2]);
    for _ in 1..PASSES {
        pass(topology, frames, limits, &mut seconds)?;
    }
    let Counts {
        found,
        followed,
        open,
        searches,
        joined,
    } = pass(topology, frames, limits, &mut seconds)?;
    let steps = frames.len() as u64 - 1;
    println!(
        "separation {separation} m: a step {} contacts, {} pairs followed, {} open; in {steps} steps {searches} searches, {joined} of a few vertices",
        found / steps,
        followed / steps,
        open / steps,
    );
    println!("{:>10} {:>9} {:>9} {:>9}  ms a step", "", "mean", "median", "slowest");
    let mut shares = [(); 2].map(|()| [0.0; 3]);
    for ((name, seconds), share) in ["ordinary", "coherent"].into_iter().zip(&mut seconds).zip(&mut shares) {
        seconds.sort_by(f64::total_cmp);
        let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
        *share = [mean, seconds[seconds.len() / 2], seconds[seconds.len() - 1]];
        println!("{name:>10} {:>9.3} {:>9.3} {:>9.3}", share[0], share[1], share[2]);
    }
    let [ordinary, coherent] = shares;
    let share = [0, 1, 2].map(|k| coherent[k] / ordinary[k]);
    println!("{:>10} {:>9.3} {:>9.3} {:>9.3}", "share", share[0], share[1], share[2]);
    Ok(())
}

/// Counts of all steps.
struct Counts {
    found: u64,
    followed: u64,
    open: u64,
    searches: u64,
    joined: u64,
}

/// Runs both modes over all steps. Keeps the milliseconds of each step if they are fewer than before, except for the first step,
/// which allocates everything.
fn pass(
    topology: &Arc<Topology>,
    frames: &[Vec<DVec3>],
    limits: Limits<f64>,
    seconds: &mut [Vec<f64>; 2],
) -> Result<Counts, Box<dyn Error>> {
    let mut detectors = [false, true].map(|is_coherent| {
        let mut detector = CollisionDetector::<f64>::new(Arc::clone(topology));
        detector.set_coherent(is_coherent);
        detector
    });
    for detector in &mut detectors {
        detector.set_criterion(Criterion::Within(limits))?;
    }
    let mut contacts = [Vec::new(), Vec::new()];
    let (mut found, mut followed, mut open) = (0, 0, 0);
    for (number, step) in frames.windows(2).enumerate() {
        for which in 0..2 {
            let begin = Instant::now();
            detectors[which].contacts(&step[0], &step[1], &mut contacts[which])?;
            if number > 0 {
                let fastest = &mut seconds[which][number - 1];
                *fastest = fastest.min(1e3 * begin.elapsed().as_secs_f64());
            }
        }
        for contacts in &mut contacts {
            contacts.sort_by_key(|contact: &Contact<f64>| (contact.kind, contact.pair));
        }
        if contacts[0] != contacts[1] {
            return Err(format!("{} contacts, and {} of coherent motion", contacts[0].len(), contacts[1].len()).into());
        }
        found += contacts[0].len() as u64;
        followed += detectors[1].statistics().followed;
        open += detectors[1].statistics().candidates.total();
    }
    let counted = detectors[1].near_statistics();
    Ok(Counts {
        found,
        followed,
        open,
        searches: counted.searches,
        joined: counted.joined,
    })
}
