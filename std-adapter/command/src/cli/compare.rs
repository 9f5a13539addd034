//! `selvedge compare`.

use super::Failure;
use super::options::{Threads, preset_parser, refinement_parser};
use super::output::{self, OutputFiles};
use super::progress::Progress;
use super::simulate::run_steps;
use clap::CommandFactory;
use clap::error::ErrorKind;
use selvedge_cloth::{Scene, Simulation};
use selvedge_laboratory::methods::Preset;
use selvedge_laboratory::report::{comparison_html, figure_3, json, tables};
use selvedge_laboratory::scene::ArmScene;
use selvedge_laboratory::study::{self, ArmFrames, Comparison, Frames, SimulatedSteps, TwoFrames, busiest_step, step_candidates};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub(super) struct Run {
    #[command(flatten)]
    pub(super) threads: Threads,
    /// Run each step this often with each method; the fastest run counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Print one JSON document instead of tables
    #[arg(long)]
    pub(super) json: bool,
}

/// Resolution of the arm scene, in time and in space.
#[derive(Debug, clap::Args)]
struct ArmOptions {
    /// Bend the arm in this many steps; with a scene file, compare on this many evenly spread steps
    #[arg(long, value_name = "N", default_value_t = ArmScene::STEPS as u32, value_parser = clap::value_parser!(u32).range(1..))]
    steps: u32,
    /// Multiply the sleeve's 1,345 triangles by this
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = refinement_parser())]
    refinement: u32,
}

impl ArmOptions {
    fn frames(&self) -> Result<ArmFrames, Failure> {
        Ok(ArmFrames::new(self.refinement, self.steps as usize)?)
    }
}

/// Runs every method on the same steps: the paper's Table 1
///
/// The steps are those of the built-in arm scene, or of a scene file (TOML), which is simulated first. Two meshes of equal
/// topology (OBJ or PLY) make one step. All methods share one broad phase and run each step in turn, so that their times compare.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge compare
  selvedge compare std-adapter/cloth/scenes/twist.toml --steps 100
  selvedge compare --pipelines lv_2014,selvedge --refinement 100 --threads 0
  selvedge compare frame-92.ply frame-93.ply --json")]
pub(crate) struct Compare {
    /// The mesh at the start of the step, or a scene file. The default is the arm scene
    #[arg(conflicts_with = "refinement")]
    start: Option<PathBuf>,
    /// The mesh at the end of the step
    #[arg(conflicts_with = "steps")]
    end: Option<PathBuf>,
    /// Run these methods, separated by commas. The default is all of them
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = preset_parser())]
    pipelines: Vec<Preset>,
    #[command(flatten)]
    arm: ArmOptions,
    #[command(flatten)]
    run: Run,
    /// Write the comparison (HTML) and a picture of candidates (PNG) to this folder
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
}

impl Compare {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        match (&self.start, &self.end) {
            (Some(start), Some(end)) => self.run_on(&read_frames(start, end)?),
            (Some(scene), None) => self.run_on(&self.simulated(scene)?),
            (None, _) => self.run_on(&self.arm.frames()?),
        }
    }

    /// Simulates a scene and collects its steps.
    fn simulated(&self, path: &Path) -> Result<SimulatedSteps, Failure> {
        if path.extension().is_none_or(|extension| extension != "toml") {
            let message = format!(
                "{}: one file alone must be a scene, a .toml file; after a mesh, name the mesh at the end of the step as well",
                path.display()
            );
            let mut command = super::Cli::command();
            command.error(ErrorKind::MissingRequiredArgument, message).exit();
        }
        let of_file = |failure: Failure| format!("{}: {failure}", path.display());
        let scene = Scene::read(path)?;
        let steps = scene.steps();
        let mut frames = SimulatedSteps::new(&scene, self.arm.steps as usize).map_err(|error| of_file(error.into()))?;
        let mut simulation = Simulation::new(scene, self.run.threads.get()).map_err(|error| of_file(error.into()))?;
        frames.observe(&simulation);
        run_steps(&mut simulation, steps, |simulation, _| {
            frames.observe(simulation);
            Ok(())
        })
        .map_err(of_file)?;
        Ok(frames)
    }

    fn run_on(&self, frames: &dyn Frames) -> Result<(), Failure> {
        if let Some(folder) = &self.output {
            OutputFiles::check_folder(folder)?;
        }
        let comparison = self.run.compare(frames, &self.presets())?;
        let mut files = OutputFiles::default();
        if let Some(folder) = &self.output {
            add_report(&mut files, folder, frames, &comparison)?;
        }
        files.publish()?;
        self.run.print(&comparison)
    }

    /// Returns each method once, in the order of the command line.
    fn presets(&self) -> Vec<Preset> {
        let mut presets = Vec::new();
        for &preset in &self.pipelines {
            if !presets.contains(&preset) {
                presets.push(preset);
            }
        }
        if presets.is_empty() {
            presets.extend(Preset::ALL);
        }
        presets
    }
}

impl Run {
    pub(super) fn compare(&self, frames: &dyn Frames, presets: &[Preset]) -> Result<Comparison, Failure> {
        let progress = Progress::bar("comparing");
        let rounds = self.rounds as usize;
        study::compare(frames, presets, self.threads.get(), rounds, &mut |share| {
            progress.set(share);
        })
    }

    fn print(&self, comparison: &Comparison) -> Result<(), Failure> {
        output::answer(self.json, || json::comparison(comparison), || tables::comparison(comparison))
    }
}

fn read_frames(start: &Path, end: &Path) -> Result<TwoFrames, Failure> {
    let step = output::read_step(start, end)?;
    Ok(TwoFrames {
        name: format!("{} to {}", start.display(), end.display()),
        topology: step.topology,
        start: step.start,
        end: step.end,
    })
}

/// Adds the files of a report: the table as a page, and the paper's Figure 3. The figure shows the step in which our method
/// leaves the most candidates.
pub(super) fn add_report(
    files: &mut OutputFiles,
    folder: &Path,
    frames: &dyn Frames,
    comparison: &Comparison,
) -> Result<(), Failure> {
    let _progress = Progress::spinner("drawing");
    files.add_bytes(folder.join("comparison.html"), comparison_html(comparison).as_bytes())?;

    let threads = comparison.threads;
    let step = busiest_step(frames, Preset::Selvedge, threads)?;
    let basic = step_candidates(frames, step, Preset::Basic, threads)?;
    let ours = step_candidates(frames, step, Preset::Selvedge, threads)?;
    let (mut start, mut positions) = (Vec::new(), Vec::new());
    frames.step(step, &mut start, &mut positions);
    let figure = figure_3(frames.topology(), &positions, [&basic, &ours])?;
    files.add_bytes(folder.join("figure-3.png"), &figure)
}
