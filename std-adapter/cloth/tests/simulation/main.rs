//! Cloth simulation as a library's user meets it.

mod air;
mod animated;
mod attachments;
mod bending;
mod blocked;
mod determinism;
mod drape;
mod energy;
mod files;
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

#[path = "../../src/model/hierarchy/irregular.rs"]
mod irregular;

use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Mesh, Scene, Simulation};
use std::ops::Range;
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

/// A valley along y whose sides rise by a right angle to each other, of cells of a decimetre: so many columns on each side, these rows, and
/// its bottom at a height in metres. Such sheets of different heights lie over each other, vertex over vertex.
fn folded(columns: i32, rows: Range<i32>, height: f64) -> Mesh {
    let across = 2 * columns + 1;
    let vertex = |row: i32, column: i32| {
        let [x, y] = [0.07 * f64::from(column), 0.1 * f64::from(row)];
        DVec3::new(x, y, x.abs() + height)
    };
    let positions = rows
        .clone()
        .flat_map(|row| (-columns..=columns).map(move |column| vertex(row, column)));
    let cells = (0..rows.len() as i32 - 1).flat_map(|row| (0..across - 1).map(move |column| across * row + column));
    let corners = |at: i32| [[at, at + 1, at + across], [at + 1, at + across + 1, at + across]];
    Mesh {
        positions: positions.collect(),
        triangles: cells.flat_map(corners).map(|t| t.map(|corner| corner as u32)).collect(),
    }
}
