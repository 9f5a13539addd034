//! Cost against size, as a plot.

use super::number::{grouped, time};
use crate::pipeline::Stage;
use crate::study::ScalingPoint;
use plotters::prelude::*;
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const SIZE: (u32, u32) = (900, 560);
/// Room to the right of the axes for the names of the lines.
const LABEL_ROOM: u32 = 220;
/// Pixels from one name to the next, so that they never overlap.
const LABEL_SPACING: i32 = 19;
const BACKGROUND: RGBColor = RGBColor(253, 253, 252);
const INK: RGBColor = RGBColor(31, 35, 40);
const FAINT_INK: RGBColor = RGBColor(101, 109, 118);
const GRID: RGBColor = RGBColor(226, 230, 234);

/// Okabe and Ito's colours, which people who confuse colours tell apart; their yellow is too pale for a line.
const STAGE_COLOURS: [(Stage, RGBColor); 7] = [
    (Stage::BroadPhase, RGBColor(0, 114, 178)),
    (Stage::Distribution, RGBColor(230, 159, 0)),
    (Stage::Boxes, RGBColor(0, 158, 115)),
    (Stage::RelativeBoxes, RGBColor(86, 180, 233)),
    (Stage::Subspace, RGBColor(140, 110, 60)),
    (Stage::NonCoplanarity, RGBColor(204, 121, 167)),
    (Stage::Elementary, RGBColor(213, 94, 0)),
];

/// Time for a step against triangles, on logarithmic axes, as an SVG picture with its own light background.
///
/// The whole step by the clock on the wall, each stage (summed over threads), and what n log n would be from the first
/// point on. A time of zero has no place on a logarithmic axis and is left out; where nothing is left to plot, the
/// picture says so.
#[must_use]
pub fn scaling_svg(points: &[ScalingPoint]) -> String {
    let mut picture = String::new();
    let lines = lines(points);
    let root = SVGBackend::with_string(&mut picture, SIZE).into_drawing_area();
    draw(&root, &lines).expect("drawing into a string does not fail");
    drop(root);
    picture
}

/// One line of the plot, from few to many triangles.
struct Curve {
    name: String,
    colour: RGBColor,
    kind: Kind,
    points: Vec<(f64, f64)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Whole,
    Stage,
    Reference,
}

fn lines(points: &[ScalingPoint]) -> Vec<Curve> {
    let curve = |name: &str, colour, kind, seconds: &dyn Fn(&ScalingPoint) -> Option<f64>| {
        let mut points: Vec<(f64, f64)> = points
            .iter()
            .filter_map(|point| Some((point.triangles as f64, seconds(point)?)))
            .filter(|&(triangles, seconds)| triangles > 0.0 && seconds > 0.0 && seconds.is_finite())
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let name = name.to_owned();
        Curve {
            name,
            colour,
            kind,
            points,
        }
    };
    let whole = curve("whole step", INK, Kind::Whole, &|point| Some(point.step.seconds));
    let mut lines = vec![reference(&whole.points)];
    for (stage, colour) in STAGE_COLOURS {
        let seconds = |point: &ScalingPoint| match stage {
            Stage::BroadPhase => Some(point.step.broad_phase_seconds),
            _ => {
                let mut stages = point.step.stages.iter();
                Some(stages.find(|report| report.stage == stage)?.seconds)
            }
        };
        lines.push(curve(stage.name(), colour, Kind::Stage, &seconds));
    }
    lines.push(whole);
    lines.retain(|line| !line.points.is_empty());
    lines
}

/// n log n through the first point. Through one triangle it would be zero everywhere, so it begins at the first size above.
fn reference(whole: &[(f64, f64)]) -> Curve {
    let whole: Vec<_> = whole.iter().filter(|point| point.0 > 1.0).collect();
    let n_log_n = |n: f64| n * n.ln();
    let points = match whole[..] {
        [&(first, seconds), .., _] => {
            let scaled = |n: f64| (n, seconds * (n_log_n(n) / n_log_n(first)));
            whole.iter().map(|point| scaled(point.0)).collect()
        }
        _ => Vec::new(),
    };
    Curve {
        name: "n log n".to_owned(),
        colour: FAINT_INK,
        kind: Kind::Reference,
        points,
    }
}

type Drawing<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type DrawResult = Result<(), Box<dyn std::error::Error>>;

