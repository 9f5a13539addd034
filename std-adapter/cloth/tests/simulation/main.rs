//! Cloth simulation as a library's user meets it.

mod air;
mod animated;
mod attachments;
mod bending;
mod blocked;
mod determinism;
mod drape;
mod energy;
mod from_code;
mod garments;
mod materials;
mod paying_only;
mod plastic_folds;
mod ropes;
mod seams;
mod several_cloths;
mod stability;
mod stretch;
mod tangled;
mod tearing;
mod wrong_scenes;

#[path = "../../src/hierarchy/irregular.rs"]
mod irregular;

use selvedge_cloth::{Scene, Simulation};
use std::path::{Path, PathBuf};

fn scene_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

/// A scene that comes with the program, with changes.
fn load(name: &str, change: impl Fn(String) -> String, threads: usize) -> Simulation {
    let path = scene_file(name);
    let text = change(std::fs::read_to_string(&path).unwrap());
    set_up(&text, name, threads)
}

/// A scene as if it were in a file beside those that come with the program.
fn set_up(text: &str, name: &str, threads: usize) -> Simulation {
    let scene = Scene::parse(text, &scene_file(name)).unwrap();
    Simulation::new(scene, threads).unwrap()
}
