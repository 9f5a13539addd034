use super::table;
use crate::report::number::{counted, figures, signed_time, time};
use crate::study::EffectCost;
use selvedge_cloth::Simulation;

/// What a step costs with the first of the effects, with the first two, and so on.
#[must_use]
pub fn effects_one_by_one(costs: &[EffectCost]) -> String {
    let mut before = None;
    let rows = costs.iter().map(|cost| {
        let more = before.map_or(0.0, |before| cost.seconds - before);
        before = Some(cost.seconds);
        [
            cost.added.unwrap_or("no effect").to_owned(),
            time(cost.seconds),
            signed_time(more),
        ]
    });
    table(["effect added", "a step", "more than before"], rows)
}

/// A simulation that has taken `seconds` so far.
#[must_use]
pub fn simulation(simulation: &Simulation, seconds: f64) -> String {
    let steps = simulation.steps_done();
    let per_step = |(name, seconds): (&str, f64)| [name.to_owned(), time(seconds / steps.max(1) as f64)];
    let stretch = simulation.edge_stretch();
    let mut text = format!(
        "{}: {} in {}, {} a second\nat the end 99 % of the edges are at most {:.3} times as long as at rest, the longest {:.3}\n\n",
        simulation.name(),
        counted(steps, "step"),
        time(seconds),
        figures(steps as f64 / seconds),
        stretch.percentile_99,
        stretch.largest,
    );
    let effects = simulation.effects().iter();
    let mut rows: Vec<_> = effects.map(|effect| per_step((effect.name, effect.seconds))).collect();
    if let Some(seconds) = simulation.contact_seconds() {
        rows.extend(seconds.stages().map(per_step));
    }
    text += &table(["effect or stage", "a step"], rows);
    if let Some(counts) = simulation.contact_counts() {
        let mean = |(name, count): (&str, u64)| {
            let mean = count as f64 / steps.max(1) as f64;
            [name.to_owned(), format!("{mean:.3}")]
        };
        let rows = { counts.pairs().into_iter() }.chain(counts.events());
        text += "\n";
        text += &table(["pairs and events", "a step"], rows.map(mean));
    }
    if simulation.blocked_steps() > 0 {
        let blocked = counted(simulation.blocked_steps(), "step");
        text += &format!(
            "\nblocked in {blocked}; bodies and pins are {} behind\n",
            time(simulation.lag())
        );
    }
    text
}
