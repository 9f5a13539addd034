//! What the detector's mode for coherent motion saves: both ways over the steps of a simulated scene, in turn, in one process.
//!
//! ```sh
//! cargo run --release -p selvedge-laboratory --example coherent_motion -- SCENE.toml FIRST STEPS [SEPARATION in metres]
//! ```
//!
//! The scene is simulated for FIRST steps; the next STEPS are asked about, with one thread. Contacts must be the same, times included.

use selvedge::core::elementary::Limits;
use selvedge::glam::DVec3;
use selvedge::{CollisionDetector, Contact, Criterion, Topology};
use selvedge_cloth::{Scene, Simulation};
use std::error::Error;
use std::sync::Arc;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, first, steps, rest @ ..] = &arguments[..] else {
        return Err("SCENE.toml FIRST STEPS [SEPARATION]".into());
    };
    let (first, steps) = (first.parse::<usize>()?, steps.parse::<usize>()?);
    let separations = if rest.is_empty() { vec!["0".to_owned()] } else { rest.to_vec() };
    let mut frames: Vec<Vec<DVec3>> = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    let cache = format!("/tmp/coherent-ref/cache-{}-{first}-{steps}", path.rsplit('/').next().unwrap());
    if let Ok(bytes) = std::fs::read(&cache) {
        let n = |k: usize| u64::from_le_bytes(bytes[8 * k..8 * k + 8].try_into().unwrap()) as usize;
        let (v, t, f) = (n(0), n(1), n(2));
        for k in 0..t {
            triangles.push([0, 1, 2].map(|c| n(3 + 3 * k + c) as u32));
        }
        for k in 0..f {
            frames.push((0..v).map(|i| DVec3::from([0, 1, 2].map(|c| f64::from_bits(n(3 + 3 * t + 3 * (k * v + i) + c) as u64)))).collect());
        }
    } else {
    let scene = Scene::read(path.as_ref())?;
    let mut simulation = Simulation::new(scene, 0)?;
    for _ in 0..first {
        simulation.step()?;
    }
    frames.push(simulation.positions().to_vec());
    for _ in 0..steps {
        simulation.step()?;
        frames.push(simulation.positions().to_vec());
    }
    triangles = simulation.triangles().to_vec();
        let mut b: Vec<u64> = vec![frames[0].len() as u64, triangles.len() as u64, frames.len() as u64];
        b.extend(triangles.iter().flatten().map(|&x| u64::from(x)));
        b.extend(frames.iter().flatten().flat_map(|p| p.to_array()).map(f64::to_bits));
        std::fs::write(&cache, b.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>())?;
    }
    let topology = Arc::new(Topology::new(frames[0].len(), triangles)?);
    println!("{path}: {} triangles, steps {first} to {}", topology.triangles().len(), first + steps);
    for separation in separations {
        compare(&topology, &frames, separation.parse()?)?;
    }
    Ok(())
}

fn compare(topology: &Arc<Topology>, frames: &[Vec<DVec3>], separation: f64) -> Result<(), Box<dyn Error>> {
    let limits = Limits { separation, ..Limits::default() };
    let mut detectors = [false, true].map(|coherent| {
        let mut detector = CollisionDetector::<f64>::new(Arc::clone(topology));
        detector.set_coherent(coherent);
        detector
    });
    for detector in &mut detectors {
        detector.set_criterion(Criterion::Within(limits))?;
    }
    let mut seconds = [Vec::new(), Vec::new()];
    let mut contacts = [Vec::new(), Vec::new()];
    let mut classes: [Vec<f64>; 3] = Default::default();
    let mut before = detectors[1].near_statistics();
    let (mut found, mut followed, mut open) = (0, 0, 0);
    for step in frames.windows(2) {
        for which in 0..2 {
            let begin = Instant::now();
            detectors[which].contacts(&step[0], &step[1], &mut contacts[which])?;
            let took = begin.elapsed().as_secs_f64();
            seconds[which].push(took);
            if which == 1 {
                let now = detectors[1].near_statistics();
                let class = if now.searches > before.searches { 2 } else if now.joined > before.joined { 1 } else { 0 };
                classes[class].push(took);
                before = now;
            }
        }
        for contacts in &mut contacts {
            contacts.sort_by_key(|contact: &Contact<f64>| (contact.kind, contact.pair));
        }
        if contacts[0] != contacts[1] {
            return Err(format!("{} contacts, and {} in coherent mode", contacts[0].len(), contacts[1].len()).into());
        }
        found += contacts[0].len();
        followed += detectors[1].tally().followed;
        open += detectors[1].tally().candidates.total();
    }
    let steps = seconds[0].len();
    println!("separation {separation} m: {} contacts, {} pairs followed, {} open a step", found / steps, followed as usize / steps, open as usize / steps);
    for mut class in classes {
        class.sort_by(f64::total_cmp);
        if !class.is_empty() { println!("{} steps, median {:.3} ms, mean {:.3}", class.len(), 1e3 * class[class.len() / 2], 1e3 * class.iter().sum::<f64>() / class.len() as f64); }
    }
    println!("{:?}", detectors[0].tally());
    println!("{:?}", detectors[1].near_statistics());
    println!("{:>10} {:>9} {:>9} {:>9}  ms a step", "", "mean", "median", "slowest");
    let mut means = [0.0; 2];
    for (which, name) in ["anew", "coherent"].into_iter().enumerate() {
        let seconds = &mut seconds[which][1..];
        let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
        seconds.sort_by(f64::total_cmp);
        let [median, slowest] = [seconds[seconds.len() / 2], seconds[seconds.len() - 1]].map(|s| 1e3 * s);
        println!("{name:>10} {:>9.3} {median:>9.3} {slowest:>9.3}", 1e3 * mean);
        means[which] = mean;
    }
    println!("{:>10} {:>9.3}", "share", means[1] / means[0]);
    Ok(())
}
