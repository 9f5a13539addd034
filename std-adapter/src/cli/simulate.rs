//! `selvedge simulate`.

use super::Failure;
use super::options::Threads;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use selvedge::mesh::{self, Mesh};
use selvedge::report::{SimulationRecorder, Subject, gltf, json, page, tables};
use selvedge::simulation::{Scene, Simulation};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Simulates the cloth of a scene file, and pays only for the effects that the scene calls for.
///
/// Writes a report that works offline: the animation, candidate pairs over time, the time of each effect. A run that was
/// interrupted goes on from its last checkpoint with --resume, to the same bits.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge simulate std-adapter/scenes/arm-sleeve.toml
  selvedge simulate scene.toml --frames gltf --output out    for Blender
  selvedge simulate scene.toml --resume                      after an interruption

Scenes that come with the program are in std-adapter/scenes.")]
pub(crate) struct Simulate {
    /// The scene, a TOML file
    scene: PathBuf,
    /// Write to this folder
    #[arg(long, value_name = "DIR", default_value = "selvedge-out")]
    output: PathBuf,
    /// Write the frames as well
    #[arg(long, value_enum)]
    frames: Option<Frames>,
    /// Go on from the last checkpoint in the output folder
    #[arg(long)]
    resume: bool,
    #[command(flatten)]
    threads: Threads,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Frames {
    /// Binary PLY, one file for each frame
    Ply,
    /// Text, exact all the same, one file for each frame
    Obj,
    /// One animated file, which Blender opens
    Gltf,
}

/// Between two checkpoints, at least; the first is written as soon as it can be.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(5);

impl Simulate {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = Scene::read(&self.scene)?;
        let (steps, steps_per_frame) = (scene.steps(), scene.steps_per_frame());
        let subject = Subject::new(&scene);
        let path = self.scene.display();
        let mut simulation = Simulation::new(scene, self.threads.get())
            .map_err(|error| format!("{path}: {error}"))?;
        OutputFiles::check_folder(&self.output)?;
        if self.resume {
            let checkpoint = self.file("checkpoint");
            let of_file = |error: String| format!("{}: {error}", checkpoint.display());
            let bytes = std::fs::read(&checkpoint).map_err(|error| {
                of_file(format!(
                    "cannot be read: {error}; was there a checkpoint yet?"
                ))
            })?;
            simulation
                .resume(&bytes)
                .map_err(|error| of_file(error.to_string()))?;
        }

        let begin = Instant::now();
        let first = simulation.steps_done();
        let mut recorder = SimulationRecorder::new(subject, &simulation)?;
        let result = self.run_steps(&mut simulation, &mut recorder, steps, steps_per_frame);
        let seconds = begin.elapsed().as_secs_f64();
        if let Err(failure) = &result {
            recorder.remark(failure.to_string());
        }
        let recording = recorder.finish(seconds);

        let mut files = OutputFiles::default();
        files.add_bytes(self.file("html"), page::html(&recording).as_bytes())?;
        if self.frames == Some(Frames::Gltf) {
            files.add_bytes(self.file("glb"), &gltf::binary(&recording)?)?;
        }
        files.publish()?;
        // What has been simulated is written and told all the same.
        let printed = if self.json {
            output::print_json(&json::simulation(&simulation, first, seconds))
        } else {
            output::print(&tables::simulation(&simulation, first, seconds))
        };
        result.and(printed)
    }

    fn run_steps(
        &self,
        simulation: &mut Simulation,
        recorder: &mut SimulationRecorder,
        steps: u64,
        steps_per_frame: u64,
    ) -> Result<(), Failure> {
        let progress = Progress::steps("simulating", steps);
        if simulation.steps_done() == 0 {
            self.write_frame(simulation, 0)?;
        }
        let mut last_checkpoint: Option<Instant> = None;
        while simulation.steps_done() < steps {
            if let Err(blocked) = simulation.step() {
                recorder.frame(simulation)?;
                return Err(format!("{}: {blocked}", self.scene.display()).into());
            }
            recorder.step(simulation);
            let step = simulation.steps_done();
            if step.is_multiple_of(steps_per_frame) || step == steps {
                recorder.frame(simulation)?;
                self.write_frame(simulation, step.div_ceil(steps_per_frame))?;
            }
            if last_checkpoint.is_none_or(|last| last.elapsed() >= CHECKPOINT_INTERVAL)
                && let Some(bytes) = simulation.checkpoint()
            {
                let mut files = OutputFiles::default();
                files.add_bytes(self.file("checkpoint"), &bytes)?;
                files.publish_quietly()?;
                last_checkpoint = Some(Instant::now());
            }
            progress.set_steps(step);
        }
        Ok(())
    }

    /// The output file with this extension, called as the scene's.
    fn file(&self, extension: &str) -> PathBuf {
        let stem = self.scene.file_stem().unwrap_or_default();
        self.output.join(Path::new(stem).with_extension(extension))
    }

    fn write_frame(&self, simulation: &Simulation, frame: u64) -> Result<(), Failure> {
        let extension = match self.frames {
            None | Some(Frames::Gltf) => return Ok(()),
            Some(Frames::Ply) => "ply",
            Some(Frames::Obj) => "obj",
        };
        let stem = self.scene.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}-{frame:05}.{extension}");
        let mesh = Mesh {
            positions: simulation.positions().to_vec(),
            triangles: simulation.triangles().to_vec(),
        };
        Ok(mesh::write(&self.output.join(name), &mesh)?)
    }
}
