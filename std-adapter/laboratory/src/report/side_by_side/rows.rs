//! Numbers of both simulations, one row each.

use crate::report::label;
use crate::report::number::{grouped, three_figures, time};
use crate::report::recording::{Knob, MeasureKind, Recording, SeriesKind};
use maud::{Markup, html};

/// A number of both: its name, two texts, and the ratio of the second to the first.
pub(super) struct ComparedNumber {
    name: String,
    pub(super) values: [Option<String>; 2],
    ratio: Option<f64>,
}

impl ComparedNumber {
    fn new(name: impl Into<String>, values: [Option<f64>; 2], text: impl Fn(f64) -> String) -> Self {
        let ratio = match values {
            [Some(first), Some(second)] if first > 0.0 && second >= 0.0 => Some(second / first),
            _ => None,
        };
        Self {
            name: name.into(),
            values: values.map(|value| value.map(&text)),
            ratio,
        }
    }
}

pub(super) fn table(names: &[String; 2], rows: &[ComparedNumber]) -> Markup {
    let has_ratios = rows.iter().any(|row| row.ratio.is_some());
    html! {
        div.scroll { table {
            thead { tr {
                th scope="col" {}
                @for name in names { th scope="col" { (name) } }
                @if has_ratios { th scope="col" { "second over first" } }
            } }
            tbody { @for row in rows { tr {
                th scope="row" { (row.name) }
                @for value in &row.values { td { (value.as_deref().unwrap_or("–")) } }
                @if has_ratios { td { (row.ratio.map_or_else(|| "–".to_owned(), three_figures)) } }
            } } }
        } }
    }
}

/// Returns the rows: sizes, times, stretch, energy, events.
pub(super) fn figures(both: [&Recording; 2]) -> Vec<ComparedNumber> {
    let size = |recording: &Recording| recording.parts.iter().map(|part| part.triangles().len()).sum::<usize>() as f64;
    let whole = |number: f64| grouped(number as u64);
    let speed = |recording: &Recording| recording.wall_seconds.map(|seconds| recording.steps as f64 / seconds);
    let each = |recording: &Recording| recording.step_times().map(|steps| steps.total / recording.steps as f64);
    let slowest = |recording: &Recording| recording.step_times().map(|steps| steps.largest);
    let (unit, units) = match both.map(|one| one.about.unit) {
        [first, second] if first == second => (first, format!("{first}s")),
        _ => ("step or frame", "steps or frames".to_owned()),
    };
    let mut rows = vec![
        ComparedNumber::new("triangles, with bodies", both.map(|one| Some(size(one))), whole),
        ComparedNumber::new("time step", both.map(|one| Some(one.about.time_step)), time),
        ComparedNumber::new(units.clone(), both.map(|one| Some(one.steps as f64)), whole),
        ComparedNumber::new(format!("{units} a second"), both.map(speed), three_figures),
        ComparedNumber::new(format!("a {unit}"), both.map(each), time),
        ComparedNumber::new(format!("slowest {unit}"), both.map(slowest), time),
    ];
    for name in names_of(both.map(|one| {
        one.measures
            .iter()
            .filter(|m| m.kind == MeasureKind::Stretch)
            .map(|m| &*m.name)
            .collect()
    })) {
        let measure = |one: &Recording, pick: fn(&crate::report::Measure) -> Option<f64>| one.measure(name).and_then(pick);
        let text = |value: f64| format!("{value:.3}");
        rows.push(ComparedNumber::new(
            format!("{name} relative to rest, largest"),
            both.map(|one| measure(one, |m| Some(m.largest))),
            text,
        ));
        rows.push(ComparedNumber::new(
            format!("{name} relative to rest, at the end"),
            both.map(|one| measure(one, |m| m.values.last().copied())),
            text,
        ));
    }
    for name in names_of(both.map(|one| one.measures_of(MeasureKind::Energy).map(|m| &*m.name).collect())) {
        let last = |one: &Recording| {
            let mut energies = one.measures_of(MeasureKind::Energy);
            energies.find(|m| m.name == name).and_then(|m| m.values.last().copied())
        };
        let joules = |value: f64| format!("{} J", three_figures(value));
        rows.push(ComparedNumber::new(
            format!("{name} energy at the end"),
            both.map(last),
            joules,
        ));
    }
    for kind in [SeriesKind::Events, SeriesKind::Effect, SeriesKind::Stage] {
        let of_kind = |one: &'_ Recording| -> Vec<String> { one.series_of(|own| own == kind).map(|s| s.name.clone()).collect() };
        let lists = both.map(of_kind);
        for name in names_of([&lists[0], &lists[1]].map(|list| list.iter().map(String::as_str).collect())) {
            let total = |one: &Recording| {
                let mut series = one.series_of(|own| own == kind);
                series.find(|s| s.name == name).map(|s| s.total)
            };
            let a_step = |one: &Recording| total(one).map(|total| total / one.steps as f64);
            rows.push(match kind {
                SeriesKind::Events => ComparedNumber::new(name, both.map(total), whole),
                _ => ComparedNumber::new(format!("{}, a {unit}", label(name)), both.map(a_step), time),
            });
        }
    }
    rows
}

/// Returns settings and properties of the fabric that differ, or that one of the two lacks.
pub(super) fn different_settings(both: [&Recording; 2]) -> Vec<ComparedNumber> {
    let all = both.map(|one| one.about.fabric.iter().chain(&one.about.knobs).collect::<Vec<&Knob>>());
    let names = names_of([&all[0], &all[1]].map(|knobs| knobs.iter().map(|knob| &*knob.name).collect()));
    let row = |name: &str| ComparedNumber {
        name: name.to_owned(),
        values: [&all[0], &all[1]].map(|knobs| knobs.iter().find(|knob| knob.name == name).map(|knob| knob.value.clone())),
        ratio: None,
    };
    let rows = names.into_iter().map(row);
    rows.filter(|row| row.values[0] != row.values[1]).collect()
}

/// Returns the first's names, then those that only the second has.
fn names_of([first, second]: [Vec<&str>; 2]) -> Vec<&str> {
    let mut names = first;
    for name in second {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}
