//! The elementary tests: error of the time of impact against time per pair.

use super::axes::TimeAxis;
use super::marks::Kind;
use super::{COLUMN_GAP, COLUMNS, FONT_SIZE, MARGIN, TITLE_SIZE, text};
use crate::report::number::{grouped, time};
use crate::report::plot::spread;
use crate::report::table_svg::{FAINT_INK, FONT, INK, PAPER_WHITE, RULE, prose_width};
use crate::study::elementary::{
    ElementaryAccuracy, ElementaryMethod, ElementaryRow, ElementarySet,
};
use svg::node::element::{Group, Line, Polyline, Rectangle};
use svg::{Document, Node};

const WIDTH: f64 = 700.0;
const PLOT_WIDTH: f64 = 300.0;
const LEFT: f64 = 72.0;
const TOP: f64 = 74.0;
/// Between two powers of ten.
const STEP: f64 = 18.0;
/// Errors are drawn as if none were smaller.
const SMALLEST_POWER: i32 = -16;
/// Above the smallest error a line for none.
const PLOT_HEIGHT: f64 = STEP * (1 - SMALLEST_POWER) as f64;
const LABEL_X: f64 = LEFT + PLOT_WIDTH + 24.0;
const LABEL_SPACING: f64 = 16.0;
const SMALL: f64 = 12.0;
const STRIP_GAP: f64 = 12.0;
const STRIP_HEIGHT: f64 = 4.0 * 18.0 + 8.0;
const STRIP: &str = "#fbe9de";
const HEIGHT: f64 = TOP + PLOT_HEIGHT + STRIP_GAP + STRIP_HEIGHT + 34.0;
const ROW_GAP: f64 = 26.0;
const HEAD_HEIGHT: f64 = 130.0;

const KINDS: [(Kind, &str); 4] = [
    (Kind::Certified, "certified, each at its tolerance δ"),
    (Kind::Exact, "exact verdict"),
    (Kind::Subdivided, "Tight-Inclusion, re-implemented, at δ"),
    (Kind::Uncertified, "unsafe: misses contacts, or is too late"),
];

fn kind(method: ElementaryMethod) -> Kind {
    match method {
        ElementaryMethod::Certified(_) => Kind::Certified,
        ElementaryMethod::Exact => Kind::Exact,
        ElementaryMethod::TightInclusion(_) => Kind::Subdivided,
        _ => Kind::Uncertified,
    }
}

/// Accuracy of the time of impact against time, as an SVG picture with its own light background: a panel for each set of pairs and
/// format.
///
/// To the right, time per pair (logarithmic, the same in all panels). Up, how much too early a contact is found, the median, ten times
/// less from line to line. Tests that may miss contacts, or find them too late, have no place on that axis; they stand in a
/// strip of their own, with what they got wrong.
#[must_use]
pub fn elementary_svg(accuracy: &ElementaryAccuracy) -> String {
    let times = accuracy.sets.iter().flat_map(|set| &set.rows);
    let axis = TimeAxis::over(times.map(|row| row.nanoseconds), PLOT_WIDTH);
    let width = 2.0 * MARGIN + COLUMNS as f64 * WIDTH + COLUMN_GAP;
    let rows = accuracy.sets.len().div_ceil(COLUMNS) as f64;
    let height = HEAD_HEIGHT + rows * (HEIGHT + ROW_GAP);
    let mut picture = Group::new()
        .set("font-family", FONT)
        .set("font-size", FONT_SIZE)
        .set("fill", INK);
    draw_head(&mut picture);
    for (index, set) in accuracy.sets.iter().enumerate() {
        let (row, column) = ((index / COLUMNS) as f64, (index % COLUMNS) as f64);
        let x = MARGIN + column * (WIDTH + COLUMN_GAP);
        let y = HEAD_HEIGHT + row * (HEIGHT + ROW_GAP);
        let mut group = Group::new().set("transform", format!("translate({x} {y})"));
        draw_set(&mut group, set, &axis);
        picture.append(group);
    }
    let background = Rectangle::new()
        .set("width", "100%")
        .set("height", "100%")
        .set("fill", PAPER_WHITE);
    Document::new()
        .set("viewBox", (0, 0, width, height))
        .set("width", width)
        .set("height", height)
        .set("role", "img")
        .add(background)
        .add(picture)
        .to_string()
}

fn draw_head(picture: &mut Group) {
    let title = text(
        MARGIN,
        36.0,
        "What an accurate time of impact costs in time",
    )
    .set("font-size", TITLE_SIZE)
    .set("font-weight", "bold");
    picture.append(title);
    let explanation = "Up: contacts are found nearer to their exact time. Left: faster. One pair at a time, on one thread. \
                       False: pairs that never touch, but are not called free.";
    picture.append(text(MARGIN, 62.0, explanation).set("fill", FAINT_INK));
    let mut x = MARGIN + 6.0;
    for (kind, legend) in KINDS {
        let y = 94.0;
        kind.draw(picture, x, y - 5.0);
        picture.append(text(x + 12.0, y, legend));
        x += 12.0 + prose_width(legend, FONT_SIZE) + 26.0;
    }
}

