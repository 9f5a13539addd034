//! `selvedge` without a subcommand: simulates the arm sleeve and runs every method on its steps.

use super::Failure;
use super::compare::{Run, add_report};
use super::output::{self, OutputFiles};
use super::simulate::{effect_costs, run_steps};
use selvedge_cloth::{ARM_SLEEVE, Scene, Simulation};
use selvedge_laboratory::methods::Preset;
use selvedge_laboratory::report::{SimulationRecorder, Subject, costs_of_added_effects, json, page, tables};
use selvedge_laboratory::scene::ArmScene;
use selvedge_laboratory::study::SimulatedSteps;
use std::path::{Path, PathBuf};
use std::time::Instant;

const FILE: &str = "arm-sleeve.toml";

/// The arguments of `selvedge` alone.
#[derive(Debug, clap::Args)]
pub(crate) struct MainJob {
    /// Compare the methods on this many of the simulation's steps, evenly spread
    #[arg(long, value_name = "N", default_value_t = ArmScene::STEPS as u32, value_parser = clap::value_parser!(u32).range(1..))]
    steps: u32,
    #[command(flatten)]
    run: Run,
    /// Write the report (HTML), the comparison (HTML) and a picture of candidates (PNG) to this folder
    #[arg(long, value_name = "DIR", default_value = "selvedge-out")]
    output: PathBuf,
}

const IN_A_BROWSER: &str =
    "In a browser, live: run std-adapter/web/build.sh serve in the repository, and open http://localhost:8090\n";

impl MainJob {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        OutputFiles::check_folder(&self.output)?;
        let read = || Scene::parse(ARM_SLEEVE, Path::new(FILE));
        let scene = read()?;
        let (steps, steps_per_frame) = (scene.steps(), scene.steps_per_frame());
        let mut frames = SimulatedSteps::new(&scene, self.steps as usize)?;
        let subject = Subject::new(&scene);
        let mut simulation = Simulation::new(scene, self.run.threads.get())?;
        let mut recorder = SimulationRecorder::new(subject, &simulation)?;
        frames.observe(&simulation);
        let begin = Instant::now();
        run_steps(&mut simulation, steps, |simulation, taken| {
            recorder.step(simulation, taken);
            frames.observe(simulation);
            if simulation.runs_done().is_multiple_of(steps_per_frame) {
                recorder.frame(simulation)?;
            }
            Ok(())
        })?;
        let seconds = begin.elapsed().as_secs_f64();
        let costs = effect_costs(read, steps, self.run.threads.get())?;
        let mut recording = recorder.finish(seconds);
        recording.added = costs_of_added_effects(&costs);

        let comparison = self.run.compare(&frames, &Preset::ALL)?;
        let mut files = OutputFiles::default();
        let report = self.output.join(FILE).with_extension("html");
        files.add_bytes(report, page::html(&recording).as_bytes())?;
        add_report(&mut files, &self.output, &frames, &comparison)?;
        files.publish()?;
        if self.run.json {
            return output::print_json(&serde_json::json!({
                "simulation": json::simulation(&simulation, &recording),
                "effects_one_by_one": json::effects_one_by_one(&costs),
                "comparison": json::comparison(&comparison),
            }));
        }
        let effects = tables::effects_one_by_one(&costs);
        output::print(
            &[
                tables::simulation(&simulation, &recording),
                effects,
                tables::comparison(&comparison),
                IN_A_BROWSER.to_owned(),
            ]
            .join("\n"),
        )
    }
}
