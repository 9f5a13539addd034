//! Checks the states of a simulation with the exact oracle: none may hold an intersection or a number that is not finite.
//!
//! `cargo run --release -p selvedge-verification --example simulated_states -- SCENE.toml [--steps N] [--every N]
//!     [--time-step FACTOR] [--stiffness FACTOR] [--without EFFECT] [--state FILE]`
//!
//! Runs N steps (10,000 by default; after the scene's end its bodies and pins rest) and checks every state, or one in N with
//! `--every`. Factors multiply the scene's time step and all its stiffnesses. Two ropes that pass through each other leave no
//! trace in a state. So the paths of loose edges are checked as well, in all steps that were not cut into parts, which bend
//! paths. Without `self_collision` the run must fail, which shows that it can. Prints a row for the table of long runs.
//!
//! With `--state` the run survives a kill: that file keeps the findings and a checkpoint of the simulation every 200 steps, and
//! the same command resumes from there. More steps than before are allowed; everything else must be the same, the program
//! included. Exit status 1 if a state is invalid, a step failed, or the scene or the state file cannot be read.

use indicatif::{ProgressBar, ProgressIterator, ProgressStyle};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Scene, Simulation};
use selvedge_verification::campaign::{Digest, FileError, StateFile, read_as};
use selvedge_verification::oracle::{edges_that_meet, intersections_with_loose_edges};
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

const USAGE: &str = "usage: simulated_states SCENE.toml [--steps N] [--every N] [--time-step FACTOR] [--stiffness FACTOR] [--without EFFECT] [--state FILE]";

type Failure = Box<dyn std::error::Error>;

struct Options {
    scene: PathBuf,
    steps: u64,
    every: u64,
    time_step: f64,
    stiffness: f64,
    without: Option<String>,
    state: Option<PathBuf>,
}

impl Options {
    fn parse(mut arguments: impl Iterator<Item = String>) -> Option<Self> {
        let mut options = Self {
            scene: arguments.next()?.into(),
            steps: 10_000,
            every: 1,
            time_step: 1.0,
            stiffness: 1.0,
            without: None,
            state: None,
        };
        while let Some(option) = arguments.next() {
            let value = arguments.next()?;
            let factor = || value.parse().ok();
            let count = || value.replace('_', "").parse().ok().filter(|&n| n > 0);
            match option.as_str() {
                "--steps" => options.steps = count()?,
                "--every" => options.every = count()?,
                "--time-step" => options.time_step = factor()?,
                "--stiffness" => options.stiffness = factor()?,
                "--without" => options.without = Some(value),
                "--state" => options.state = Some(value.into()),
                _ => return None,
            }
        }
        Some(options)
    }

    fn load(&self) -> Result<Simulation, Failure> {
        let mut table = None;
        let mut text = String::new();
        for line in std::fs::read_to_string(&self.scene)?.lines() {
            if let Some(name) = line.strip_prefix('[') {
                table = name.strip_prefix("effects.").and_then(|name| name.strip_suffix(']'));
            }
            if self.without.is_some() && table == self.without.as_deref() {
                continue;
            }
            let factor = match line.split_once(" = ") {
                Some(("time_step", _)) => self.time_step,
                Some(("stiffness" | "weft_stiffness", _)) => self.stiffness,
                _ => 1.0,
            };
            text += &scaled(line, factor)?;
            text.push('\n');
        }
        Ok(Simulation::new(Scene::parse(&text, &self.scene)?, 1)?)
    }
}

/// Multiplies the number in a line `key = "number unit"` by a factor. Leaves the line unchanged if the factor is one.
#[expect(clippy::float_cmp, reason = "exactly one by default")]
fn scaled(line: &str, factor: f64) -> Result<String, Failure> {
    if factor == 1.0 {
        return Ok(line.to_owned());
    }
    let parts = line.split_once('"').and_then(|(key, value)| {
        let (number, unit) = value.split_once(' ')?;
        Some((key, number.parse::<f64>().ok()?, unit))
    });
    let (key, number, unit) = parts.ok_or_else(|| format!("no text with a unit: {line}"))?;
    Ok(format!("{key}\"{} {unit}", number * factor))
}

/// The findings of a run.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Seen {
    states: u64,
    /// Steps with loose edges whose paths were checked.
    ways: u64,
    largest_speed: f64,
    in_oracle: Duration,
    in_all: Duration,
}

