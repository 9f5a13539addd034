use super::table;
use crate::report::number::{grouped, time};
use crate::simulation::Simulation;

/// A simulation from step `first` on, which took `seconds`.
#[must_use]
pub fn simulation(simulation: &Simulation, first: u64, seconds: f64) -> String {
    let steps = simulation.steps_done() - first;
    let per_step = |seconds: f64| time(seconds / steps.max(1) as f64);
    let mut text = format!(
        "{}: {} steps in {}, {} a second\n\n",
        simulation.name(),
        grouped(steps),
        time(seconds),
        grouped((steps as f64 / seconds) as u64),
    );
    let effects = simulation.effects().iter();
    let effects = effects.map(|effect| [effect.name.to_owned(), per_step(effect.seconds)]);
    let stages = simulation.contact_seconds().map(|seconds| {
        [
            ("candidate pairs", seconds.candidates),
            ("contact set-up", seconds.rows),
            ("certificates", seconds.certificates),
            ("repairs", seconds.repairs),
        ]
        .map(|(stage, seconds)| [stage.to_owned(), per_step(seconds)])
    });
    let rows = effects.chain(stages.into_iter().flatten());
    text += &table(["effect or stage", "a step"], rows);
    if let Some(counts) = simulation.contact_counts() {
        let mean = |count: u64| format!("{:.3}", count as f64 / steps.max(1) as f64);
        let rows = [
            ("candidate pairs", counts.candidates),
            ("not settled by remembered directions", counts.looked_at),
            ("pushed apart", counts.pushed),
            ("not free, repaired", counts.violated),
            ("vertices held", counts.held),
            ("times cut in half", counts.cuts),
        ]
        .map(|(what, count)| [what.to_owned(), mean(count)]);
        text += "\n";
        text += &table(["pairs", "a step"], rows);
    }
    if simulation.blocked_steps() > 0 {
        let blocked = grouped(simulation.blocked_steps());
        text += &format!(
            "\nblocked in {blocked} steps; bodies and pins are {} behind\n",
            time(simulation.lag())
        );
    }
    text
}
