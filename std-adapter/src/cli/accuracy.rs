//! `selvedge accuracy`.

use super::Failure;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use selvedge::mesh::read_step;
use selvedge::report::{accuracy_svg, json, tables};
use selvedge::study::{AccuracyOptions, TwoFrames, measure_accuracy};
use std::path::PathBuf;

/// Measures what accuracy costs in time: every non-coplanarity filter on the same pairs.
///
/// From the paper's plain filter, which culls a colliding pair now and then, to exact arithmetic: how much of what exact
/// arithmetic culls each one culls, what it culls without proof, and how long a pair takes on each instruction set. The
/// pairs are candidates of the built-in arm scene, the same far from the origin, random pairs that are nearly coplanar, and
/// those of your own step between two meshes (OBJ or PLY) if you name it; in f32 and in f64.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge accuracy
  selvedge accuracy frame-92.ply frame-93.ply --svg accuracy.svg
  selvedge accuracy --pairs 5000 --repeat 1 --json

Times are only as quiet as the machine. In each format, a filter is compared
with exact arithmetic on the coordinates that it is given, rounded to it.")]
pub(crate) struct Accuracy {
    /// The mesh at the start of a step to take pairs from as well
    #[arg(requires = "end")]
    start: Option<PathBuf>,
    /// The mesh at the end of that step
    end: Option<PathBuf>,
    /// How many pairs to take of each set; of a larger set, evenly spaced runs. About 50,000 of them are timed
    #[arg(long, value_name = "N", default_value_t = 200_000, value_parser = clap::value_parser!(u32).range(1..))]
    pairs: u32,
    /// How often each timed pair goes through each filter; the fastest counts
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// Where random pairs begin
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Cull only pairs that stay farther apart than this, in the positions' unit
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = separation)]
    separation: f64,
    /// Print one JSON document instead of tables, or write it to a file
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Write a plot of accuracy against time to this file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// A length that both formats know.
fn separation(text: &str) -> Result<f64, String> {
    let length: f64 = text.parse().map_err(|_| "it is not a number")?;
    if (0.0..=f64::from(f32::MAX)).contains(&length) {
        Ok(length)
    } else {
        Err("it must be a length, zero or more, that f32 can hold".to_owned())
    }
}

impl Accuracy {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let json_file = self.json.as_ref().filter(|path| path.as_os_str() != "-");
        for path in [json_file, self.svg.as_ref()].into_iter().flatten() {
            OutputFiles::check(path)?;
        }
        if json_file.is_some() && json_file == self.svg.as_ref() {
            return Err("--json and --svg name the same file".into());
        }
        let mesh = self.mesh()?;
        let accuracy = {
            let progress = Progress::bar("measuring");
            let options = AccuracyOptions {
                pairs: self.pairs as usize,
                repeat: self.repeat,
                seed: self.seed,
                separation: self.separation,
            };
            measure_accuracy(mesh.as_ref(), options, &mut |share| progress.set(share))?
        };
        let mut files = OutputFiles::default();
        if let Some(path) = json_file {
            let document = format!("{:#}\n", json::accuracy(&accuracy));
            files.add_bytes(path.clone(), document.as_bytes())?;
        }
        if let Some(path) = &self.svg {
            files.add_bytes(path.clone(), accuracy_svg(&accuracy).as_bytes())?;
        }
        files.publish()?;
        if self.json.is_some() && json_file.is_none() {
            output::print_json(&json::accuracy(&accuracy))
        } else {
            output::print(&tables::accuracy(&accuracy))
        }
    }

    fn mesh(&self) -> Result<Option<TwoFrames>, Failure> {
        let (Some(start), Some(end)) = (&self.start, &self.end) else {
            return Ok(None);
        };
        let _progress = Progress::spinner("reading");
        let step = read_step(start, end)?;
        output::say(format_args!("{}: {}", start.display(), step.notes));
        let stem = |path: &PathBuf| {
            let stem = path.file_stem().unwrap_or(path.as_os_str());
            stem.to_string_lossy().into_owned()
        };
        Ok(Some(TwoFrames {
            name: format!("{} to {}", stem(start), stem(end)),
            topology: step.topology,
            start: step.start,
            end: step.end,
        }))
    }
}