struct Mark<'a> {
    row: &'a ElementaryRow,
    x: f64,
    y: f64,
    label: String,
}

fn draw_set(group: &mut Group, set: &ElementarySet, axis: &TimeAxis) {
    let title = format!("{}, {}", set.name, set.scalar);
    group.append(text(0.0, 16.0, &title).set("font-weight", "bold"));
    let pairs = format!(
        "{} pairs, of which {} touch",
        grouped((set.vertex_face + set.edge_edge) as u64),
        grouped(set.touching as u64),
    );
    group.append(
        text(0.0, 35.0, &pairs)
            .set("font-size", SMALL)
            .set("fill", FAINT_INK),
    );
    let title = text(0.0, TOP - 16.0, "too early by, in steps (median)");
    group.append(title.set("font-size", SMALL).set("fill", FAINT_INK));
    draw_axes(group, axis);
    let proven = set.rows.iter().filter(|row| row.method.is_certified());
    let count = set.vertex_face + set.edge_edge;
    let marks: Vec<_> = proven.filter_map(|row| mark(row, count, axis)).collect();
    for kind_of_line in [Kind::Certified, Kind::Subdivided] {
        let of_kind = marks
            .iter()
            .filter(|mark| kind(mark.row.method) == kind_of_line);
        let points: Vec<_> = of_kind
            .map(|mark| format!("{:.2},{:.2}", mark.x, mark.y))
            .collect();
        let line = Polyline::new()
            .set("points", points.join(" "))
            .set("fill", "none")
            .set("stroke", kind_of_line.colour())
            .set("stroke-width", 1.5);
        group.append(line);
    }
    draw_marks(group, &marks);
    draw_unsafe(group, set, axis);
}

/// Nothing for a test that was not asked about a contact of known time.
fn mark<'a>(row: &'a ElementaryRow, pairs: usize, axis: &TimeAxis) -> Option<Mark<'a>> {
    let name = match row.method {
        ElementaryMethod::Certified(tolerance) => format!("certified {tolerance:e}"),
        ElementaryMethod::TightInclusion(tolerance) => format!("Tight-Inclusion {tolerance:e}"),
        _ => "exact".to_owned(),
    };
    let alarms = match row.false_alarms {
        0 => String::new(),
        some => format!(", {} false", grouped(some as u64)),
    };
    let part = if row.asked < pairs {
        format!(" ({} pairs)", grouped(row.asked as u64))
    } else {
        String::new()
    };
    Some(Mark {
        row,
        x: LEFT + axis.place(row.nanoseconds),
        y: TOP + height_of(row.early?),
        label: format!("{name}{part}: {}{alarms}", time(row.nanoseconds * 1e-9)),
    })
}

/// From the top down.
fn height_of(error: f64) -> f64 {
    if error > 0.0 {
        let power = error.log10().max(f64::from(SMALLEST_POWER)).min(0.0);
        STEP * (power - f64::from(SMALLEST_POWER) + 1.0)
    } else {
        0.0
    }
}

