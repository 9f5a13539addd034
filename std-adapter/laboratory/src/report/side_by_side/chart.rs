//! Charts of measures over time, one for both simulations.

use crate::report::number::{moment, three_figures};
use crate::report::page::ShownMeasure;
use crate::report::recording::{MeasureKind, Recording};
use maud::{Markup, html};

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 220.0;
const LEFT: f64 = 64.0;
const BOTTOM: f64 = 24.0;
const TOP: f64 = 8.0;

/// One measure of one simulation.
struct Line {
    colour: usize,
    is_second: bool,
    /// The seconds and values.
    points: Vec<[f64; 2]>,
}

/// Returns charts of energy, stretch and loads, if one of the two has them.
pub(super) fn sections(both: [&Recording; 2], names: &[String; 2]) -> Markup {
    let charts = [
        ("Energy, in J", MeasureKind::Energy),
        ("Edge lengths relative to rest", MeasureKind::Stretch),
        ("Force of the cloth on what holds it, in N", MeasureKind::Load),
    ];
    html! {
        @for (title, kind) in charts {
            @let (lines, colours) = lines(both, kind);
            @if lines.iter().any(|line| line.points.len() > 1) {
                section {
                    h2 { (title) }
                    div.chart { (drawing(&lines, title)) }
                    ul.legend {
                        @for (index, name) in colours.iter().enumerate() {
                            li { i style=(format!("background:var(--series-{index})")) {} (name) }
                        }
                        li { "solid: " (names[0]) ", dashed: " (names[1]) }
                    }
                }
            }
        }
    }
}

/// Returns the lines, and the meaning of each colour.
fn lines(both: [&Recording; 2], kind: MeasureKind) -> (Vec<Line>, Vec<String>) {
    let mut colours: Vec<String> = Vec::new();
    let mut lines = Vec::new();
    for (index, recording) in both.into_iter().enumerate() {
        for shown in ShownMeasure::all(recording).into_iter().filter(|shown| shown.kind == kind) {
            let known = colours.iter().position(|name| name == shown.name);
            let colour = known.unwrap_or(colours.len());
            if known.is_none() {
                colours.push(shown.name.to_owned());
            }
            let times = recording.measured_steps.iter().map(|&step| recording.end_of(step));
            let points = times.zip(shown.values).map(|(time, value)| [time, value]);
            lines.push(Line {
                colour,
                is_second: index == 1,
                points: points.filter(|point| point[1].is_finite()).collect(),
            });
        }
    }
    (lines, colours)
}

fn drawing(lines: &[Line], title: &str) -> Markup {
    let points = || lines.iter().flat_map(|line| &line.points);
    let range = |axis: usize| {
        let values = points().map(|point| point[axis]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        (low, if high > low { high } else { low + 1.0 })
    };
    let ((begin, end), (least, most)) = (range(0), range(1));
    let x = |time: f64| LEFT + (time - begin) / (end - begin) * (WIDTH - LEFT - 8.0);
    let y = |value: f64| HEIGHT - BOTTOM - (value - least) / (most - least) * (HEIGHT - BOTTOM - TOP);
    let path = |line: &Line| {
        let places = line
            .points
            .iter()
            .map(|&[time, value]| format!("{:.1},{:.1}", x(time), y(value)));
        format!("M{}", places.collect::<Vec<_>>().join("L"))
    };
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(title) {
            @for value in [least, 0.5 * (least + most), most] {
                line .rule x1=(LEFT) x2=(WIDTH - 8.0) y1=(y(value)) y2=(y(value)) {}
                text x=(LEFT - 8.0) y=(y(value) + 4.0) text-anchor="end" { (three_figures(value)) }
            }
            @for share in [0.0, 0.5, 1.0] {
                @let at = begin + share * (end - begin);
                text x=(x(at)) y=(HEIGHT - 6.0) text-anchor=(if share < 1.0 { "middle" } else { "end" }) { (moment(at)) }
            }
            @for line in lines.iter().filter(|line| line.points.len() > 1) {
                path .line d=(path(line)) stroke=(format!("var(--series-{})", line.colour)) stroke-dasharray=[line.is_second.then_some("5 4")] {}
            }
        }
    }
}
