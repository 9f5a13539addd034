//! Runs scenes natively: `selvedge-native FOLDER STEPS SCENE.toml...`.
//!
//! For each scene it writes the positions after so many steps, and the contacts of the motion from the first positions to these.
//! A test compares these bytes with WebAssembly's. It prints the seconds that the steps took, on one thread.

use selvedge::{CollisionDetector, PairKind, Topology};
use selvedge_cloth::{Scene, Simulation};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, steps, scenes @ ..] = &arguments[..] else {
        return Err("usage: selvedge-native FOLDER STEPS SCENE.toml...".into());
    };
    let steps: u32 = steps.parse()?;
    for scene in scenes {
        let name = Path::new(scene).file_stem().unwrap_or_default().to_string_lossy();
        let mut simulation = Simulation::new(Scene::read(Path::new(scene))?, 1)?;
        let start = simulation.positions().to_vec();
        let begin = Instant::now();
        for _ in 0..steps {
            simulation.step()?;
        }
        println!("{name} {}", begin.elapsed().as_secs_f64());
        let end = simulation.positions();
        let bytes: Vec<u8> = end.iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes).collect();
        std::fs::write(Path::new(folder).join(format!("{name}.positions")), bytes)?;
        if start.len() != end.len() {
            continue; // Tearing has added vertices.
        }
        let topology = Topology::new(start.len(), simulation.triangles().to_vec())?;
        let mut contacts = Vec::new();
        CollisionDetector::<f64>::new(topology).contacts(&start, end, &mut contacts)?;
        contacts.sort_by_key(|contact| (contact.kind == PairKind::EdgeEdge, contact.pair));
        let mut bytes = Vec::new();
        for contact in &contacts {
            contact.pair.iter().for_each(|number| bytes.extend(number.to_le_bytes()));
            bytes.extend(contact.time.to_le_bytes());
        }
        std::fs::write(Path::new(folder).join(format!("{name}.contacts")), bytes)?;
    }
    Ok(())
}
