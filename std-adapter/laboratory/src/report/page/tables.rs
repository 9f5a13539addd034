//! What the charts show, in numbers.

use super::super::number::{grouped, mean, time};
use super::super::recording::{Recording, Series, SeriesKind};
use maud::{Markup, html};

/// Pairs after each stage: each as a share of the stage before.
pub(super) fn pairs(recording: &Recording) -> Markup {
    let rows: Vec<&Series> = recording.series_of(|kind| kind == SeriesKind::Pairs).collect();
    let share = |index: usize| {
        let before = rows.get(index.wrapping_sub(1))?.total;
        (before > 0.0).then(|| percent(rows[index].total / before))
    };
    html! {
        div.scroll { table {
            (head(&["stage", "pairs a step", "of the stage before", "most in a step", "all steps"]))
            tbody { @for (index, series) in rows.iter().enumerate() { tr {
                th scope="row" { (series.name) }
                td { (few(series.total / recording.steps as f64)) }
                td { (share(index).unwrap_or_else(absent)) }
                td { (extreme(series.largest, mean)) }
                td { (mean(series.total)) }
            } } }
        } }
    }
}

/// Counts that are no stage's.
pub(super) fn events(recording: &Recording) -> Markup {
    html! {
        div.scroll { table {
            (head(&["event", "a step", "most in a step", "all steps"]))
            tbody { @for series in recording.series_of(|kind| kind == SeriesKind::Events) { tr {
                th scope="row" { (series.name) }
                td { (few(series.total / recording.steps as f64)) }
                td { (extreme(series.largest, mean)) }
                td { (mean(series.total)) }
            } } }
        } }
    }
}

/// Effects, the stages that they share, and what is left of the time on the wall.
pub(super) fn times(recording: &Recording) -> Markup {
    let is_time = |kind| matches!(kind, SeriesKind::Effect | SeriesKind::Stage);
    let sum: f64 = recording.series_of(is_time).map(|series| series.total).sum();
    let whole = recording.wall_seconds.map_or(sum, |wall| wall.max(sum));
    let row = |name: &str, seconds: f64, largest: Option<f64>| {
        let share = if whole > 0.0 { seconds / whole } else { 0.0 };
        html! { tr {
            th scope="row" { (name) }
            td { (time(seconds / recording.steps as f64)) }
            td.share {
                (percent(share))
                span.bar aria-hidden="true" style=(format!("--share:{:.4}", share)) {}
            }
            td { (largest.map_or_else(absent, |largest| extreme(largest, time))) }
            td { (time(seconds)) }
        } }
    };
    let group = |title: &str, wanted: SeriesKind| {
        let mut rows: Vec<&Series> = recording.series_of(|kind| kind == wanted).collect();
        rows.sort_by(|a, b| b.total.total_cmp(&a.total));
        html! { @if !rows.is_empty() { tbody {
            tr.group { th colspan="5" scope="rowgroup" { (title) } }
            @for series in rows { (row(&series.name, series.total, Some(series.largest))) }
        } } }
    };
    html! {
        div.scroll { table {
            (head(&["", "a step", "share", "most in a step", "all steps"]))
            (group("effects", SeriesKind::Effect))
            (group("stages that effects share", SeriesKind::Stage))
            @if let Some(wall) = recording.wall_seconds { tbody {
                @if wall > sum { (row("everything else", wall - sum, None)) }
                (row("whole step, by the clock on the wall", wall, None))
            } }
        } }
    }
}

/// What a step costs with the first effect, with the first two, and so on: a bar each.
pub(super) fn added_effects(recording: &Recording) -> Markup {
    let most = { recording.added.iter() }.fold(0.0, |most: f64, added| most.max(added.seconds));
    let before = |index: usize| {
        let before = index.checked_sub(1).map(|index| &recording.added[index]);
        before.map(|before| recording.added[index].seconds - before.seconds)
    };
    html! {
        p { "Each row is a simulation of its own, with all effects down to that row. The cloth moves otherwise without the rest, so a difference is not only the effect's own work." }
        div.scroll { table {
            (head(&["effect added", "a step", "", "more than before"]))
            tbody { @for (index, added) in recording.added.iter().enumerate() { tr {
                th scope="row" { (added.name) }
                td { (time(added.seconds)) }
                td.share {
                    @let share = if most > 0.0 { added.seconds / most } else { 0.0 };
                    span.bar aria-hidden="true" style=(format!("--share:{share:.4}")) {}
                }
                td { (before(index).map_or_else(absent, signed_time)) }
            } } }
        } }
    }
}

fn signed_time(seconds: f64) -> String {
    let sign = if seconds < 0.0 { "−" } else { "+" };
    format!("{sign}{}", time(seconds.abs()))
}

/// Quantities of the state.
pub(super) fn gauges(recording: &Recording) -> Markup {
    let gauges = recording.series.iter().filter_map(|series| match series.kind {
        SeriesKind::Gauge(unit) => Some((series, unit)),
        _ => None,
    });
    html! {
        div.scroll { table {
            (head(&["quantity", "least", "mean", "most", "unit"]))
            tbody { @for (series, unit) in gauges { tr {
                th scope="row" { (series.name) }
                td { (extreme(series.smallest, few)) }
                td { (few(series.total / recording.steps as f64)) }
                td { (extreme(series.largest, few)) }
                td { (unit) }
            } } }
        } }
    }
}

/// Settings.
pub(super) fn knobs(recording: &Recording) -> Markup {
    html! {
        div.scroll { table.knobs {
            (head(&["setting", "value"]))
            tbody { @for knob in &recording.about.knobs { tr {
                th scope="row" { (knob.name) }
                td { (knob.value) }
            } } }
        } }
    }
}

/// A table's first row.
fn head(columns: &[&str]) -> Markup {
    html! { thead { tr { @for column in columns { th scope="col" { (column) } } } } }
}

/// A number with three figures or so, however small: `0.00123`; a dash if it is not finite.
fn few(number: f64) -> String {
    if !number.is_finite() {
        return absent();
    }
    let size = number.abs();
    if size >= 99.95 {
        let sign = if number < 0.0 { "−" } else { "" };
        return format!("{sign}{}", grouped(size.round() as u64));
    }
    if number == 0.0 {
        return "0".to_owned();
    }
    if size < 1e-4 {
        return format!("{number:.2e}");
    }
    let decimals = (2 - size.log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{number:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn percent(share: f64) -> String {
    format!("{}\u{a0}%", few(100.0 * share))
}

/// A smallest or largest value: there is none if there was no step.
fn extreme(value: f64, format: fn(f64) -> String) -> String {
    if value.is_finite() { format(value) } else { absent() }
}

fn absent() -> String {
    "–".to_owned()
}
