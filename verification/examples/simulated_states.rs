//! Checks the states of a simulation with the exact oracle: none may hold an intersection or a number that is not finite.
//!
//! `cargo run --release -p selvedge-verification --example simulated_states -- SCENE.toml [--steps N] [--every N]
//!     [--time-step FACTOR] [--stiffness FACTOR] [--without EFFECT]`
//!
//! Runs N steps (10,000 by default; after the scene's end its bodies and pins rest) and checks every state, or one in N with
//! `--every`. Factors multiply the scene's time step and all its stiffnesses. Two ropes that pass through each other leave no
//! trace in a state. So the paths of loose edges are checked as well, in all steps that were not cut into parts, which bend
//! paths. Without `self_collision` the run must fail, which shows that it can. The exit status is 1 if a state is invalid, a step
//! failed, or the scene cannot be read.

use clap::Parser;
use indicatif::{ProgressBar, ProgressIterator, ProgressStyle};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Scene, Simulation};
use selvedge_verification::oracle::{edges_that_meet, intersections_with_loose_edges};
use std::path::PathBuf;
use std::process::ExitCode;

type Failure = Box<dyn std::error::Error>;

#[derive(Parser)]
struct Options {
    scene: PathBuf,
    #[arg(long, default_value_t = 10_000)]
    steps: u64,
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

fn run(options: &Options) -> Result<(Simulation, Findings), Failure> {
    let mut simulation = options.load()?;
    let mut findings = Findings::default();
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} steps, {eta} left{msg}")?;
    let bar = ProgressBar::new(options.steps).with_style(style);
    for step in (1..=options.steps).progress_with(bar.clone()) {
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
    let counts = simulation.contact_counts().copied().unwrap_or_default();
    println!(
        "{}: {} states and the paths of {} steps are free of intersections; {} steps were blocked, {} pairs repaired, {:.1} m/s at most",
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
    match run(&options) {
        Ok((simulation, findings)) => {
            report(&simulation, findings);
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("{}: {failure}", options.scene.display());
            ExitCode::FAILURE
        }
    }
}
