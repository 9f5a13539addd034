use super::message;
use selvedge::simulation::{Scene, Simulation};
use std::path::Path;

/// Larger cloth and bodies are read, not simulated.
const LARGEST: usize = 500;
/// Numbers of cells and the like from here on are left out: they would only take time and memory.
const FINEST: i64 = 13;

/// A scene file is refused with a readable message that names the line and the column; or it makes a scene of which everything is
/// finite after two steps. A scene that cannot be set up, or is blocked, says so in one line too.
pub fn scene(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    if text
        .parse()
        .is_ok_and(|table| is_large(&toml::Value::Table(table)))
    {
        return;
    }
    let path = Path::new("no-such-folder/fuzz.toml");
    let scene = match Scene::parse(text, path) {
        Ok(scene) => scene,
        Err(error) => {
            let (line, column) = error.place.expect("a place");
            assert!(line >= 1 && line <= text.split('\n').count());
            assert!(column >= 1 && column <= text.chars().count() + 1);
            return message::check(&error);
        }
    };
    let bodies = scene.bodies.iter().map(|body| body.mesh.triangles.len());
    if scene.cloth.mesh.triangles.len() + bodies.sum::<usize>() > LARGEST {
        return;
    }
    let mut simulation = match Simulation::new(scene, 1) {
        Ok(simulation) => simulation,
        Err(error) => return message::check(&error),
    };
    for _ in 0..2 {
        let result = simulation.step();
        assert!(simulation.positions().iter().all(|p| p.is_finite()));
        if let Err(blocked) = result {
            return message::check(&blocked);
        }
    }
}

/// Whether the mesh would be large, or read from a file.
fn is_large(value: &toml::Value) -> bool {
    match value {
        toml::Value::Array(values) => values.iter().any(is_large),
        toml::Value::Table(table) => table.iter().any(|(key, value)| match key.as_str() {
            "cells" | "refinement" | "around" | "sweeps" => has_large_number(value),
            "file" => true,
            _ => is_large(value),
        }),
        _ => false,
    }
}

fn has_large_number(value: &toml::Value) -> bool {
    match value {
        toml::Value::Array(values) => values.iter().any(has_large_number),
        toml::Value::Integer(number) => *number >= FINEST,
        _ => false,
    }
}
