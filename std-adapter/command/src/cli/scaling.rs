//! `selvedge scaling`.

use super::Failure;
use super::options::{Threads, preset_parser, refinement_parser};
use super::output::{self, OutputFiles};
use super::progress::Progress;
use selvedge_laboratory::methods::Preset;
use selvedge_laboratory::report::{json, scaling_svg, tables};
use selvedge_laboratory::scene::ArmScene;
use selvedge_laboratory::study::{ArmFrames, ScalingPoint, measure_size};
use std::path::PathBuf;

/// The place of the measured step in the bend, where the inner side of the elbow has folded onto itself.
const TIME: f64 = 0.9;
/// The number of runs of the step, of which the fastest counts.
const ROUNDS: usize = 5;

/// Measures the cost of a step as the mesh grows
///
/// Runs one late step of the arm scene, after the sleeve has folded, at several refinements, and compares its time with n log n.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge scaling
  selvedge scaling --sizes 1,10,100 --pipeline lv_2014 --output out")]
pub(crate) struct Scaling {
    /// Multiply the sleeve's 1,345 triangles by these, separated by commas
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1,10,100,1000", value_parser = refinement_parser())]
    sizes: Vec<u32>,
    /// Run this method: an author and year, or ours
    #[arg(long, value_name = "NAME", default_value_t = Preset::Selvedge, value_parser = preset_parser())]
    pipeline: Preset,
    #[command(flatten)]
    threads: Threads,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
    /// Write a plot (scaling.svg) to this folder
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
}

impl Scaling {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if let Some(folder) = &self.output {
            OutputFiles::check_folder(folder)?;
        }
        let points = self.measure()?;
        let mut files = OutputFiles::default();
        if let Some(folder) = &self.output {
            files.add_bytes(folder.join("scaling.svg"), scaling_svg(&points).as_bytes())?;
        }
        files.publish()?;
        let threads = self.threads.get();
        output::answer(
            self.json,
            || json::scaling(self.pipeline, threads, &points),
            || tables::scaling(self.pipeline, threads, &points),
        )
    }

    fn measure(&self) -> Result<Vec<ScalingPoint>, Failure> {
        let progress = Progress::bar("measuring");
        let all: f64 = self.sizes.iter().copied().map(f64::from).sum();
        let mut done = 0.0;
        let mut points = Vec::with_capacity(self.sizes.len());
        for &refinement in &self.sizes {
            // Edges shrink with the square root of the refinement, and so does the step.
            let steps = ArmScene::STEPS as f64 * f64::from(refinement).sqrt();
            let frames = ArmFrames::new(refinement, steps.round() as usize)?;
            let frame = (TIME * steps) as usize;
            points.push(measure_size(&frames, frame, self.pipeline, self.threads.get(), ROUNDS)?);
            done += f64::from(refinement);
            progress.set(done / all);
        }
        Ok(points)
    }
}
