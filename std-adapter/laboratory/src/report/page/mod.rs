//! Writes a simulation's report: one HTML file that needs neither network nor server.
//!
//! All numbers are in tables that need no script. Scripts in the page draw the animation (WebGL 2) and the charts (SVG) from data
//! in the page; `data` describes how it is packed.

mod data;
mod measures;
mod tables;
#[cfg(test)]
mod tests;

pub(super) use self::measures::ShownMeasure;
pub(super) use self::tables::bar;
use super::number::{counted, grouped, moment, ordinal, three_figures, time};
use super::recording::{LONGEST_EDGE, Measure, PartKind, Recording, Series, SeriesKind};
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("assets/page.css");
/// The scripts, each after those that it needs.
const SCRIPTS: [(&str, &str); 6] = [
    ("data", include_str!("assets/data.js")),
    ("algebra", include_str!("assets/algebra.js")),
    ("shaders", include_str!("assets/shaders.js")),
    ("viewer", include_str!("assets/viewer.js")),
    ("charts", include_str!("assets/charts.js")),
    ("player", include_str!("assets/player.js")),
];

/// Returns the whole page.
///
/// A section without data is left out.
pub fn html(recording: &Recording) -> String {
    let about = &recording.about;
    let has = |wanted: fn(SeriesKind) -> bool| recording.steps > 0 && recording.series_of(wanted).next().is_some();
    let body = html! {
        header {
            p.kicker { "selvedge simulate" }
            h1 { (about.name) }
            p.lead { (summary(recording)) }
        }
        main {
            @for remark in &recording.remarks { p.remark role="note" { (remark) } }
            (animation(recording))
            (tiles(recording))
            (measures::sections(recording))
            @if has(|kind| kind == SeriesKind::Pairs) {
                section {
                    h2 { "Pairs after each stage" }
                    div.chart data-kind="pairs" {}
                    (tables::pairs(recording))
                }
            }
            @if has(|kind| kind == SeriesKind::Events) {
                section {
                    h2 { "Events" }
                    div.chart data-kind="events" {}
                    (tables::events(recording))
                }
            }
            @if has(|kind| matches!(kind, SeriesKind::Effect | SeriesKind::Stage)) {
                section {
                    h2 { "Time of each effect and each stage" }
                    @if has(|kind| kind == SeriesKind::Step) { div.chart data-kind="step" {} }
                    @if has(|kind| kind == SeriesKind::Effect) { div.chart data-kind="effect" {} }
                    @if has(|kind| kind == SeriesKind::Stage) { div.chart data-kind="stage" {} }
                    (tables::times(recording))
                }
            }
            @if !recording.added.is_empty() {
                section {
                    h2 { "Effects added one at a time" }
                    (tables::added_effects(recording))
                }
            }
            @if has(|kind| matches!(kind, SeriesKind::Gauge(_))) {
                section {
                    h2 { "State" }
                    div.chart data-kind="gauge" {}
                    (tables::gauges(recording))
                }
            }
            @if !about.fabric.is_empty() {
                section {
                    h2 { "The fabric" }
                    (tables::knobs(["property", "value"], &about.fabric))
                }
            }
            @if !about.knobs.is_empty() {
                section {
                    h2 { "Settings that trade time for accuracy" }
                    (tables::knobs(["setting", "value"], &about.knobs))
                }
            }
            @if !about.scene.is_empty() {
                section {
                    h2 { "Scene" }
                    pre tabindex="0" aria-label="the scene file" { code { (about.scene) } }
                }
            }
        }
        footer {
            p {
                "Written by selvedge " (env!("CARGO_PKG_VERSION"))
                ". This file is self-contained: it loads nothing."
            }
        }
        (data::blocks(recording))
        @for (name, script) in SCRIPTS { script data-name=(name) { (PreEscaped(script)) } }
    };
    document(&about.name, &body)
}

/// Returns a complete page around a body.
pub(super) fn document(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content=(concat!("selvedge ", env!("CARGO_PKG_VERSION")));
                // The page makes no request, not even for an icon.
                link rel="icon" href="data:,";
                title { (title) " – selvedge" }
                style { (PreEscaped(STYLE)) }
            }
            body { (body) }
        }
    };
    page.into_string()
}

