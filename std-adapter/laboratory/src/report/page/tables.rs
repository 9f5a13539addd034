//! Tables with the numbers behind the charts.

use super::super::label;
use super::super::number::{share, signed_time, three_figures, time};
use super::super::recording::{Knob, Recording, Series, SeriesKind};
use maud::{Markup, html};

/// A missing value, which every format shows as a dash.
const NONE: f64 = f64::NAN;

/// Returns the pairs after each stage, each as a share of the previous stage.
pub(super) fn pairs(recording: &Recording) -> Markup {
    let mut before = NONE;
    let rows = recording.series_of(|kind| kind == SeriesKind::Pairs).map(|series| {
        let of_stage_before = series.total / std::mem::replace(&mut before, series.total);
        let [a_step, most, all] = counts(recording, series);
        (&*series.name, [a_step, share(of_stage_before), most, all])
    });
    let [each, most, all] = &columns(recording);
    table(["stage", &format!("pairs {each}"), "of the previous stage", most, all], rows)
}

pub(super) fn events(recording: &Recording) -> Markup {
    let rows = recording.series_of(|kind| kind == SeriesKind::Events);
    let rows = rows.map(|series| (&*series.name, counts(recording, series)));
    let [each, most, all] = &columns(recording);
    table(["event", each, most, all], rows)
}

/// Returns the headings of [`counts`], such as `a step`, `most in a step` and `all steps`.
fn columns(recording: &Recording) -> [String; 3] {
    let unit = recording.about.unit;
    [format!("a {unit}"), format!("most in a {unit}"), format!("all {unit}s")]
}

/// Returns values per recorded step, the largest in one, and for all.
fn counts(recording: &Recording, series: &Series) -> [String; 3] {
    let a_step = series.total / recording.steps as f64;
    [
        three_figures(a_step),
        three_figures(series.largest),
        three_figures(series.total),
    ]
}

/// Returns effects, the stages that they share, and the rest of the wall-clock time.
pub(super) fn times(recording: &Recording) -> Markup {
    let is_time = |kind| matches!(kind, SeriesKind::Effect | SeriesKind::Stage);
    let sum: f64 = recording.series_of(is_time).map(|series| series.total).sum();
    let steps = recording.step_times();
    let wall = steps.map(|steps| steps.total).or(recording.wall_seconds);
    let whole = wall.map_or(sum, |wall| wall.max(sum));
    let row = |name: &str, seconds: f64, largest: f64| {
        let of_whole = if whole > 0.0 { seconds / whole } else { 0.0 };
        html! { tr {
            th scope="row" { (name) }
            td { (time(seconds / recording.steps as f64)) }
            td.share { (share(of_whole)) (bar(of_whole)) }
            td { (time(largest)) }
            td { (time(seconds)) }
        } }
    };
    // Contact, friction and pins act in the solve alone.
    let own = |seconds: f64| if seconds > 0.0 { seconds } else { NONE };
    let without = recording
        .series_of(|kind| kind == SeriesKind::Effect)
        .any(|series| own(series.total).is_nan());
    let group = |title: &str, wanted: SeriesKind| {
        let mut rows: Vec<&Series> = recording.series_of(|kind| kind == wanted).collect();
        rows.sort_by(|a, b| b.total.total_cmp(&a.total));
        html! { @if !rows.is_empty() { tbody {
            tr.group { th colspan="5" scope="rowgroup" { (title) } }
            @for series in rows { (row(&label(&series.name), own(series.total), own(series.largest))) }
        } } }
    };
    let [each, most, all] = &columns(recording);
    let whole_unit = format!("whole {}, by the wall clock", recording.about.unit);
    html! {
        div.scroll { table {
            (head(&["", each, "share", most, all]))
            (group("effects", SeriesKind::Effect))
            (group("shared stages", SeriesKind::Stage))
            @if let Some(wall) = wall { tbody {
                @if wall > sum { (row("everything else", wall - sum, NONE)) }
                (row(&whole_unit, wall, steps.map_or(NONE, |steps| steps.largest)))
            } }
        } }
        @if without { p.note { "An effect without a time of its own acts in a shared stage, such as the solve." } }
    }
}

/// Returns the cost of a step with no effect, with the first one, with the first two, and so on, with bars.
pub(super) fn added_effects(recording: &Recording) -> Markup {
    let most = { recording.added.iter() }.fold(0.0, |most: f64, added| most.max(added.seconds));
    let mut before = NONE;
    let rows = recording.added.iter().map(|added| {
        let more = added.seconds - std::mem::replace(&mut before, added.seconds);
        let cells = [
            html! { (time(added.seconds)) },
            bar(added.seconds / most),
            html! { (signed_time(more)) },
        ];
        (&*added.name, cells)
    });
    html! {
        p { "Each row is a separate simulation, with all effects down to that row. The cloth moves differently without the others, so a difference is not only the cost of the effect itself." }
        (table(["effect added", "a step", "", "more than before"], rows))
    }
}

/// Returns quantities of the state.
pub(super) fn gauges(recording: &Recording) -> Markup {
    let rows = recording.series.iter().filter_map(|series| {
        let SeriesKind::Gauge(unit) = series.kind else {
            return None;
        };
        let mean = series.total / recording.steps as f64;
        let [least, mean, most] = [series.smallest, mean, series.largest].map(three_figures);
        Some((&*series.name, [least, mean, most, unit.to_owned()]))
    });
    table(["quantity", "least", "mean", "most", "unit"], rows)
}

pub(super) fn knobs(headings: [&str; 2], knobs: &[Knob]) -> Markup {
    let knobs = knobs.iter();
    html! { div.knobs { (table(headings, knobs.map(|knob| (&*knob.name, [&*knob.value])))) } }
}

/// Returns a table whose rows begin with a name.
pub(super) fn table<'a, const H: usize, const N: usize, C: maud::Render>(
    headings: [&str; H],
    rows: impl Iterator<Item = (&'a str, [C; N])>,
) -> Markup {
    html! {
        div.scroll { table {
            (head(&headings))
            tbody { @for (name, cells) in rows { tr {
                th scope="row" { (name) }
                @for cell in cells { td { (cell) } }
            } } }
        } }
    }
}

/// Returns a table's header.
fn head(columns: &[&str]) -> Markup {
    html! { thead { tr { @for column in columns { th scope="col" { (column) } } } } }
}

/// Returns a share as a bar. A value that is not finite gives an empty bar.
pub(in crate::report) fn bar(share: f64) -> Markup {
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    html! { span.bar aria-hidden="true" style=(format!("--share:{share:.4}")) {} }
}
