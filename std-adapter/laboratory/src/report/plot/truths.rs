//! Plots the simulation beside the laws that it must obey, and its errors.

use super::axis::{LinearAxis, LogAxis};
use super::look::{Look, Shape};
use super::picture::{Curve, Mark, Panel, Plot};
use super::svg::INK;
use crate::report::number::{few, magnitude, round_time, time};
use crate::truths::{LawRuns, Measured, Sample};

const SIZE: [f64; 2] = [330.0, 260.0];
/// The plot of all laws has as many names as laws.
const LARGE: [f64; 2] = [560.0, 420.0];
/// The colours of Okabe and Ito, without their yellow, which is too pale for a line.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6e3c"];

/// One line of a plot, and the name at its end.
struct Line {
    name: Option<String>,
    colour: &'static str,
    points: Vec<[f64; 2]>,
}

/// Plots a law and its simulation on the finest mesh, at each time step.
#[must_use]
pub fn truth_svg(runs: &LawRuns) -> String {
    let finest = runs.by_mesh().next_back().unwrap_or_default();
    let points = |run: &Measured, value: fn(&Sample) -> f64| run.samples.iter().map(|own| [own.at, value(own)]).collect();
    let mut lines: Vec<Line> = finest
        .iter()
        .zip(COLOURS)
        .map(|(run, colour)| Line {
            name: Some(time(run.step)),
            colour,
            points: points(run, |own| own.simulated),
        })
        .collect();
    lines.extend(finest.first().map(|run| Line {
        name: Some("exact".to_owned()),
        colour: INK,
        points: points(run, |own| own.exact),
    }));
    let values = |axis: usize| lines.iter().flat_map(|line| &line.points).map(move |point| point[axis]);
    let axes = [LinearAxis::over(values(0), SIZE[0]), LinearAxis::over(values(1), SIZE[1])];
    let ticks = axes[0]
        .ticks()
        .into_iter()
        .map(|(place, value)| (place, Some(few(value))))
        .collect();
    let rules = axes[1]
        .ticks()
        .into_iter()
        .map(|(place, value)| (SIZE[1] - place, few(value)))
        .collect();
    let place = |[x, y]: [f64; 2]| [axes[0].place(x), SIZE[1] - axes[1].place(y)];
    drawn("Simulation and law", runs.law.axes, SIZE, (ticks, rules), &lines, &place)
}

/// Plots the errors of a law against the time step, a line for each mesh.
#[must_use]
pub fn convergence_svg(runs: &LawRuns) -> String {
    let title = "Error against time step and mesh";
    errors_svg(title, ["time step", "error"], SIZE, &by_mesh(runs, |run| run.step))
}

/// Plots the errors of laws against the time of a run, a line for each law on its finest mesh, at each time step. If there is one
/// law, it has a line for each mesh.
#[must_use]
pub fn cost_of_accuracy_svg(all: &[LawRuns]) -> String {
    let (size, lines) = match all {
        [one] => (SIZE, by_mesh(one, |run| run.seconds)),
        _ => {
            let line = |(runs, colour): (&LawRuns, &&'static str)| {
                line(runs.law.name.replace('_', " "), colour, runs.by_mesh().next_back()?, |run| {
                    run.seconds
                })
            };
            (LARGE, all.iter().zip(COLOURS.iter().cycle()).filter_map(line).collect())
        }
    };
    errors_svg("Error against processor time", ["time of the run", "error"], size, &lines)
}

fn by_mesh(runs: &LawRuns, at: fn(&Measured) -> f64) -> Vec<Line> {
    let own = runs.by_mesh().zip(COLOURS);
    own.filter_map(|(runs_on, colour)| line(format!("{} {}", runs_on.first()?.mesh, runs.law.mesh), colour, runs_on, at))
        .collect()
}

/// Returns the errors of runs that are not zero, if there are any.
fn line(name: String, colour: &'static str, runs: &[Measured], at: fn(&Measured) -> f64) -> Option<Line> {
    let points = runs.iter().map(|run| [at(run), run.error()]);
    let points: Vec<_> = points
        .filter(|point| point.iter().all(|value| *value > 0.0 && value.is_finite()))
        .collect();
    (!points.is_empty()).then_some(Line {
        name: Some(name),
        colour,
        points,
    })
}

fn errors_svg(title: &str, axes: [&str; 2], size: [f64; 2], lines: &[Line]) -> String {
    let values = |axis: usize| lines.iter().flat_map(|line| &line.points).map(move |point| point[axis]);
    let [across, upwards] = [0, 1].map(|axis| LogAxis::over(values(axis), size[axis]));
    let rules = upwards.ticks(magnitude).into_iter();
    let rules = rules.filter_map(|(place, name)| Some((size[1] - place, name?))).collect();
    let place = |[x, y]: [f64; 2]| [across.place(x), size[1] - upwards.place(y)];
    drawn(title, axes, size, (across.ticks(round_time), rules), lines, &place)
}

type Ticks = (Vec<(f64, Option<String>)>, Vec<(f64, String)>);

fn drawn(
    title: &str,
    [across, upwards]: [&str; 2],
    size: [f64; 2],
    (ticks, rules): Ticks,
    lines: &[Line],
    place: &dyn Fn([f64; 2]) -> [f64; 2],
) -> String {
    let plot = Plot {
        title,
        explanation: "",
        legend: &[],
        size,
        ticks,
        across,
        upwards,
        lines: rules,
        strip_rows: 0,
    };
    let mut panel = Panel::default();
    for line in lines {
        let points: Vec<_> = line.points.iter().copied().map(place).collect();
        let last = points.len().saturating_sub(1);
        let is_law = line.colour == INK;
        panel.marks.extend(points.iter().enumerate().map(|(index, &at)| Mark {
            look: Look::new(line.colour, if is_law { Shape::None } else { Shape::Disc }),
            at,
            name: line.name.clone().filter(|_| index == last),
        }));
        panel.curves.push(Curve {
            points,
            colour: line.colour,
            width: if is_law { 3.0 } else { 1.5 },
            is_dashed: is_law,
        });
    }
    if lines.is_empty() {
        panel.note = Some("no errors above zero to plot");
    }
    plot.draw(&[panel])
}
