//! A simulation is interrupted and resumed, with the same bits.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example checkpoint
//! ```

use selvedge_cloth::{ARM_SLEEVE, CHECKPOINT_STEPS, Scene, Simulation};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = || Scene::parse(ARM_SLEEVE, Path::new("arm-sleeve.toml"));
    let mut simulation = Simulation::new(scene()?, 0)?;
    (0..CHECKPOINT_STEPS).try_for_each(|_| simulation.step())?;
    // A checkpoint is due every 200 steps.
    let checkpoint = simulation.checkpoint().ok_or("no checkpoint is due")?;
    println!("{} bytes after {:.1} s", checkpoint.len(), simulation.time());
    (0..100).try_for_each(|_| simulation.step())?;

    let mut resumed = Simulation::new(scene()?, 0)?;
    resumed.resume(&checkpoint)?;
    (0..100).try_for_each(|_| resumed.step())?;
    println!("the same positions: {}", resumed.positions() == simulation.positions());
    Ok(())
}