fn draw_marks(group: &mut Group, marks: &[Mark<'_>]) {
    let mut order: Vec<&Mark<'_>> = marks.iter().collect();
    order.sort_by(|a, b| a.y.total_cmp(&b.y).then(b.x.total_cmp(&a.x)));
    let wanted: Vec<i32> = order.iter().map(|mark| mark.y as i32).collect();
    let lowest = (TOP + PLOT_HEIGHT) as i32;
    let places = spread(&wanted, LABEL_SPACING as i32, lowest);
    for (mark, place) in order.iter().zip(&places) {
        let leader = line(mark.x, mark.y, LABEL_X - 5.0, f64::from(*place))
            .set("stroke", kind(mark.row.method).colour())
            .set("stroke-opacity", 0.35);
        group.append(leader);
    }
    for (mark, place) in order.iter().zip(places) {
        kind(mark.row.method).draw(group, mark.x, mark.y);
        let label = text(LABEL_X, f64::from(place) + 4.5, &mark.label);
        group.append(label.set("font-size", SMALL).set("fill", INK));
    }
}

/// A line for each kind of test, with all its tolerances.
fn draw_unsafe(group: &mut Group, set: &ElementarySet, axis: &TimeAxis) {
    for (index, (name, label)) in [
        ("without_bounds", "without bounds"),
        ("additive", "additive"),
        ("bernstein_sign", "Bernstein sign"),
        ("cubic", "cubic"),
    ]
    .into_iter()
    .enumerate()
    {
        let is_of_kind = |row: &&ElementaryRow| row.method.name() == name && row.asked > 0;
        let rows = || set.rows.iter().filter(is_of_kind);
        let y = strip_top() + 4.0 + (index as f64 + 0.5) * 18.0;
        for row in rows() {
            Kind::Uncertified.draw(group, LEFT + axis.place(row.nanoseconds), y);
        }
        let range = |count: fn(&ElementaryRow) -> usize| {
            let least = rows().map(count).min().unwrap_or_default();
            let most = rows().map(count).max().unwrap_or_default();
            if least == most {
                grouped(most as u64)
            } else {
                format!("{}–{}", grouped(least as u64), grouped(most as u64))
            }
        };
        let content = format!(
            "{label}: {} missed, {} late, {} false",
            range(|row| row.missed),
            range(|row| row.late),
            range(|row| row.false_alarms),
        );
        group.append(text(LABEL_X, y + 4.5, &content).set("font-size", SMALL));
    }
}

fn strip_top() -> f64 {
    TOP + PLOT_HEIGHT + STRIP_GAP
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64) -> Line {
    Line::new()
        .set("x1", format!("{x1:.2}"))
        .set("y1", format!("{y1:.2}"))
        .set("x2", format!("{x2:.2}"))
        .set("y2", format!("{y2:.2}"))
}

fn draw_axes(group: &mut Group, axis: &TimeAxis) {
    let right = LEFT + PLOT_WIDTH;
    let (strip, bottom) = (strip_top(), strip_top() + STRIP_HEIGHT);
    let background = Rectangle::new()
        .set("x", LEFT)
        .set("y", strip)
        .set("width", PLOT_WIDTH)
        .set("height", STRIP_HEIGHT)
        .set("fill", STRIP);
    group.append(background);
    let small = |x: f64, y: f64, content: &str| text(x, y, content).set("font-size", SMALL);
    let mut names = vec![(0.0, "none".to_owned())];
    for power in (SMALLEST_POWER..=0).rev().step_by(2) {
        let y = height_of(10.0_f64.powi(power));
        names.push((
            y,
            if power == 0 {
                "1".to_owned()
            } else {
                format!("1e{power}")
            },
        ));
    }
    for (y, name) in names {
        group.append(line(LEFT, TOP + y, right, TOP + y).set("stroke", RULE));
        group.append(small(LEFT - 8.0, TOP + y + 4.5, &name).set("text-anchor", "end"));
    }
    let middle = strip + STRIP_HEIGHT / 2.0;
    let name = small(LEFT - 8.0, middle + 4.5, "unsafe")
        .set("text-anchor", "end")
        .set("fill", Kind::Uncertified.colour());
    group.append(name);
    for (x, name) in axis.ticks() {
        let x = LEFT + x;
        let length = if name.is_some() { 7.0 } else { 4.0 };
        group.append(line(x, bottom, x, bottom + length).set("stroke", FAINT_INK));
        if let Some(name) = name {
            group.append(line(x, TOP, x, bottom).set("stroke", RULE));
            group.append(small(x, bottom + 21.0, &name).set("text-anchor", "middle"));
        }
    }
    group.append(line(LEFT, bottom, right, bottom).set("stroke", FAINT_INK));
    let title = small(right + 14.0, bottom + 21.0, "time per pair").set("fill", FAINT_INK);
    group.append(title);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::AccuracyOptions;

    fn plot() -> String {
        let rows = ElementaryMethod::ALL.map(|method| ElementaryRow {
            method,
            asked: if matches!(method, ElementaryMethod::TightInclusion(_)) {
                500
            } else {
                1000
            },
            touching: 10,
            nanoseconds: 50.0,
            missed: if method.is_certified() { 0 } else { 3 },
            late: 0,
            latest: 0.0,
            false_alarms: 1234,
            early: Some(method.tolerance().unwrap_or(0.0)),
            earliest: 0.1,
        });
        let set = ElementarySet {
            name: "some pairs".to_owned(),
            scalar: "f32",
            vertex_face: 400,
            edge_edge: 600,
            touching: 10,
            with_time: 9,
            rows: rows.to_vec(),
        };
        let options = AccuracyOptions {
            pairs: 1000,
            repeat: 1,
            seed: 1,
            separation: 0.0,
        };
        elementary_svg(&ElementaryAccuracy {
            options,
            sets: vec![set],
        })
    }

    #[test]
    fn every_test_is_named_with_its_time_and_unsafe_ones_with_what_they_miss() {
        let svg = plot();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts: Vec<_> = document
            .descendants()
            .filter(|node| node.has_tag_name("text"))
            .filter_map(|node| node.text().map(str::trim))
            .collect();
        for label in [
            "some pairs, f32",
            "1,000 pairs, of which 10 touch",
            "certified 1e-9: 50.0 ns, 1,234 false",
            "Tight-Inclusion 1e-12 (500 pairs): 50.0 ns, 1,234 false",
            "exact: 50.0 ns, 1,234 false",
            "cubic: 3 missed, 0 late, 1,234 false",
        ] {
            assert!(texts.contains(&label), "{label}: {texts:?}");
        }
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn ten_times_the_error_is_a_line_down_and_none_is_above_all() {
        assert_eq!(height_of(0.0), 0.0);
        assert!((height_of(1e-16) - STEP).abs() < 1e-9);
        assert!((height_of(1e-4) - height_of(1e-5) - STEP).abs() < 1e-9);
        assert!((height_of(1.0) - PLOT_HEIGHT).abs() < 1e-9);
    }
}
