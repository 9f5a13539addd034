//! Plots cost against size.

use super::axis::LogAxis;
use super::look::{Look, MarkShape};
use super::picture::{Curve, Mark, Panel, Plot};
use super::svg::{FAINT_INK, INK};
use crate::methods::Stage;
use crate::report::number::{grouped, round_time, three_figures, time};
use crate::study::ScalingPoint;

const SIZE: [f64; 2] = [600.0, 400.0];

/// The colours of Okabe and Ito, without their yellow, which is too pale for a line.
const STAGE_COLOURS: [(Stage, &str); 7] = [
    (Stage::BroadPhase, "#0072b2"),
    (Stage::Distribution, "#e69f00"),
    (Stage::Boxes, "#009e73"),
    (Stage::RelativeBoxes, "#56b4e9"),
    (Stage::Subspace, "#8c6e3c"),
    (Stage::NonCoplanarity, "#cc79a7"),
    (Stage::Elementary, "#d55e00"),
];

/// Plots the time of a step against the number of triangles, on logarithmic axes, as an SVG picture with its own light
/// background.
///
/// Lines show the whole step by the wall clock, each stage summed over threads, and n log n through the first point. Times of
/// zero are left out, because a logarithmic axis has no place for them. If nothing remains, the picture says so.
pub fn scaling_svg(points: &[ScalingPoint]) -> String {
    let lines = lines(points);
    let values = |coordinate: fn(&(f64, f64)) -> f64| lines.iter().flat_map(|line| &line.points).map(coordinate);
    let sizes = LogAxis::over(values(|point| point.0), SIZE[0]);
    let times = LogAxis::over(values(|point| point.1), SIZE[1]);
    let places_of_times = times.ticks(round_time).into_iter();
    let plot = Plot {
        title: "Time for one step against size",
        explanation: "",
        legend: &[],
        size: SIZE,
        ticks: sizes.ticks(|triangles| {
            if triangles < 1e7 {
                grouped(triangles as usize)
            } else {
                three_figures(triangles)
            }
        }),
        across: "triangles",
        upwards: "time for a step",
        lines: places_of_times
            .filter_map(|(place, name)| Some((SIZE[1] - place, name?)))
            .collect(),
        strip_rows: 0,
    };
    let mut panel = Panel {
        title: "The whole step, and its stages summed over threads".to_owned(),
        subtitle: "n log n: through the first whole step; beside the names: the last times".to_owned(),
        ..Panel::default()
    };
    if lines.is_empty() {
        panel.note = Some("no times above zero to plot");
    }
    for line in &lines {
        let points: Vec<_> = { line.points.iter() }
            .map(|&(triangles, seconds)| [sizes.place(triangles), SIZE[1] - times.place(seconds)])
            .collect();
        let look = Look::new(line.colour, if line.is_reference { MarkShape::None } else { MarkShape::Disc });
        let name = |index: usize| (index + 1 == points.len()).then(|| format!("{}: {}", line.name, time(line.points[index].1)));
        let marks = points.iter().enumerate().map(|(index, &at)| Mark {
            look,
            at,
            name: name(index),
        });
        panel.marks.extend(marks);
        panel.curves.push(Curve {
            width: if line.colour == INK { 4.0 } else { 2.0 },
            is_dashed: line.is_reference,
            colour: line.colour,
            points,
        });
    }
    plot.draw(&[panel])
}

struct CostLine {
    name: &'static str,
    colour: &'static str,
    is_reference: bool,
    /// The triangles, ascending, and the seconds.
    points: Vec<(f64, f64)>,
}

fn lines(points: &[ScalingPoint]) -> Vec<CostLine> {
    let line = |name, colour, seconds: &dyn Fn(&ScalingPoint) -> Option<f64>| {
        let points = points
            .iter()
            .filter_map(|point| Some((point.triangles as f64, seconds(point)?)));
        let is_plotted = |&(triangles, seconds): &(f64, f64)| triangles > 0.0 && seconds > 0.0 && seconds.is_finite();
        let mut points: Vec<_> = points.filter(is_plotted).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        CostLine {
            name,
            colour,
            is_reference: false,
            points,
        }
    };
    let whole = line("whole step", INK, &|point| Some(point.step.seconds));
    let mut lines = vec![reference(&whole.points)];
    lines.extend(STAGE_COLOURS.map(|(stage, colour)| {
        line(stage.name(), colour, &|point| match stage {
            Stage::BroadPhase => Some(point.step.broad_phase_seconds),
            _ => {
                let mut stages = point.step.stages.iter();
                Some(stages.find(|report| report.stage == stage)?.seconds)
            }
        })
    }));
    lines.push(whole);
    lines.retain(|line| !line.points.is_empty());
    lines
}

/// Returns n log n through the first point with more than one triangle, since it is zero for one.
fn reference(whole: &[(f64, f64)]) -> CostLine {
    let whole: Vec<_> = whole.iter().filter(|point| point.0 > 1.0).collect();
    let n_log_n = |n: f64| n * n.ln();
    let points = match whole[..] {
        [&(first, seconds), .., _] => {
            let scaled = |n: f64| (n, seconds * (n_log_n(n) / n_log_n(first)));
            whole.iter().map(|point| scaled(point.0)).collect()
        }
        _ => Vec::new(),
    };
    CostLine {
        name: "n log n",
        colour: FAINT_INK,
        is_reference: true,
        points,
    }
}

#[cfg(test)]
mod tests {
    use super::super::texts::texts;
    use super::*;
    use crate::pipeline::{StageReport, StepReport};

    /// Returns a point with the seconds of the broad phase, and of the boxes.
    fn point(triangles: usize, [broad_phase, boxes]: [f64; 2]) -> ScalingPoint {
        let stage = StageReport {
            stage: Stage::Boxes,
            survivors: Default::default(),
            seconds: boxes,
        };
        ScalingPoint {
            triangles,
            setup_seconds: 0.0,
            first_step_seconds: 0.0,
            step: StepReport {
                broad_phase_seconds: broad_phase,
                stages: [stage].into_iter().collect(),
                seconds: broad_phase + boxes,
                ..StepReport::default()
            },
        }
    }

    #[test]
    fn each_line_is_named_with_its_last_time_and_times_of_zero_are_left_out() {
        // 10 µs × (10,000 ln 10,000) / (10 ln 10) is 40 ms.
        let points = [10_usize, 100, 10_000].map(|n| point(n, [0.0, 1e-6 * n as f64]));
        let texts = texts(&scaling_svg(&points));
        for label in ["whole step: 10.0 ms", "boxes: 10.0 ms", "n log n: 40.0 ms", "triangles"] {
            assert!(texts.iter().any(|text| text == label), "{label}: {texts:?}");
        }
        assert!(!texts.iter().any(|text| text.starts_with("broad-phase")));
    }

    #[test]
    fn a_plot_of_nothing_says_so() {
        for points in [vec![], vec![point(10, [0.0; 2])], vec![point(0, [0.0, 1.0])]] {
            let texts = texts(&scaling_svg(&points));
            assert!(texts.iter().any(|text| text == "no times above zero to plot"));
        }
    }
}
