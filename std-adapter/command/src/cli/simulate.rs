//! `selvedge simulate`.

use super::Failure;
use super::options::Threads;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use selvedge_cloth::{CheckpointError, Cloth, Scene, SceneError, SetupError, Simulation};
use selvedge_files::mesh;
use selvedge_laboratory::report::{Recording, SimulationRecorder, Subject, costs_of_added_effects};
use selvedge_laboratory::report::{coloured_ply, crossing_triangles, start_sentences, tangled_start_json};
use selvedge_laboratory::report::{gltf, json, page, side_by_side, still, tables};
use selvedge_laboratory::study::{EffectCost, effects_one_by_one};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Simulates the cloth of a scene file
///
/// Only the effects that the scene names cost time. Writes a report that works offline: the animation, energy, stretch and
/// loads, candidate pairs over time, and the time of each effect. An interrupted run resumes from its last checkpoint with
/// --resume, to the same bits.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge simulate std-adapter/cloth/scenes/arm-sleeve.toml
  selvedge simulate scene.toml --frames gltf --output out    for Blender
  selvedge simulate scene.toml --effects-one-by-one          what each costs
  selvedge simulate scene.toml --resume                      after an interruption
  selvedge simulate scene.toml --against other.toml          two scenes, side by side on one page
  selvedge simulate scene.toml --picture fold.png --at 0.8   a still picture, without a browser

Scenes that come with the program are in std-adapter/cloth/scenes.")]
pub(crate) struct Simulate {
    /// The scene, a TOML file
    scene: PathBuf,
    /// Write to this folder
    #[arg(long, value_name = "DIR", default_value = "selvedge-out")]
    output: PathBuf,
    /// Write the frames as well, in this format
    #[arg(long, value_enum)]
    frames: Option<Frames>,
    /// Run the scene also without effects, with the first one, with the first two, and so on, and report the cost of a step
    #[arg(long)]
    effects_one_by_one: bool,
    /// Resume from the last checkpoint in the output folder
    #[arg(long)]
    resume: bool,
    /// Write a still picture (PNG) of the last frame to this file, in the output folder unless it names another
    #[arg(long, value_name = "FILE", value_parser = picture)]
    picture: Option<PathBuf>,
    /// Show the frame nearest to this time instead
    #[arg(long, value_name = "SECONDS", requires = "picture", value_parser = time)]
    at: Option<f64>,
    /// Run this scene as well, and write a page that compares both
    #[arg(long, value_name = "SCENE", conflicts_with_all = ["frames", "effects_one_by_one", "resume", "picture"])]
    against: Option<PathBuf>,
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
    /// Text, without loss of precision, one file for each frame
    Obj,
    /// One animated file, for Blender and other viewers
    Gltf,
}

/// Parses a time in seconds.
fn time(text: &str) -> Result<f64, String> {
    let seconds = text
        .parse()
        .ok()
        .filter(|seconds: &f64| seconds.is_finite() && *seconds >= 0.0);
    seconds.ok_or_else(|| "a time in seconds, zero or more, is needed".to_owned())
}

/// Parses the name of a picture, which is a PNG file.
fn picture(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension() {
        Some(extension) if !extension.eq_ignore_ascii_case("png") => {
            Err("pictures are PNG files; end the name in .png".to_owned())
        }
        _ => Ok(path),
    }
}

/// A free body this many times as heavy as all cloth may gain energy from it.
const HEAVY: f64 = 1000.0;

/// Returns a sentence for each free body that is so heavy that its motion on the cloth may be wrong.
fn heavy_bodies(simulation: &Simulation, cloth_mass: f64) -> Vec<String> {
    let names = simulation.body_names().iter().enumerate();
    names
        .filter_map(|(body, name)| {
            let times = simulation.body_motion(body)?.mass / cloth_mass;
            (times > HEAVY).then(|| {
                format!(
                    "The free body '{name}' is {times:.0} times as heavy as all cloth. From {HEAVY} times on, cloth may throw a body off: \
                     `lost` is then negative."
                )
            })
        })
        .collect()
}

/// Returns the two parts of a checkpoint file: the simulation's state, and the recording.
fn split(saved: &[u8]) -> Option<(&[u8], &[u8])> {
    let (&length, rest) = saved.split_first_chunk()?;
    rest.split_at_checked(usize::try_from(u64::from_le_bytes(length)).ok()?)
}

/// Runs a simulation up to step `steps`, or frame in a scene by frames. Calls `then` after each with the seconds that it took.
pub(super) fn run_steps(
    simulation: &mut Simulation,
    steps: u64,
    mut then: impl FnMut(&Simulation, f64) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let progress = Progress::steps("simulating", steps);
    while simulation.runs_done() < steps {
        let begin = Instant::now();
        let overstretched = simulation.overstretched_steps();
        simulation.run()?;
        // By frames the simulation has chosen its steps itself.
        if overstretched == 0 && simulation.overstretched_steps() > 0 && simulation.frame_seconds().is_none() {
            let time = simulation.time();
            eprintln!(
                "warning: at {time:.6} s an edge is more than 5 % above its limit: the time step is too long for this scene"
            );
        }
        then(simulation, begin.elapsed().as_secs_f64())?;
        progress.set_steps(simulation.runs_done());
    }
    Ok(())
}

