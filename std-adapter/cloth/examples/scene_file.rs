//! Runs a scene file.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example scene_file -- std-adapter/cloth/scenes/flag.toml
//! ```

use selvedge_cloth::{Scene, Simulation};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("the path of a scene file is missing")?;
    let scene = Scene::read(Path::new(&path))?; // an error names line and column
    println!("{}: {}", scene.name, scene.effect_names().join(", "));

    let (steps, steps_per_frame) = (scene.steps(), scene.steps_per_frame());
    let mut simulation = Simulation::new(scene, 0)?;
    for step in 1..=steps {
        simulation.step()?;
        if step % steps_per_frame == 0 {
            let energy = simulation.energy();
            println!("{:.3} s: {:.3} J of motion", simulation.time(), energy.kinetic);
        }
    }
    Ok(())
}
