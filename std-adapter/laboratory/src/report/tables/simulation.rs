use super::table;
use crate::report::number::{counted, moment, ordinal, signed_time, three_figures, time};
use crate::report::recording::{EDGES_99, LONGEST_EDGE, Measure, MeasureKind, Recording};
use crate::report::start_sentences;
use crate::study::EffectCost;
use selvedge_cloth::Simulation;

/// Returns the cost of a step with no effect, with the first one, with the first two, and so on.
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

/// Returns a summary of a simulation and its recording.
pub fn simulation(simulation: &Simulation, recording: &Recording) -> String {
    let seconds = recording.wall_seconds.unwrap_or(f64::NAN);
    let steps = simulation.steps_done();
    let per_step = |(name, seconds): (&str, f64)| [name.to_owned(), time(seconds / steps.max(1) as f64)];
    let stretch = simulation.edge_stretch();
    let mut text = format!(
        "{}: {} in {}, {} a second\nat the end 99 % of the edges are at most {:.3} times as long as at rest, the longest {:.3}\n",
        simulation.name(),
        counted(steps, "step"),
        time(seconds),
        three_figures(steps as f64 / seconds),
        stretch.percentile_99,
        stretch.largest,
    );
    text += &at_worst(recording);
    text += "\n";
    let effects = simulation.effects().iter();
    let mut rows: Vec<_> = effects.map(|effect| per_step((effect.name, effect.seconds))).collect();
    rows.push(per_step(("solve", simulation.solve_seconds())));
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
    for (title, kind) in [("energy, in J", MeasureKind::Energy), ("force on, in N", MeasureKind::Load)] {
        if recording.measures_of(kind).next().is_some() {
            let rows = recording.measures_of(kind).map(row);
            text += "\n";
            text += &table([title, "at the start", "most", "at the end"], rows);
        }
    }
    text += &free_bodies(simulation);
    for sentence in start_sentences(simulation) {
        text += &format!("\n{sentence}\n");
    }
    let released = simulation.released();
    let times = released.iter().map(|release| release.time);
    if let (Some(first), Some(last)) = (times.clone().reduce(f64::min), times.reduce(f64::max)) {
        let vertices = released.len();
        text += &format!(
            "\nattachments released: {vertices}, from {} to {}\n",
            moment(first),
            moment(last)
        );
    }
    if let [first, .., last] | [first @ last] = simulation.torn_edges() {
        text += &format!(
            "\ntorn edges: {}, from {} to {}\n",
            simulation.torn_edges().len(),
            moment(first.time),
            moment(last.time)
        );
    }
    if simulation.blocked_steps() > 0 {
        let blocked = counted(simulation.blocked_steps(), "step");
        text += &format!(
            "\nblocked in {blocked}; bodies and pins are {} behind\n",
            time(simulation.lag())
        );
    }
    if simulation.overstretched_steps() > 0 {
        let steps = counted(simulation.overstretched_steps(), "step");
        // By frames the simulation has chosen its steps itself.
        let remedy = match simulation.frame_seconds() {
            None => ": use a shorter time step, or frames (no `time_step`)",
            Some(_) => "",
        };
        text += &format!("\nafter {steps} an edge was more than 5 % above its limit{remedy}\n");
    }
    text
}

/// Returns the motion of free bodies at the end; an empty text without them.
fn free_bodies(simulation: &Simulation) -> String {
    let bodies = simulation.body_names().iter().enumerate();
    let rows = bodies.filter_map(|(body, name)| {
        let motion = simulation.body_motion(body)?;
        let numbers = [motion.mass, motion.velocity.length(), motion.spin.length()];
        let [mass, speed, spin] = numbers.map(three_figures);
        Some([name.clone(), mass, speed, spin])
    });
    let rows: Vec<_> = rows.collect();
    if rows.is_empty() {
        return String::new();
    }
    let heads = ["free body, at the end", "mass, in kg", "speed, in m/s", "spin, in rad/s"];
    format!("\n{}", table(heads, rows))
}

/// Names the frame with the longest edges, and the slowest step or frame.
fn at_worst(recording: &Recording) -> String {
    let mut text = String::new();
    if let (Some(most), Some(longest)) = (recording.measure(EDGES_99), recording.measure(LONGEST_EDGE)) {
        let when = moment(recording.end_of(longest.largest_step));
        text += &format!("over all frames {:.3} and {:.3} (at {when})\n", most.largest, longest.largest);
    }
    if let Some(steps) = recording.step_times() {
        let (unit, place) = (recording.about.unit, ordinal(steps.largest_step));
        text += &format!("the slowest {unit}, the {place}, took {}\n", time(steps.largest));
    }
    text
}

/// Returns the name of a measure, and its values at the start, at most and at the end.
fn row(measure: &Measure) -> [String; 4] {
    let ends = [measure.values.first(), measure.values.last()];
    let [first, last] = ends.map(|end| end.copied().map_or_else(String::new, three_figures));
    [measure.name.clone(), first, three_figures(measure.largest), last]
}