/// Measures the cost of each effect of a scene.
pub(super) fn effect_costs(
    read: impl Fn() -> Result<Scene, SceneError>,
    steps: u64,
    threads: usize,
) -> Result<Vec<EffectCost>, Failure> {
    let progress = Progress::bar("effects one by one");
    effects_one_by_one(read, steps, threads, &mut |share| progress.set(share))
}

struct SimulationRun {
    /// The number of steps in the scene.
    steps: u64,
    simulation: Simulation,
    recording: Recording,
    result: Result<(), Failure>,
}

/// The least time between two checkpoints. The first one is written as early as possible.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(5);

impl Simulate {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        match &self.against {
            Some(other) => self.run_both(other),
            None => self.run_one(),
        }
    }

    /// Runs both scenes one after the other in one process, so that their times compare. Writes only reports.
    fn run_both(&self, other: &Path) -> Result<(), Failure> {
        let run = |path| self.record(path, |_, _| Ok(0.0), |_, _, _, _| Ok(()));
        let [first, second] = [run(&self.scene)?, run(other)?];
        let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = format!("{}-against-{}.html", stem(&self.scene), stem(other));
        let mut files = OutputFiles::default();
        files.add_bytes(
            self.output.join(name),
            side_by_side::html(&first.recording, &second.recording)?.as_bytes(),
        )?;
        files.publish()?;
        let printed = if self.json {
            let mut document = json::simulation(&first.simulation, &first.recording);
            document["against"] = json::simulation(&second.simulation, &second.recording);
            output::print_json(&document)
        } else {
            let texts = [&first, &second].map(|run| tables::simulation(&run.simulation, &run.recording));
            output::print(&texts.join("\n"))
        };
        first.result.and(second.result).and(printed)
    }

    /// Sets a scene up, and untangles it if the scene says so. If tangles remain, the places are written and printed.
    fn set_up(&self, scene: Scene) -> Result<Simulation, Failure> {
        let name = scene.name.clone();
        let mut untangling = None;
        let made = Simulation::with_progress(scene, self.threads.get(), &mut |now| {
            let shown = untangling.get_or_insert_with(|| Progress::shrinking("untangling, places left", now.crossings as u64));
            shown.set_steps(now.crossings as u64);
        });
        drop(untangling);
        if let Err(SetupError::Tangled(tangled)) = &made {
            let mut files = OutputFiles::default();
            let (mesh, red) = (&tangled.mesh, crossing_triangles(tangled));
            files.add(self.file("tangled.ply"), |out| {
                coloured_ply(&mesh.positions, &mesh.triangles, &red, out)
            })?;
            files.publish()?;
            if self.json {
                output::print_json(&tangled_start_json(&name, tangled))?;
            }
        }
        Ok(made?)
    }

    /// Runs a scene as far as possible, and records it. `begin` prepares the start, and returns the seconds of earlier runs.
    /// `after` is called each step with the number of the frame, if it is one, and the seconds so far.
    fn record(
        &self,
        path: &Path,
        begin: impl FnOnce(&mut Simulation, &mut SimulationRecorder) -> Result<f64, Failure>,
        mut after: impl FnMut(&Simulation, &SimulationRecorder, Option<u64>, f64) -> Result<(), Failure>,
    ) -> Result<SimulationRun, Failure> {
        let scene = Scene::read(path)?;
        let path = path.display();
        let (steps, steps_per_frame) = (scene.steps(), scene.steps_per_frame());
        let subject = Subject::new(&scene);
        let mut remarks = scene.remarks.clone();
        let cloth_mass = scene.cloths.iter().map(Cloth::mass).sum();
        self.check_outputs()?;
        let note = |remark: &String| output::say(format_args!("note: {remark}"));
        remarks.iter().for_each(note);
        let mut simulation = self.set_up(scene).map_err(|error| format!("{path}: {error}"))?;
        let heavy = heavy_bodies(&simulation, cloth_mass);
        heavy.iter().for_each(note);
        remarks.extend(heavy);
        let mut recorder = SimulationRecorder::new(subject, &simulation)?;
        let earlier = begin(&mut simulation, &mut recorder)?;

        let begin = Instant::now();
        let seconds = || earlier + begin.elapsed().as_secs_f64();
        let result = run_steps(&mut simulation, steps, |simulation, taken| {
            recorder.step(simulation, taken);
            let step = simulation.runs_done();
            let is_frame = step.is_multiple_of(steps_per_frame) || step == steps;
            if is_frame {
                recorder.frame(simulation)?;
            }
            let frame = is_frame.then(|| step.div_ceil(steps_per_frame));
            after(simulation, &recorder, frame, seconds())
        });
        let result = result.map_err(|failure| Failure::from(format!("{path}: {failure}")));
        let seconds = seconds();
        for sentence in remarks.into_iter().chain(start_sentences(&simulation)) {
            recorder.remark(sentence);
        }
        if let Err(failure) = &result {
            // In this frame it was blocked, or could not continue.
            recorder.frame(&simulation)?;
            recorder.remark(failure.to_string());
        }
        Ok(SimulationRun {
            steps,
            recording: recorder.finish(seconds),
            simulation,
            result,
        })
    }

    fn run_one(&self) -> Result<(), Failure> {
        let start = |simulation: &mut Simulation, recorder: &mut SimulationRecorder| {
            if !self.resume {
                self.write_frame(simulation, 0)?;
                return Ok(0.0);
            }
            let saved = self.read_checkpoint()?;
            let of_file = |error: String| format!("{}: {error}", self.file("checkpoint").display());
            let damaged = || of_file(CheckpointError::Damaged.to_string());
            let (state, recorded) = split(&saved).ok_or_else(damaged)?;
            simulation.resume(state).map_err(|error| of_file(error.to_string()))?;
            Ok(recorder.restore(recorded, simulation).ok_or_else(damaged)?)
        };
        let mut last_checkpoint: Option<Instant> = None;
        let after = |simulation: &Simulation, recorder: &SimulationRecorder, frame: Option<u64>, seconds: f64| {
            if let Some(frame) = frame {
                self.write_frame(simulation, frame)?;
            }
            if last_checkpoint.is_none_or(|last| last.elapsed() >= CHECKPOINT_INTERVAL)
                && let Some(state) = simulation.checkpoint()
            {
                self.write_checkpoint(&state, &recorder.save(seconds))?;
                last_checkpoint = Some(Instant::now());
            }
            Ok(())
        };
        let SimulationRun {
            steps,
            simulation,
            mut recording,
            result,
        } = self.record(&self.scene, start, after)?;
        let costs = match self.effects_one_by_one {
            true => effect_costs(|| Scene::read(&self.scene), steps, self.threads.get())?,
            false => Vec::new(),
        };
        recording.added = costs_of_added_effects(&costs);

        let mut files = OutputFiles::default();
        files.add_bytes(self.file("html"), page::html(&recording).as_bytes())?;
        if self.frames == Some(Frames::Gltf) {
            files.add_bytes(self.file("glb"), &gltf::binary(&recording)?)?;
        }
        if let Some(picture) = &self.picture {
            let frame = self
                .at
                .map_or(recording.frames.len() - 1, |seconds| recording.frame_at(seconds));
            files.add_bytes(self.output.join(picture), &still::png(&recording, frame, still::STILL_SIZE)?)?;
        }
        files.publish()?;
        // Results up to the error are written and printed in any case.
        let printed = if self.json {
            let mut document = json::simulation(&simulation, &recording);
            if self.effects_one_by_one {
                document["effects_one_by_one"] = json::effects_one_by_one(&costs);
            }
            output::print_json(&document)
        } else {
            let mut text = tables::simulation(&simulation, &recording);
            if self.effects_one_by_one {
                text += "\n";
                text += &tables::effects_one_by_one(&costs);
            }
            output::print(&text)
        };
        result.and(printed)
    }

    fn write_checkpoint(&self, state: &[u8], recorded: &[u8]) -> Result<(), Failure> {
        let mut files = OutputFiles::default();
        files.add(self.file("checkpoint"), |out| {
            out.write_all(&(state.len() as u64).to_le_bytes())?;
            out.write_all(state)?;
            out.write_all(recorded)
        })?;
        files.publish_quietly()
    }

    fn read_checkpoint(&self) -> Result<Vec<u8>, Failure> {
        let path = self.file("checkpoint");
        let read = std::fs::read(&path);
        read.map_err(|error| {
            let path = path.display();
            format!("{path}: cannot be read: {error}; there may be no checkpoint yet").into()
        })
    }

    /// Creates the folders of the output files, and refuses files that cannot be written, before long work.
    fn check_outputs(&self) -> Result<(), Failure> {
        OutputFiles::check_folder(&self.output)?;
        let picture = self.picture.as_ref().map(|picture| self.output.join(picture));
        if let Some(folder) = picture.as_ref().and_then(|picture| picture.parent()) {
            OutputFiles::check_folder(folder)?;
        }
        let mut files = picture.into_iter().chain([self.file("html")]);
        files.try_for_each(|file| OutputFiles::check(&file))
    }

    /// Returns the output file with this extension, named after the scene's.
    fn file(&self, extension: &str) -> PathBuf {
        let stem = self.scene.file_stem().unwrap_or_default().to_string_lossy();
        // Not `with_extension`, which would give the reports of `shirt.a.toml` and `shirt.b.toml` one name.
        self.output.join(format!("{stem}.{extension}"))
    }

    fn write_frame(&self, simulation: &Simulation, frame: u64) -> Result<(), Failure> {
        let extension = match self.frames {
            None | Some(Frames::Gltf) => return Ok(()),
            Some(Frames::Ply) => "ply",
            Some(Frames::Obj) => "obj",
        };
        let stem = self.scene.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}-{frame:05}.{extension}");
        let now = simulation.mesh_in_files();
        Ok(mesh::write_with_loose_edges(
            &self.output.join(name),
            &now.mesh,
            &now.loose_edges,
        )?)
    }
}