impl Seen {
    fn look_at(&mut self, simulation: &Simulation) -> Result<(), Failure> {
        let step = simulation.steps_done();
        let positions: Vec<_> = simulation.positions().iter().map(|p| p.to_array()).collect();
        if let Some(vertex) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(format!("after step {step}: vertex {vertex} is not finite").into());
        }
        let begin = Instant::now();
        let cloth = simulation.cloth_triangles();
        let found = intersections_with_loose_edges(&positions, simulation.triangles(), simulation.loose_edges(), cloth);
        self.in_oracle += begin.elapsed();
        self.states += 1;
        if !found.is_empty() {
            return Err(format!("after step {step}: these faces and loose edges (a, b, b) intersect: {found:?}").into());
        }
        Ok(())
    }

    /// Checks the paths of a step that was not cut, from the positions before it.
    fn look_at_way(&mut self, before: &[DVec3], simulation: &Simulation) -> Result<(), Failure> {
        let [start, end] = [before, simulation.positions()].map(|all| all.iter().map(|p| p.to_array()).collect::<Vec<_>>());
        let begin = Instant::now();
        let found = edges_that_meet(&start, &end, simulation.loose_edges());
        self.in_oracle += begin.elapsed();
        self.ways += 1;
        if !found.is_empty() {
            let step = simulation.steps_done();
            return Err(format!("in step {step}: these loose edges meet on their paths: {found:?}").into());
        }
        Ok(())
    }
}

/// The state of a run that may be resumed, as `--state` keeps it.
#[derive(Serialize, Deserialize)]
struct Kept {
    /// The digest of the program: the findings of one program do not count for another.
    program: Digest,
    every: u64,
    seen: Seen,
    /// A checkpoint, which knows its scene with its stiffness and time step.
    checkpoint: Vec<u8>,
}

/// The file that keeps a run.
struct Keeper {
    file: StateFile,
    program: Digest,
    every: u64,
}

impl Keeper {
    /// Reads the file, if there is one. Restores the simulation, and returns the earlier findings.
    fn open(path: &Path, options: &Options, simulation: &mut Simulation) -> Result<(Self, Seen), Failure> {
        let keeper = Self {
            file: StateFile::open(path, |message| eprintln!("{message}"))?,
            program: Digest::of_bytes([std::fs::read(std::env::current_exe()?)?]),
            every: options.every,
        };
        let Some(kept) = read_as::<Kept>(path)? else {
            return Ok((keeper, Seen::default()));
        };
        let refuse = |why: &dyn Display| format!("{}: {why}; delete it, or name another file", path.display());
        if kept.program != keeper.program {
            return Err(refuse(&"kept by another build of this program").into());
        }
        if kept.every != keeper.every {
            return Err(refuse(&format_args!("of a run with --every {}, not {}", kept.every, keeper.every)).into());
        }
        simulation.resume(&kept.checkpoint).map_err(|error| refuse(&error))?;
        let done = simulation.steps_done();
        if done > options.steps {
            return Err(format!(
                "{}: {done} steps are done, more than --steps {}",
                path.display(),
                options.steps
            )
            .into());
        }
        Ok((keeper, kept.seen))
    }

    /// Returns whether the simulation can be resumed here.
    fn keep(&self, seen: Seen, simulation: &Simulation) -> Result<(), FileError> {
        let Some(checkpoint) = simulation.checkpoint() else {
            return Ok(());
        };
        self.file.keep(&Kept {
            program: self.program,
            every: self.every,
            seen,
            checkpoint,
        })
    }
}

/// The number of steps that were cut into parts.
fn cuts_so_far(simulation: &Simulation) -> u64 {
    simulation.contact_counts().map_or(0, |counts| counts.cuts)
}

