//! Cost against size.

use super::axis::LogAxis;
use super::look::{Look, Shape};
use super::picture::{Curve, FAINT_INK, INK, Mark, Panel, Plot};
use crate::methods::Stage;
use crate::report::number::{figures, grouped, round_time, time};
use crate::study::ScalingPoint;

const SIZE: [f64; 2] = [600.0, 400.0];

/// Okabe and Ito's colours; their yellow is too pale for a line.
const STAGE_COLOURS: [(Stage, &str); 7] = [
    (Stage::BroadPhase, "#0072b2"),
    (Stage::Distribution, "#e69f00"),
    (Stage::Boxes, "#009e73"),
    (Stage::RelativeBoxes, "#56b4e9"),
    (Stage::Subspace, "#8c6e3c"),
    (Stage::NonCoplanarity, "#cc79a7"),
    (Stage::Elementary, "#d55e00"),
];

/// Time for a step against triangles, on logarithmic axes, as an SVG picture with its own light background.
///
/// The whole step by the clock on the wall, each stage (summed over threads), and what n log n would be from the first
/// point on. A time of zero has no place on a logarithmic axis and is left out; where nothing is left to plot, the
/// picture says so.
#[must_use]
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
                figures(triangles)
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
        let look = Look::new(line.colour, if line.is_reference { Shape::None } else { Shape::Disc });
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

/// One line of the plot.
struct Line {
    name: &'static str,
    colour: &'static str,
    is_reference: bool,
    /// Triangles, ascending, and seconds.
    points: Vec<(f64, f64)>,
}

fn lines(points: &[ScalingPoint]) -> Vec<Line> {
    let line = |name, colour, seconds: &dyn Fn(&ScalingPoint) -> Option<f64>| {
        let points = points
            .iter()
            .filter_map(|point| Some((point.triangles as f64, seconds(point)?)));
        let is_plotted = |&(triangles, seconds): &(f64, f64)| triangles > 0.0 && seconds > 0.0 && seconds.is_finite();
        let mut points: Vec<_> = points.filter(is_plotted).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Line {
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

/// n log n through the first point. Through one triangle it would be zero everywhere, so it begins at the first size above.
fn reference(whole: &[(f64, f64)]) -> Line {
    let whole: Vec<_> = whole.iter().filter(|point| point.0 > 1.0).collect();
    let n_log_n = |n: f64| n * n.ln();
    let points = match whole[..] {
        [&(first, seconds), .., _] => {
            let scaled = |n: f64| (n, seconds * (n_log_n(n) / n_log_n(first)));
            whole.iter().map(|point| scaled(point.0)).collect()
        }
        _ => Vec::new(),
    };
    Line {
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
    use proptest::prelude::*;
    use roxmltree::Document;
    use selvedge::PairCounts;

    fn point(triangles: usize, stages: &[(Stage, f64)]) -> ScalingPoint {
        let seconds = |wanted| {
            stages
                .iter()
                .find(|&&(stage, _)| stage == wanted)
                .map_or(0.0, |&(_, seconds)| seconds)
        };
        let later = stages.iter().filter(|&&(stage, _)| stage != Stage::BroadPhase);
        ScalingPoint {
            triangles,
            setup_seconds: 0.0,
            first_step_seconds: 0.0,
            step: StepReport {
                triangle_pairs: 0,
                broad_phase_pairs: None,
                broad_phase_seconds: seconds(Stage::BroadPhase),
                stages: later
                    .map(|&(stage, seconds)| StageReport {
                        stage,
                        survivors: PairCounts::default(),
                        seconds,
                    })
                    .collect(),
                seconds: stages.iter().map(|&(_, seconds)| seconds).sum(),
            },
        }
    }

    fn has(svg: &str, wanted: &str) -> bool {
        texts(svg).iter().any(|text| text == wanted)
    }

    #[test]
    fn each_stage_is_named_with_its_last_time() {
        let svg = scaling_svg(&[
            point(13_450, &[(Stage::BroadPhase, 0.004), (Stage::Boxes, 0.03)]),
            point(1345, &[(Stage::BroadPhase, 0.001), (Stage::Boxes, 0.002)]),
        ]);
        for label in ["whole step: 34.0 ms", "broad-phase: 4.00 ms", "boxes: 30.0 ms", "triangles"] {
            assert!(has(&svg, label), "{label}: {:?}", texts(&svg));
        }
        assert!(!svg.contains("subspace"));
    }

    #[test]
    fn the_reference_is_n_log_n_through_the_first_whole_step() {
        let seconds = |n: f64| 1e-6 * n;
        let svg = scaling_svg(&[10_usize, 100, 10_000].map(|n| point(n, &[(Stage::Boxes, seconds(n as f64))])));
        // 10 µs × (10,000 ln 10,000) / (10 ln 10).
        assert!(has(&svg, "n log n: 40.0 ms"), "{:?}", texts(&svg));
    }

    #[test]
    fn times_of_zero_are_left_out() {
        let svg = scaling_svg(&[10, 100].map(|n| point(n, &[(Stage::Boxes, 0.0), (Stage::Elementary, 0.5)])));
        assert!(has(&svg, "elementary: 500 ms"));
        assert!(!texts(&svg).iter().any(|text| text.starts_with("boxes")));
    }

    #[test]
    fn a_plot_of_nothing_says_so() {
        for points in [
            vec![],
            vec![point(10, &[(Stage::Boxes, 0.0)])],
            vec![point(0, &[(Stage::Boxes, 1.0)])],
        ] {
            assert!(has(&scaling_svg(&points), "no times above zero to plot"));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn any_finite_times_give_a_picture(
            points in prop::collection::vec((0..=u32::MAX as usize, 0.0..1e9, proptest::num::f64::POSITIVE | proptest::num::f64::ZERO), 0..5)
        ) {
            let points: Vec<_> = points.into_iter().map(|(n, a, b)| point(n, &[(Stage::BroadPhase, a), (Stage::Boxes, b)])).collect();
            let svg = scaling_svg(&points);
            prop_assert!(Document::parse(&svg).is_ok());
            prop_assert_eq!(svg, scaling_svg(&points));
        }
    }
}
