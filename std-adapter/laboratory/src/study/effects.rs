//! Measures the cost of each effect of a scene, by simulations without effects, with the first one, with the first two, and so
//! on.

use selvedge_cloth::{Scene, SceneError, Simulation};
use std::error::Error;
use std::time::Instant;

/// A simulation with some of a scene's effects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectCost {
    /// The effect added last; `None` without effects.
    pub added: Option<&'static str>,
    /// The number of steps. It is smaller than requested if the simulation was blocked.
    pub steps: u64,
    /// The wall-clock seconds per step.
    pub seconds: f64,
}

/// Runs the scene that `read` returns without effects, with the first one, with the first two, and so on. Each run takes `steps`
/// steps from the start. Calls `progress` with the share that is done.
///
/// # Errors
/// Returns an error if the scene cannot be read or set up.
pub fn effects_one_by_one(
    read: impl Fn() -> Result<Scene, SceneError>,
    steps: u64,
    threads: usize,
    progress: &mut dyn FnMut(f64),
) -> Result<Vec<EffectCost>, Box<dyn Error + Send + Sync>> {
    let names = read()?.effect_names();
    let mut costs = Vec::with_capacity(names.len() + 1);
    for count in 0..=names.len() {
        let mut scene = read()?;
        scene.keep_first_effects(count);
        let mut simulation = Simulation::new(scene, threads)?;
        let begin = Instant::now();
        for step in 0..steps {
            if simulation.run().is_err() {
                break;
            }
            let share = (step + 1) as f64 / steps as f64;
            progress((count as f64 + share) / (names.len() + 1) as f64);
        }
        let done = simulation.steps_done();
        costs.push(EffectCost {
            added: count.checked_sub(1).map(|last| names[last]),
            steps: done,
            seconds: begin.elapsed().as_secs_f64() / done.max(1) as f64,
        });
    }
    Ok(costs)
}
