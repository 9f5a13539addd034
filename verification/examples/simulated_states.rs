//! Checks the states of simulations with the exact oracle: none may hold an intersection or a number that is not finite.
//!
//! `cargo run --release -p selvedge-verification --example simulated_states -- SCENE.toml… [--steps N] [--every N]
//!     [--time-step FACTOR] [--stiffness FACTOR] [--without EFFECT]`
//!
//! Runs each scene to its end, or N steps (after the scene's end its bodies and pins rest), and checks every state, or one in N
//! with `--every`. It leaves out scenes without a contact effect, and reports the largest stretch in the checked states. Factors
//! multiply the scene's time step and all its stiffnesses. Two ropes that pass through each other leave no trace in a state. So
//! the paths of loose edges are checked as well, in all steps that were not cut into parts, which bend paths. Without
//! `self_collision` the run must fail, which shows that it can. The exit status is 1 if a state is invalid, a step failed, or the
//! scene cannot be read.

use clap::Parser;
use indicatif::{ProgressBar, ProgressIterator, ProgressStyle};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Scene, Simulation};
use selvedge_verification::oracle::{edges_that_meet, intersections_with_loose_edges};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

type Failure = Box<dyn std::error::Error>;

#[derive(Parser)]
struct Options {
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Run this many steps instead of those of the scene.
    #[arg(long)]
    steps: Option<u64>,
    /// Check one state in this many.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
    /// Multiply the time step.
    #[arg(long, default_value_t = 1.0)]
    time_step: f64,
    /// Multiply all stiffnesses.
    #[arg(long, default_value_t = 1.0)]
    stiffness: f64,
    /// Leave out this effect.
    #[arg(long)]
    without: Option<String>,
}

impl Options {
    /// Sets up a scene. Returns the number of steps to run as well.
    fn load(&self, path: &Path) -> Result<(Simulation, u64), Failure> {
        let mut table = None;
        let mut text = String::new();
        for line in std::fs::read_to_string(path)?.lines() {
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
        let scene = Scene::parse(&text, path)?;
        let steps = self.steps.unwrap_or(scene.steps());
        Ok((Simulation::new(scene, 1)?, steps))
    }
}

/// Multiplies the number in a line `key = "number unit"` by a factor. A factor of one leaves the line unchanged.
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
#[derive(Clone, Copy, Debug, Default)]
struct Findings {
    /// The number of checked states.
    states: u64,
    /// The number of steps with loose edges whose paths were checked.
    paths: u64,
    /// The largest speed, in metres per second.
    largest_speed: f64,
    /// The largest stretch of 99 % of the edges, and of the longest one.
    stretch: [f64; 2],
}

impl Findings {
    fn check_state(&mut self, simulation: &Simulation) -> Result<(), Failure> {
        let step = simulation.steps_done();
        let positions: Vec<_> = simulation.positions().iter().map(|p| p.to_array()).collect();
        if let Some(vertex) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(format!("after step {step}: vertex {vertex} is not finite").into());
        }
        let cloth = simulation.cloth_triangles();
        let found = intersections_with_loose_edges(&positions, simulation.triangles(), simulation.loose_edges(), cloth);
        self.states += 1;
        let stretch = simulation.edge_stretch();
        self.stretch = [
            self.stretch[0].max(stretch.percentile_99),
            self.stretch[1].max(stretch.largest),
        ];
        if !found.is_empty() {
            return Err(format!("after step {step}: these faces and loose edges (a, b, b) intersect: {found:?}").into());
        }
        Ok(())
    }

    /// Checks the paths of a step that was not cut, from the positions before it.
    fn check_paths(&mut self, before: &[DVec3], simulation: &Simulation) -> Result<(), Failure> {
        let [start, end] = [before, simulation.positions()].map(|all| all.iter().map(|p| p.to_array()).collect::<Vec<_>>());
        let found = edges_that_meet(&start, &end, simulation.loose_edges());
        self.paths += 1;
        if !found.is_empty() {
            let step = simulation.steps_done();
            return Err(format!("in step {step}: these loose edges meet on their paths: {found:?}").into());
        }
        Ok(())
    }
}

/// Returns the number of steps that were cut into parts.
fn cuts_so_far(simulation: &Simulation) -> u64 {
    simulation.contact_counts().map_or(0, |counts| counts.cuts)
}

fn run(options: &Options, path: &Path) -> Result<(Simulation, Findings), Failure> {
    let (mut simulation, steps) = options.load(path)?;
    let mut findings = Findings::default();
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} steps, {eta} left{msg}")?;
    let bar = ProgressBar::new(steps).with_style(style);
    let steps = if simulation.contact_counts().is_some() { steps } else { 0 };
    for step in (1..=steps).progress_with(bar.clone()) {
        let before = simulation.positions().to_vec();
        let cuts = cuts_so_far(&simulation);
        simulation.step()?;
        if !simulation.loose_edges().is_empty() && cuts_so_far(&simulation) == cuts {
            findings.check_paths(&before, &simulation)?;
        }
        let moved = before.iter().zip(simulation.positions());
        let farthest = moved.fold(0.0, |most: f64, (a, b)| most.max((*b - *a).length()));
        let time_step = simulation.time() / step as f64;
        findings.largest_speed = findings.largest_speed.max(farthest / time_step);
        if step % options.every == 0 {
            findings.check_state(&simulation)?;
        }
        if step % 100 == 0 {
            bar.set_message(format!(", {} blocked", simulation.blocked_steps()));
        }
        // The clock is late exactly if a step was blocked, since lost time is not made up for.
        if (simulation.blocked_steps() > 0) != (simulation.lag() > 0.0) {
            return Err(format!("after step {step}: behind, but not reported as blocked").into());
        }
    }
    Ok((simulation, findings))
}

fn report(simulation: &Simulation, findings: Findings) {
    let Some(counts) = simulation.contact_counts() else {
        return println!("{}: left out, since it has no contact effect", simulation.name());
    };
    let [most, longest] = findings.stretch;
    println!(
        "{}: {} states and the paths of {} steps are free of intersections; {} steps were blocked, {} pairs repaired, {:.1} m/s at most, \
         stretch {most:.4}/{longest:.4}",
        simulation.name(),
        findings.states,
        findings.paths,
        simulation.blocked_steps(),
        counts.violated,
        findings.largest_speed,
    );
}

fn main() -> ExitCode {
    let options = Options::parse();
    let mut status = ExitCode::SUCCESS;
    for path in &options.scenes {
        match run(&options, path) {
            Ok((simulation, findings)) => report(&simulation, findings),
            Err(failure) => {
                eprintln!("{}: {failure}", path.display());
                status = ExitCode::FAILURE;
            }
        }
    }
    status
}
