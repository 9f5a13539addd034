//! Some steps of a scene, for a profiler or an instruction counter (`run.sh`).
//!
//! ```sh
//! cargo run --release -- SCENE.toml STEPS_BEFORE STEPS
//! ```

use selvedge_cloth::{Blocked, Scene, Simulation};
use std::error::Error;
use std::hash::Hasher;
use std::path::PathBuf;
use std::time::Instant;

/// What is counted.
#[inline(never)]
fn counted_steps(simulation: &mut Simulation, count: u64) -> Result<(), Blocked> {
    (0..count).try_for_each(|_| simulation.step())
}

/// Seconds of each effect, and of what effects share, so far.
fn seconds(simulation: &Simulation) -> Vec<(&'static str, f64)> {
    let effects = simulation.effects().iter();
    let mut seconds: Vec<_> = effects.map(|effect| (effect.name, effect.seconds)).collect();
    let stages = simulation.contact_seconds();
    seconds.extend(stages.map(|stages| stages.stages()).into_iter().flatten());
    seconds
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut argument = || arguments.next().ok_or("SCENE.toml STEPS_BEFORE STEPS");
    let path = PathBuf::from(argument()?);
    let (before, count): (u64, u64) = (argument()?.parse()?, argument()?.parse()?);
    let mut simulation = Simulation::new(Scene::read(&path)?, 1)?;
    (0..before).try_for_each(|_| simulation.step())?;
    let seconds_before = seconds(&simulation);
    let begin = Instant::now();
    counted_steps(&mut simulation, count)?;
    let all = begin.elapsed().as_secs_f64();
    eprintln!("{:8.3} ms a step", 1e3 * all / count as f64);
    for ((name, after), (_, before)) in seconds(&simulation).into_iter().zip(seconds_before) {
        eprintln!("{:8.3} ms {name}", 1e3 * (after - before) / count as f64);
    }
    // So that two programs can be seen to have done the same.
    let mut hasher = std::hash::DefaultHasher::new();
    for position in simulation.positions() {
        let bits = position.to_array().map(f64::to_bits);
        bits.into_iter().for_each(|bits| hasher.write_u64(bits));
    }
    println!("{:016x}", hasher.finish());
    Ok(())
}