/// Describes the simulation in one sentence.
fn summary(recording: &Recording) -> String {
    let count = |kind: PartKind| {
        let parts = recording.parts.iter().filter(move |part| part.kind() == kind);
        parts.fold([0; 3], |[n, vertices, triangles], part| {
            [n + 1, vertices + part.vertex_count(), triangles + part.triangles().len()]
        })
    };
    let [n, vertices, triangles] = count(PartKind::Cloth);
    let cloths = if n == 1 { "Cloth".to_owned() } else { format!("{n} cloths") };
    let mut summary = format!(
        "{cloths} of {} vertices and {} triangles",
        grouped(vertices),
        grouped(triangles)
    );
    match count(PartKind::Body) {
        [0, ..] => {}
        [n, _, triangles] => {
            let bodies = if n == 1 { "body" } else { "bodies" };
            summary += &format!(", {n} {bodies} of {} triangles", grouped(triangles));
        }
    }
    summary += &format!(
        "; {} of {}.",
        counted(recording.steps, recording.about.unit),
        time(recording.about.time_step)
    );
    summary
}

/// Events that show problems: steps that could not be made unchanged.
const TROUBLE: [&str; 4] = [
    "vertices held back",
    "times cut in half",
    "steps blocked",
    "steps beyond the limit",
];

/// Returns the most important numbers.
fn tiles(recording: &Recording) -> Markup {
    let effects = recording.series_of(|kind| kind == SeriesKind::Effect);
    let mut tiles = vec![(time(recording.duration()), "simulated".to_owned())];
    if let Some(seconds) = recording.wall_seconds {
        let steps = recording.steps as f64;
        tiles.push((time(seconds), "computed in".to_owned()));
        tiles.push((three_figures(steps / seconds), format!("{}s a second", recording.about.unit)));
    }
    let step_of = |steps: &Series| format!("slowest {}, the {}", recording.about.unit, ordinal(steps.largest_step));
    tiles.extend(recording.step_times().map(|steps| (time(steps.largest), step_of(steps))));
    let longest = recording.measure(LONGEST_EDGE);
    let longest = longest.filter(|longest| longest.largest.is_finite());
    let when = |longest: &Measure| {
        format!(
            "longest edge relative to rest, at {}",
            moment(recording.end_of(longest.largest_step))
        )
    };
    tiles.extend(longest.map(|longest| (format!("{:.3}", longest.largest), when(longest))));
    if recording.steps > 0 {
        let events = recording.series_of(|kind| kind == SeriesKind::Events);
        let trouble = events.filter(|event| TROUBLE.contains(&&*event.name));
        tiles.extend(trouble.map(|event| (grouped(event.total as u64), event.name.clone())));
    }
    tiles.push((grouped(effects.count()), "effects".to_owned()));
    html! {
        dl.tiles {
            @for (value, name) in &tiles { div { dt { (name) } dd { (value) } } }
        }
    }
}

/// Returns the canvas and its controls, which do nothing until the script starts.
fn animation(recording: &Recording) -> Markup {
    let bodies = recording.parts.iter().any(|part| part.kind() == PartKind::Body);
    let last = recording.frames.len() - 1;
    html! {
        section.animation aria-label="animation" {
            div.stage {
                canvas #view tabindex="0" role="img" aria-label="the cloth in motion; arrow keys turn the view, plus and minus zoom" {}
                p #no-view.fallback { "The animation needs scripts and WebGL 2, which this browser does not offer or has turned off. Everything else on this page works without them." }
                p.hint aria-hidden="true" { "drag: rotate · right drag: pan · wheel: zoom" }
            }
            div.controls {
                button #play type="button" disabled title="play or pause (space)" { "Play" }
                button #back type="button" disabled title="one frame back (,)" aria-label="one frame back" { "‹" }
                button #forward type="button" disabled title="one frame forward (.)" aria-label="one frame forward" { "›" }
                input #scrub type="range" min="0" max=(last) value="0" step="1" disabled aria-label="frame";
                output #clock for="scrub" {}
            }
            div.controls.minor {
                label { "Speed " select #speed disabled {
                    option value="2" { "2×" }
                    option value="1" selected { "1×" }
                    option value="0.5" { "½×" }
                    option value="0.25" { "¼×" }
                    option value="0.1" { "⅒×" }
                } }
                label { input #edges type="checkbox" disabled; " edges" }
                @if bodies { label { input #bodies type="checkbox" checked disabled; " bodies" } }
                button #reset type="button" disabled title="the initial view (Home)" { "Reset view" }
                span.keys { kbd { "space" } " play · " kbd { "," } " " kbd { "." } " step · " kbd { "Home" } " reset" }
            }
        }
    }
}
