//! Records the built-in arm scene, with what each stage of the pipeline leaves, as a page that works offline and as animated glTF.
//!
//! ```sh
//! cargo run --release -p selvedge-laboratory --example record -- FOLDER
//! ```

use selvedge::glam::DVec3;
use selvedge_laboratory::methods::{Preset, Stage};
use selvedge_laboratory::pipeline::{Pipeline, StepReport};
use selvedge_laboratory::report::{About, Knob, Part, PartKind, Recorder, SeriesKind, gltf, page};
use selvedge_laboratory::scene::ArmScene;
use std::error::Error;
use std::path::PathBuf;

/// Simulated seconds of a step.
const TIME_STEP: f64 = 1.0 / 60.0;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    std::fs::create_dir_all(&folder)?;

    let scene = ArmScene::new(1)?;
    let topology = scene.topology();
    let vertices = topology.vertex_count();
    let stages = Preset::Selvedge.stages();
    let mut pipeline = Pipeline::<f64>::new(topology.clone(), stages, 1)?;

    let about = About {
        name: "arm".to_owned(),
        scene: String::new(),
        up: DVec3::Y,
        time_step: TIME_STEP,
        fabric: Vec::new(),
        knobs: vec![
            Knob::new("steps of the whole bend", ArmScene::STEPS.to_string()),
            Knob::new("numbers", "f64"),
        ],
    };
    let sleeve = Part::new("sleeve", PartKind::Cloth, vertices, topology.triangles().to_vec());
    // The stages of a method are known once it has run a step: one that leads from the start to the start.
    pipeline.step(&scene.frame(0), &scene.frame(0))?;
    let names: Vec<Stage> = pipeline.report().stages.iter().map(|stage| stage.stage).collect();
    let series: Vec<(&str, SeriesKind)> = [Stage::BroadPhase]
        .iter()
        .chain(&names)
        .flat_map(|stage| [(stage.name(), SeriesKind::Pairs), (stage.name(), SeriesKind::Stage)])
        .collect();

    let mut recorder = Recorder::new(about, vec![sleeve], &series, &vec![0.0; series.len()]);
    let mut total = StepReport::default();
    recorder.frame(0, &scene.frame(0))?;
    for step in 1..=ArmScene::STEPS {
        let (start, end) = (scene.frame(step - 1), scene.frame(step));
        pipeline.step(&start, &end)?;
        total.add(pipeline.report());
        recorder.step(&readings(&total));
        recorder.frame(step as u64, &end)?;
    }
    let recording = recorder.finish(Some(total.seconds));
    std::fs::write(folder.join("arm.html"), page::html(&recording))?;
    std::fs::write(folder.join("arm.glb"), gltf::binary(&recording)?)?;
    println!("wrote {}", folder.join("arm.html").display());
    println!("wrote {}", folder.join("arm.glb").display());
    Ok(())
}

/// The counters so far, in the order of the series.
fn readings(total: &StepReport) -> Vec<f64> {
    let mut readings = vec![total.triangle_pairs as f64, total.broad_phase_seconds];
    for stage in &total.stages {
        readings.extend([stage.survivors.total() as f64, stage.seconds]);
    }
    readings
}
