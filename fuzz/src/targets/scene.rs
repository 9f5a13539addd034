use super::message;
use selvedge_cloth::{Scene, Simulation};
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// The largest number of triangles that are simulated. Larger scenes are only read.
const LARGEST: usize = 500;
/// The number of cells, and of similar counts, from which on scenes are skipped, since they only take time and memory.
const FINEST: u64 = 13;

/// A scene file is rejected with a readable message that names line and column, or makes a scene that is finite after two steps.
/// If a scene cannot be set up, or is blocked, the message is one line, too.
pub fn scene(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    if DeTable::parse(text).is_ok_and(|table| has_large(table.get_ref())) {
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
    let cloths = scene.cloths.iter().map(|cloth| cloth.mesh().triangles.len());
    if cloths.chain(bodies).sum::<usize>() > LARGEST {
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

/// Returns whether a mesh would be large, or read from a file.
fn has_large(table: &DeTable<'_>) -> bool {
    let mut entries = table.iter();
    entries.any(|(key, value)| match key.get_ref().as_ref() {
        "cells" | "refinement" | "around" => has_large_number(value.get_ref()),
        "file" => true,
        _ => is_large(value.get_ref()),
    })
}

fn is_large(value: &DeValue<'_>) -> bool {
    match value {
        DeValue::Array(values) => values.iter().any(|value| is_large(value.get_ref())),
        DeValue::Table(table) => has_large(table),
        _ => false,
    }
}

fn has_large_number(value: &DeValue<'_>) -> bool {
    match value {
        DeValue::Array(values) => values.iter().any(|value| has_large_number(value.get_ref())),
        DeValue::Integer(number) => u64::from_str_radix(number.as_str(), number.radix()).is_ok_and(|n| n >= FINEST),
        _ => false,
    }
}
