//! Plots the simulation beside the laws that it must obey, and its errors.

use super::axis::{LinearAxis, LogAxis};
use super::look::{Look, MarkShape};
use super::picture::{Curve, Mark, Panel, Plot};
use super::svg::INK;
use crate::report::number::{magnitude, round_time, three_figures};
use crate::report::prior::{PriorRun, PriorRuns};
use crate::truths::{LawRuns, Measured, Sample};
use selvedge_cloth::Accuracy;

const SIZE: [f64; 2] = [330.0, 260.0];
/// The plot of all laws has as many names as laws.
const LARGE: [f64; 2] = [560.0, 860.0];
/// The colours of Okabe and Ito, without their yellow, which is too pale for a line.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6e3c"];

/// One line of a plot, and the name at its end.
struct NamedLine {
    name: Option<String>,
    colour: &'static str,
    points: Vec<[f64; 2]>,
    /// Whether the line is the law's, or another revision's.
    is_dashed: bool,
}

/// The lines of one panel, below its title.
type Titled = (String, Vec<NamedLine>);

/// Plots a law and its simulation on the finest mesh, at each time step.
#[must_use]
pub fn truth_svg(runs: &LawRuns) -> String {
    let finest = runs.by_mesh().next_back().unwrap_or_default();
    let points = |run: &Measured, value: fn(&Sample) -> f64| run.samples.iter().map(|own| [own.at, value(own)]).collect();
    let mut lines: Vec<NamedLine> = finest
        .iter()
        .zip(COLOURS)
        .map(|(run, colour)| NamedLine {
            name: Some(run.conditions.pace.to_string()),
            colour,
            points: points(run, |own| own.simulated),
            is_dashed: false,
        })
        .collect();
    lines.extend(finest.first().map(|run| NamedLine {
        name: Some("exact".to_owned()),
        colour: INK,
        points: points(run, |own| own.exact),
        is_dashed: true,
    }));
    let values = |axis: usize| lines.iter().flat_map(|line| &line.points).map(move |point| point[axis]);
    let axes = [LinearAxis::over(values(0), SIZE[0]), LinearAxis::over(values(1), SIZE[1])];
    let ticks = axes[0]
        .ticks()
        .into_iter()
        .map(|(place, value)| (place, Some(three_figures(value))))
        .collect();
    let rules = axes[1]
        .ticks()
        .into_iter()
        .map(|(place, value)| (SIZE[1] - place, three_figures(value)))
        .collect();
    let place = |[x, y]: [f64; 2]| [axes[0].place(x), SIZE[1] - axes[1].place(y)];
    let panels = [(String::new(), lines)];
    drawn("Simulation and law", runs.law.axes, SIZE, (ticks, rules), &panels, &place)
}

const COST: &str = "Error against processor time";
const COST_AXES: [&str; 2] = ["time of the run", "error"];

/// Plots the errors of all laws on their finest mesh against the time of a run: a line for each law, with a point for each pace
/// and accuracy.
#[must_use]
pub fn cost_of_accuracy_svg(all: &[LawRuns]) -> String {
    let line = |(runs, colour): (&LawRuns, &&'static str)| {
        let points = runs.by_mesh().next_back()?.iter().map(|run| [run.seconds, run.error()]);
        line(runs.law.name.replace('_', " "), colour, points, false)
    };
    let lines = all.iter().zip(COLOURS.iter().cycle()).filter_map(line).collect();
    errors_svg(COST, COST_AXES, LARGE, &[(String::new(), lines)])
}

/// Plots the errors of a law against the time of a run. A panel for each pace has a line for each accuracy, with a point for each
/// regular mesh. Another revision has dashed lines.
#[must_use]
pub fn cost_of_law_svg(runs: &LawRuns, prior: Option<&PriorRuns>) -> String {
    let paces = runs.by_accuracy().next().unwrap_or_default();
    let panels = paces.iter().enumerate().map(|(at, first)| {
        let pace = first.conditions.pace.to_string();
        let own = Accuracy::ALL.into_iter().zip(COLOURS).filter_map(|(accuracy, colour)| {
            let own = runs.by_accuracy().map(|own| &own[at]);
            let own = own.filter(|run| run.conditions.accuracy == accuracy && !run.conditions.grid.is_irregular);
            let points = own.map(|run| [run.seconds, run.error()]);
            line(accuracy.name().to_owned(), colour, points, false)
        });
        let mut lines: Vec<NamedLine> = own.collect();
        lines.extend(prior.into_iter().flat_map(|prior| lines_before(runs, prior, &pace)));
        (pace, lines)
    });
    errors_svg(COST, COST_AXES, SIZE, &panels.collect::<Vec<_>>())
}

