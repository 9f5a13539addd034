//! Cloth simulation as a library's user meets it.

mod blocked;
mod determinism;
mod drape;
mod energy;
mod paying_only;
mod stability;
mod wrong_scenes;

use selvedge::simulation::{Scene, Simulation};
use std::path::{Path, PathBuf};

fn scene_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenes")
        .join(name)
}

/// A scene that comes with the program, with changes.
fn load(name: &str, change: impl Fn(String) -> String, threads: usize) -> Simulation {
    let path = scene_file(name);
    let text = change(std::fs::read_to_string(&path).unwrap());
    Simulation::new(Scene::parse(&text, &path).unwrap(), threads).unwrap()
}
