//! `selvedge simulate`.

use super::Failure;
use super::options::Threads;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use selvedge::mesh::{self, Mesh};
use selvedge::simulation::{Scene, Simulation};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simulates the cloth of a scene file, and pays only for the effects that the scene calls for.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  selvedge simulate std-adapter/scenes/hanging.toml --frames ply

Scenes that come with the program are in std-adapter/scenes.")]
pub(crate) struct Simulate {
    /// The scene, a TOML file
    scene: PathBuf,
    /// Write to this folder
    #[arg(long, value_name = "DIR", default_value = "selvedge-out")]
    output: PathBuf,
    /// Write each frame of the animation as a mesh file
    #[arg(long, value_enum)]
    frames: Option<Frames>,
    #[command(flatten)]
    threads: Threads,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Frames {
    /// Binary PLY
    Ply,
    /// Text, exact all the same
    Obj,
}

impl Simulate {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = Scene::read(&self.scene)?;
        let (steps, steps_per_frame) = (scene.steps(), scene.steps_per_frame());
        let mut simulation = Simulation::new(scene, self.threads.get())?;
        if self.frames.is_some() {
            OutputFiles::check_folder(&self.output)?;
        }
        let begin = Instant::now();
        {
            let progress = Progress::bar("simulating");
            self.write_frame(&simulation, 0)?;
            for step in 1..=steps {
                simulation.step()?;
                if step % steps_per_frame == 0 {
                    self.write_frame(&simulation, step / steps_per_frame)?;
                }
                progress.set(step as f64 / steps as f64);
            }
        }
        let seconds = begin.elapsed().as_secs_f64();
        let effects = simulation.effects();
        if self.json {
            let effects: Vec<_> = effects
                .iter()
                .map(|effect| json!({"effect": effect.name, "seconds": effect.seconds}))
                .collect();
            output::print_json(&json!({
                "scene": simulation.name(),
                "steps": simulation.steps_done(),
                "seconds": seconds,
                "effects": effects,
            }))
        } else {
            let mut text = format!(
                "{}: {steps} steps in {seconds:.2} s, {:.0} a second\n",
                simulation.name(),
                steps as f64 / seconds
            );
            for effect in effects {
                text += &format!("{:<18}{:>9.3} s\n", effect.name, effect.seconds);
            }
            if let (Some(seconds), Some(counts)) =
                (simulation.contact_seconds(), simulation.contact_counts())
            {
                for (stage, seconds) in [
                    ("candidate pairs", seconds.candidates),
                    ("contact set-up", seconds.rows),
                    ("certificates", seconds.certificates),
                    ("repairs", seconds.repairs),
                ] {
                    text += &format!("{stage:<18}{seconds:>9.3} s\n");
                }
                text += "a step: ";
                let mean = |count: u64| count as f64 / steps as f64;
                for (what, count) in [
                    ("triangle pairs", counts.triangle_pairs),
                    ("primitive pairs", counts.primitive_pairs),
                    ("candidates", counts.candidates),
                    ("looked at", counts.looked_at),
                    ("pushed", counts.pushed),
                    ("violated", counts.violated),
                    ("zone rounds", counts.zone_rounds),
                    ("held", counts.held),
                    ("cuts", counts.cuts),
                ] {
                    text += &format!("{:.3} {what}, ", mean(count));
                }
                text += "\n";
            }
            output::print(&text)
        }
    }

    fn write_frame(&self, simulation: &Simulation, frame: u64) -> Result<(), Failure> {
        let extension = match self.frames {
            None => return Ok(()),
            Some(Frames::Ply) => "ply",
            Some(Frames::Obj) => "obj",
        };
        let name = format!("frame-{frame:05}.{extension}");
        let mesh = Mesh {
            positions: simulation.positions().to_vec(),
            triangles: simulation.triangles().to_vec(),
        };
        Ok(mesh::write(&self.output.join(Path::new(&name)), &mesh)?)
    }
}