/// Returns the dashed lines of another revision at one pace: one for each of its accuracies.
fn lines_before(runs: &LawRuns, prior: &PriorRuns, pace: &str) -> Vec<NamedLine> {
    let meshes = runs.law.meshes.iter().filter(|grid| !grid.is_irregular);
    let all: Vec<&PriorRun> = meshes
        .flat_map(|grid| prior.on(runs.law.name, grid.number, false))
        .filter(|run| run.pace == pace)
        .collect();
    let mut accuracies: Vec<&str> = all.iter().map(|run| run.accuracy.as_str()).collect();
    accuracies.sort_unstable();
    accuracies.dedup();
    let lines = accuracies
        .into_iter()
        .zip(COLOURS.into_iter().rev())
        .filter_map(|(accuracy, colour)| {
            let own = all.iter().filter(|run| run.accuracy == accuracy);
            line(
                format!("{accuracy}, before"),
                colour,
                own.map(|run| [run.seconds, run.error]),
                true,
            )
        });
    lines.collect()
}

/// Plots the errors of a law against the time from one state to the next, a line for each mesh and accuracy.
#[must_use]
pub fn convergence_svg(runs: &LawRuns) -> String {
    let line_of = |(own, colour): (&[Measured], &'static str)| {
        let conditions = own.first()?.conditions;
        let accuracy = conditions.accuracy.name();
        let name = format!("{} {}, {accuracy}", conditions.grid, runs.law.mesh);
        let points = own.iter().map(|run| [run.conditions.pace.seconds(), run.error()]);
        line(name, colour, points, false)
    };
    let lines = runs
        .by_accuracy()
        .zip(COLOURS.into_iter().cycle())
        .filter_map(line_of)
        .collect();
    let title = "Error against pace and mesh";
    errors_svg(title, ["time from state to state", "error"], SIZE, &[(String::new(), lines)])
}

/// Returns the line of the points that a plot of logarithms can show, if there are any.
fn line(name: String, colour: &'static str, points: impl Iterator<Item = [f64; 2]>, is_dashed: bool) -> Option<NamedLine> {
    let points: Vec<_> = points
        .filter(|point| point.iter().all(|value| *value > 0.0 && value.is_finite()))
        .collect();
    (!points.is_empty()).then_some(NamedLine {
        name: Some(name),
        colour,
        points,
        is_dashed,
    })
}

fn errors_svg(title: &str, axes: [&str; 2], size: [f64; 2], panels: &[Titled]) -> String {
    let lines = || panels.iter().flat_map(|(_, lines)| lines);
    let values = |axis: usize| lines().flat_map(|line| &line.points).map(move |point| point[axis]);
    let [across, upwards] = [0, 1].map(|axis| LogAxis::over(values(axis), size[axis]));
    let rules = upwards.ticks(magnitude).into_iter();
    let rules = rules.filter_map(|(place, name)| Some((size[1] - place, name?))).collect();
    let place = |[x, y]: [f64; 2]| [across.place(x), size[1] - upwards.place(y)];
    drawn(title, axes, size, (across.ticks(round_time), rules), panels, &place)
}

type Ticks = (Vec<(f64, Option<String>)>, Vec<(f64, String)>);

fn drawn(
    title: &str,
    [across, upwards]: [&str; 2],
    size: [f64; 2],
    (ticks, rules): Ticks,
    panels: &[Titled],
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
    let panels: Vec<Panel> = panels.iter().map(|(title, lines)| panel(title, lines, place)).collect();
    plot.draw(&panels)
}

fn panel(title: &str, lines: &[NamedLine], place: &dyn Fn([f64; 2]) -> [f64; 2]) -> Panel {
    let mut panel = Panel {
        title: title.to_owned(),
        ..Panel::default()
    };
    for line in lines {
        let points: Vec<_> = line.points.iter().copied().map(place).collect();
        let last = points.len().saturating_sub(1);
        let is_law = line.colour == INK;
        panel.marks.extend(points.iter().enumerate().map(|(index, &at)| Mark {
            look: Look::new(line.colour, if is_law { MarkShape::None } else { MarkShape::Disc }),
            at,
            name: line.name.clone().filter(|_| index == last),
        }));
        panel.curves.push(Curve {
            points,
            colour: line.colour,
            width: if is_law { 3.0 } else { 1.5 },
            is_dashed: line.is_dashed,
        });
    }
    if lines.is_empty() {
        panel.note = Some("no errors above zero to plot");
    }
    panel
}
