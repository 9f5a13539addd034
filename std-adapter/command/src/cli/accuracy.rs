//! `selvedge accuracy`.

use super::Failure;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use selvedge_laboratory::report::{accuracy_svg, elementary_svg, json, tables};
use selvedge_laboratory::study::elementary::{ElementaryAccuracy, measure_elementary_accuracy};
use selvedge_laboratory::study::{AccuracyOptions, FilterAccuracy, Frames, TwoFrames, measure_accuracy};
use serde_json::{Map, Value};
use std::path::PathBuf;
use std::time::Duration;

/// Measures what accuracy costs in time, for filters and elementary tests
///
/// Filters range from the paper's plain filter, which culls a colliding pair now and then, to exact arithmetic. For each, the
/// table shows its share of exact culls, its culls without proof, and the time of a pair on each instruction set. The pairs are
/// candidates of the built-in arm scene, the same far from the origin, and random pairs that are nearly coplanar. If you name two
/// meshes (OBJ or PLY), the pairs of your step are measured as well. All sets are measured in f32 and in f64.
///
/// Elementary tests are the certified time of impact at tolerances from 1e-2 to 1e-12, with and without its error bounds, and the
/// exact verdict. The others are the plain cubic, Tight-Inclusion, additive and Bernstein sign tests. They run on such pairs and
/// on the built-in hard cases. The table shows time per pair, missed contacts, false alarms and the error of the time.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge accuracy
  selvedge accuracy frame-92.ply frame-93.ply --svg accuracy.svg
  selvedge accuracy --pairs 5000 --repeat 1 --json
  selvedge accuracy --only elementary --elementary-svg elementary.svg

Other load on the machine disturbs the times. Exact arithmetic works on the
coordinates that a filter gets, rounded to its format.")]
pub(crate) struct Accuracy {
    /// A mesh at the start of a step, whose pairs are measured as well
    #[arg(requires = "end")]
    start: Option<PathBuf>,
    /// The mesh at the end of that step
    end: Option<PathBuf>,
    /// Measure only the filters, or only the elementary tests
    #[arg(long, value_enum)]
    only: Option<Part>,
    /// Take this many pairs of each set at most, in evenly spaced runs. About 50,000 of them are timed
    #[arg(long, value_name = "N", default_value_t = 200_000, value_parser = clap::value_parser!(u32).range(1..))]
    pairs: u32,
    /// Run each timed pair this often through each filter; the fastest run counts
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// The seed of random pairs
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Cull only pairs that stay farther apart than this, in the unit of the positions
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = separation)]
    separation: f64,
    /// Limit each elementary test to this many seconds on one set; slower tests run on fewer pairs
    #[arg(long, value_name = "SECONDS", default_value = "0.4", value_parser = budget)]
    budget: Duration,
    /// Print one JSON document instead of tables, or write it to a file
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Write a plot of the filters' accuracy against time to this file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write a plot of the elementary tests' errors against time to this file
    #[arg(long, value_name = "FILE")]
    elementary_svg: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Part {
    Filters,
    Elementary,
}

/// Parses a length that both formats can hold.
fn separation(text: &str) -> Result<f64, String> {
    let length: f64 = text.parse().map_err(|_| "it is not a number")?;
    if (0.0..=f64::from(f32::MAX)).contains(&length) {
        Ok(length)
    } else {
        Err("it must be a length, zero or more, that f32 can hold".to_owned())
    }
}

fn budget(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "it is not a number")?;
    Duration::try_from_secs_f64(seconds).map_err(|_| "it must be a number of seconds, zero or more".to_owned())
}

impl Accuracy {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let json_file = self.json.as_ref().filter(|path| path.as_os_str() != "-");
        let files_of_plots = [&self.svg, &self.elementary_svg].map(Option::as_ref);
        let paths: Vec<_> = files_of_plots.into_iter().chain([json_file]).flatten().collect();
        for (index, path) in paths.iter().enumerate() {
            OutputFiles::check(path)?;
            if paths[..index].contains(path) {
                return Err(format!("{}: two outputs name the same file", path.display()).into());
            }
        }
        for (file, part, option) in [
            (&self.svg, Part::Filters, "--svg"),
            (&self.elementary_svg, Part::Elementary, "--elementary-svg"),
        ] {
            if file.is_some() && !self.measures(part) {
                return Err(format!("{option} needs the part that --only leaves out").into());
            }
        }
        let mesh = self.mesh()?;
        let mesh = mesh.as_ref().map(|mesh| mesh as &dyn Frames);
        let options = AccuracyOptions {
            pairs: self.pairs as usize,
            repeat: self.repeat,
            seed: self.seed,
            separation: self.separation,
            budget: self.budget,
        };
        let filters = self.measures(Part::Filters).then(|| {
            let progress = Progress::bar("filters");
            measure_accuracy(mesh, options, &mut |share| progress.set(share))
        });
        let filters = filters.transpose()?;
        let elementary = self.measures(Part::Elementary).then(|| {
            let progress = Progress::bar("elementary tests");
            let set = &mut |share| progress.set(share);
            measure_elementary_accuracy(mesh, options, set)
        });
        let elementary = elementary.transpose()?;

        let document = document(filters.as_ref(), elementary.as_ref());
        let mut files = OutputFiles::default();
        if let Some(path) = json_file {
            files.add_bytes(path.clone(), format!("{document:#}\n").as_bytes())?;
        }
        if let (Some(path), Some(filters)) = (&self.svg, &filters) {
            files.add_bytes(path.clone(), accuracy_svg(filters).as_bytes())?;
        }
        if let (Some(path), Some(elementary)) = (&self.elementary_svg, &elementary) {
            files.add_bytes(path.clone(), elementary_svg(elementary).as_bytes())?;
        }
        files.publish()?;
        if self.json.is_some() && json_file.is_none() {
            return output::print_json(&document);
        }
        let filters = filters.as_ref().map(tables::accuracy);
        let elementary = elementary.as_ref().map(tables::elementary);
        let texts: Vec<_> = filters.into_iter().chain(elementary).collect();
        output::print(&texts.join("\n"))
    }

    fn measures(&self, part: Part) -> bool {
        self.only.is_none_or(|only| only == part)
    }

    fn mesh(&self) -> Result<Option<TwoFrames>, Failure> {
        let (Some(start), Some(end)) = (&self.start, &self.end) else {
            return Ok(None);
        };
        let step = output::read_step(start, end)?;
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

/// Returns the filters' document, which contains that of the elementary tests.
fn document(filters: Option<&FilterAccuracy>, elementary: Option<&ElementaryAccuracy>) -> Value {
    let mut document = filters.map_or_else(|| Value::Object(Map::new()), json::accuracy);
    if let Some(elementary) = elementary {
        document["elementary"] = json::elementary(elementary);
    }
    document
}