/// Runs the remaining steps, and returns the findings of all of them.
fn run(options: &Options) -> Result<(Simulation, Seen), Failure> {
    let mut simulation = options.load()?;
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} steps, {eta} left{msg}")?;
    let bar = ProgressBar::new(options.steps).with_style(style);
    let (keeper, mut seen) = match &options.state {
        Some(path) => {
            let (keeper, seen) = Keeper::open(path, options, &mut simulation)?;
            (Some(keeper), seen)
        }
        None => (None, Seen::default()),
    };
    let done = simulation.steps_done();
    bar.set_position(done);
    bar.reset_eta();
    for step in (done + 1..=options.steps).progress_with(bar.clone()) {
        let begin = Instant::now();
        let before = simulation.positions().to_vec();
        let cuts = cuts_so_far(&simulation);
        simulation.step()?;
        if !simulation.loose_edges().is_empty() && cuts_so_far(&simulation) == cuts {
            seen.look_at_way(&before, &simulation)?;
        }
        let moved = before.iter().zip(simulation.positions());
        let farthest = moved.fold(0.0, |most: f64, (a, b)| most.max((*b - *a).length()));
        let time_step = simulation.time() / step as f64;
        seen.largest_speed = seen.largest_speed.max(farthest / time_step);
        if step % options.every == 0 {
            seen.look_at(&simulation)?;
        }
        if step % 100 == 0 {
            bar.set_message(format!(", {} blocked", simulation.blocked_steps()));
        }
        // The clock is late exactly if a step was blocked: lost time is not made up for.
        if (simulation.blocked_steps() > 0) != (simulation.lag() > 0.0) {
            return Err(format!("after step {step}: behind, but not reported as blocked").into());
        }
        seen.in_all += begin.elapsed();
        if let Some(keeper) = &keeper {
            keeper.keep(seen, &simulation)?;
        }
    }
    Ok((simulation, seen))
}

/// Formats the row of the table.
fn tell(options: &Options, simulation: &Simulation, seen: Seen) {
    let counts = simulation.contact_counts().copied().unwrap_or_default();
    if !simulation.loose_edges().is_empty() {
        eprintln!(
            "ropes: the ways of {} of {} steps looked at, none passes through another",
            seen.ways, options.steps
        );
    }
    println!(
        "| {} | {} ms, × {:e} | {} | {} | 0 | {} ({:.3} s) | {} | {:.1} m/s | {:.0} s, {:.0} s |",
        simulation.name(),
        1e3 * simulation.time() / options.steps as f64,
        options.stiffness,
        options.steps,
        seen.states,
        simulation.blocked_steps(),
        simulation.lag(),
        counts.violated,
        seen.largest_speed,
        seen.in_all.as_secs_f64(),
        seen.in_oracle.as_secs_f64(),
    );
}

fn main() -> ExitCode {
    let Some(options) = Options::parse(std::env::args().skip(1)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match run(&options) {
        Ok((simulation, seen)) => {
            tell(&options, &simulation, seen);
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("{}: {failure}", options.scene.display());
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cloth that falls on itself, with every fifth state checked.
    fn options(state: Option<&Path>, more: &[&str]) -> Options {
        let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../std-adapter/cloth/scenes/fold.toml");
        let arguments = [scene, "--every", "5", "--steps", "400"]
            .into_iter()
            .chain(more.iter().copied());
        let mut options = Options::parse(arguments.map(str::to_owned)).unwrap();
        options.state = state.map(Path::to_owned);
        options
    }

    #[test]
    fn a_run_that_is_gone_on_with_ends_as_one_in_one_go_and_another_run_is_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("state.json");
        let refusal = |more: &[&str]| run(&options(Some(&file), more)).err().unwrap().to_string();

        // Killed after 230 steps, of which the last 30 are lost.
        run(&options(Some(&file), &["--steps", "230"])).unwrap();
        for (more, why) in [
            (["--every", "10"], "of a run with --every 5, not 10; delete it"),
            (["--stiffness", "2"], "another scene"),
            (["--time-step", "2"], "another scene"),
            (["--without", "friction"], "another scene"),
            (["--steps", "199"], "200 steps are done, more than --steps 199"),
        ] {
            let told = refusal(&more);
            assert!(told.contains("state.json: ") && told.contains(why), "{told}");
        }
        let (resumed, seen) = run(&options(Some(&file), &[])).unwrap();
        let (whole, all) = run(&options(None, &[])).unwrap();
        assert_eq!(resumed.positions(), whole.positions());
        assert_eq!((seen.states, seen.ways, all.states), (80, 0, 80));
        // JSON keeps it up to rounding.
        assert!((seen.largest_speed / all.largest_speed - 1.0).abs() < 1e-12 && all.largest_speed > 0.0);

        let kept: serde_json::Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
        let another = kept.to_string().replace(kept["program"].as_str().unwrap(), &"0".repeat(32));
        std::fs::write(&file, another).unwrap();
        assert!(refusal(&[]).contains("kept by another build of this program; delete it"));
        std::fs::write(&file, "{}").unwrap();
        assert!(refusal(&[]).contains("not a state of this campaign (missing field `program`"));
    }
}