fn draw(root: &Drawing<'_>, lines: &[Curve]) -> DrawResult {
    root.fill(&BACKGROUND)?;
    let title = ("sans-serif", 24).into_font().color(&INK);
    root.draw_text("Time for one step against size", &title, (24, 16))?;
    let subtitle = ("sans-serif", 17).into_font().color(&FAINT_INK);
    let explanation = "stages: summed over threads; n log n: through the first whole step; beside the names: the last times";
    root.draw_text(explanation, &subtitle, (24, 46))?;
    let Some([sizes, times]) = ranges(lines) else {
        let note = ("sans-serif", 20).into_font().color(&FAINT_INK);
        root.draw_text("no times above zero to plot", &note, (24, 90))?;
        return root.present().map_err(Into::into);
    };
    let mut chart = ChartBuilder::on(root)
        .margin_top(76)
        .margin_left(12)
        .margin_bottom(12)
        .margin_right(LABEL_ROOM)
        .x_label_area_size(56)
        .y_label_area_size(84)
        .build_cartesian_2d((sizes.0..sizes.1).log_scale(), (times.0..times.1).log_scale())?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(BACKGROUND)
        .axis_style(FAINT_INK)
        .max_light_lines(0)
        .x_desc("triangles")
        .y_desc("time for a step")
        .axis_desc_style(("sans-serif", 19).into_font().color(&INK))
        .label_style(("sans-serif", 17).into_font().color(&INK))
        .x_label_formatter(&|&n| grouped(n.round() as u64))
        .y_label_formatter(&|&seconds| power_of_ten_time(seconds))
        .draw()?;
    for line in lines {
        let points = line.points.iter().copied();
        match line.kind {
            Kind::Reference => {
                let style = line.colour.stroke_width(2);
                chart.draw_series(DashedLineSeries::new(points, 8, 6, style))?;
            }
            Kind::Stage | Kind::Whole => {
                let bold = line.kind == Kind::Whole;
                let style = line.colour.stroke_width(if bold { 4 } else { 2 });
                chart.draw_series(LineSeries::new(points.clone(), style))?;
                let radius = if bold { 5 } else { 4 };
                chart.draw_series(points.map(|point| Circle::new(point, radius, line.colour.filled())))?;
            }
        }
    }
    let plotting_area = chart.plotting_area();
    let labels = lines.iter().filter_map(|line| {
        let &last = line.points.last()?;
        let label = format!("{}: {}", line.name, time(last.1));
        Some((plotting_area.map_coordinate(&last), label, line))
    });
    draw_labels(root, labels.collect())?;
    root.present().map_err(Into::into)
}

/// Writes each line's name to the right of its last point, and moves names apart that would overlap.
fn draw_labels(root: &Drawing<'_>, mut labels: Vec<((i32, i32), String, &Curve)>) -> DrawResult {
    labels.sort_by_key(|&((_, y), _, _)| y);
    let wanted: Vec<i32> = labels.iter().map(|&((_, y), _, _)| y).collect();
    let lowest = SIZE.1 as i32 - 70;
    let x = (SIZE.0 - LABEL_ROOM) as i32 + 14;
    for (y, (point, label, line)) in spread(&wanted, LABEL_SPACING, lowest).into_iter().zip(labels) {
        root.draw(&PathElement::new(
            vec![(point.0 + 6, point.1), (x - 3, y)],
            line.colour.mix(0.6),
        ))?;
        let style = ("sans-serif", 17).into_font();
        let style = if line.kind == Kind::Whole {
            style.style(FontStyle::Bold)
        } else {
            style
        };
        let style = style.color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
        root.draw(&Circle::new((x + 4, y), 5, line.colour.filled()))?;
        root.draw(&Text::new(label, (x + 14, y), style))?;
    }
    Ok(())
}

/// Positions in ascending order, at least `spacing` apart, near the wanted ones (also ascending), the last not beyond `end`.
pub(super) fn spread(wanted: &[i32], spacing: i32, end: i32) -> Vec<i32> {
    let mut places: Vec<i32> = Vec::with_capacity(wanted.len());
    for &place in wanted {
        places.push(places.last().map_or(place, |last| place.max(last + spacing)));
    }
    let mut limit = end;
    for place in places.iter_mut().rev() {
        *place = (*place).min(limit);
        limit = *place - spacing;
    }
    places
}

/// The smallest and largest of each axis, with a little room; nothing if there is no point.
fn ranges(lines: &[Curve]) -> Option<[(f64, f64); 2]> {
    let points = || lines.iter().flat_map(|line| &line.points);
    points().next()?;
    let range = |coordinate: fn(&(f64, f64)) -> f64, room: f64| {
        let ends = points().map(coordinate).fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        (ends.0 / room, ends.1 * room)
    };
    Some([range(|point| point.0, 1.4), range(|point| point.1, 1.6)])
}

/// `1 µs`, `10 ms`: the times at an axis of powers of ten.
fn power_of_ten_time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s >= 0.9995 => (s, "s"),
        s if s >= 0.9995e-3 => (s * 1e3, "ms"),
        s if s >= 0.9995e-6 => (s * 1e6, "µs"),
        s => (s * 1e9, "ns"),
    };
    let rounded = (value * 1000.0).round() / 1000.0;
    format!("{rounded} {unit}")
}

#[cfg(test)]
mod tests {
    use super::super::svg_texts::texts;
    use super::*;
    use crate::pipeline::{StageReport, StepReport};
    use proptest::prelude::*;
    use roxmltree::Document;
    use selvedge::verification::PairCounts;

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

    #[test]
    fn names_keep_their_order_and_distance() {
        assert_eq!(spread(&[10, 12, 80], 19, 400), [10, 29, 80]);
        assert_eq!(spread(&[390, 395, 398], 19, 400), [362, 381, 400]);
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
