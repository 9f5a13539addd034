//! The elementary tests: error of the time of impact against time per pair.

use super::axes::TimeAxis;
use super::frame::{Head, LEFT, Plot, SMALL, TOP, draw_heading, picture};
use super::marks::Kind;
use crate::report::number::{grouped, time};
use crate::report::plot::spread;
use crate::report::table_svg::prose_width;
use crate::study::elementary::{ElementaryAccuracy, ElementaryMethod, ElementaryRow, ElementarySet};
use svg::Node;
use svg::node::element::{Group, Polyline};

const PLOT: Plot = Plot {
    width: 300.0,
    height: STEP * (1 - SMALLEST_POWER) as f64,
    strip_height: UNSAFE.len() as f64 * NAME_SPACING + 8.0,
};
/// Between two powers of ten.
const STEP: f64 = 14.0;
/// Errors are drawn as if none were smaller; above the smallest there is a line for none.
const SMALLEST_POWER: i32 = -16;
const NAME_SPACING: f64 = 18.0;

const LEGEND: [(Kind, &str); 4] = [
    (Kind::Certified, "certified"),
    (Kind::Exact, "exact verdict"),
    (Kind::Subdivided, "Tight-Inclusion, re-implemented"),
    (Kind::Uncertified, "unsafe: misses contacts, or finds them too late"),
];

/// Tests without proof, as reports and as the plot name them.
const UNSAFE: [(&str, &str); 4] = [
    ("without_bounds", "without bounds"),
    ("additive", "additive"),
    ("bernstein_sign", "Bernstein sign"),
    ("cubic", "cubic"),
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
/// less from line to line. A line joins the tolerances of one test. Tests that may miss contacts, or find them too late, have no
/// place on that axis; they stand in a strip of their own, with what they got wrong.
#[must_use]
pub fn elementary_svg(accuracy: &ElementaryAccuracy) -> String {
    let times = accuracy.sets.iter().flat_map(|set| &set.rows);
    let axis = TimeAxis::over(times.map(|row| row.nanoseconds), PLOT.width);
    let head = Head {
        title: "What an accurate time of impact costs in time",
        explanation: "Up: contacts are found nearer to their exact time. Left: faster. One pair at a time, on one thread. \
                      A line joins tolerances δ from 1e-2 to 1e-12. False: never touches, but is not called free.",
        legend: &LEGEND,
    };
    let panels: Vec<_> = accuracy.sets.iter().map(|set| Panel::new(set, &axis)).collect();
    let names = panels.iter().flat_map(Panel::names);
    let widest = names.fold(0.0, |widest: f64, name| widest.max(prose_width(name, SMALL)));
    let size = [PLOT.names_from() + widest, PLOT.panel_height()];
    picture(&head, size, &panels, |group, panel| {
        panel.draw(group, &axis);
    })
}

/// One set of pairs in one format.
struct Panel<'a> {
    set: &'a ElementarySet,
    /// In the order of the set's rows: from the widest tolerance of a test to the tightest.
    proven: Vec<Mark>,
    not_proven: Vec<Unsafe>,
}

struct Mark {
    kind: Kind,
    x: f64,
    y: f64,
    /// Of the ends of a line.
    name: Option<String>,
}

/// A test in the strip, with all its tolerances.
struct Unsafe {
    places: Vec<f64>,
    name: String,
}

impl<'a> Panel<'a> {
    fn new(set: &'a ElementarySet, axis: &TimeAxis) -> Self {
        let proven = set.rows.iter().filter(|row| row.method.is_certified());
        // Nothing for a test that was not asked about a contact of known time.
        let proven: Vec<_> = proven.filter_map(|row| Some((row, row.early?))).collect();
        let kind_at = |index: usize| proven.get(index).map(|(row, _)| kind(row.method));
        let marks = proven.iter().enumerate().map(|(index, &(row, early))| {
            let kind = kind(row.method);
            let is_first = index == 0 || kind_at(index - 1) != Some(kind);
            let is_end = is_first || kind_at(index + 1) != Some(kind);
            Mark {
                kind,
                x: LEFT + axis.place(row.nanoseconds),
                y: TOP + height_of(early),
                name: is_end.then(|| name_of_proven(row, set)),
            }
        });
        let not_proven = UNSAFE.map(|(method, name)| {
            let of_method = |row: &&ElementaryRow| row.method.name() == method && row.asked > 0;
            let rows: Vec<_> = set.rows.iter().filter(of_method).collect();
            let places = rows.iter().map(|row| LEFT + axis.place(row.nanoseconds));
            Unsafe {
                places: places.collect(),
                name: name_of_unsafe(name, &rows, set),
            }
        });
        Self {
            set,
            proven: marks.collect(),
            not_proven: not_proven.into(),
        }
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        let proven = self.proven.iter().filter_map(|mark| mark.name.as_deref());
        proven.chain(self.not_proven.iter().map(|test| test.name.as_str()))
    }

    fn draw(&self, group: &mut Group, axis: &TimeAxis) {
        let set = self.set;
        let title = format!("{}, {}", set.name, set.scalar);
        let pairs = format!(
            "{} pairs, of which {} touch",
            grouped((set.vertex_face + set.edge_edge) as u64),
            grouped(set.touching as u64),
        );
        draw_heading(group, &title, &pairs, "too early by, in steps (median)");
        PLOT.draw_axes(group, axis, lines());
        self.draw_lines(group);
        self.draw_proven(group);
        self.draw_unsafe(group);
    }

    fn draw_lines(&self, group: &mut Group) {
        for kind in [Kind::Certified, Kind::Subdivided] {
            let marks = self.proven.iter().filter(|mark| mark.kind == kind);
            let points: Vec<_> = marks.map(|mark| format!("{:.2},{:.2}", mark.x, mark.y)).collect();
            let line = Polyline::new()
                .set("points", points.join(" "))
                .set("fill", "none")
                .set("stroke", kind.colour())
                .set("stroke-width", 1.5);
            group.append(line);
        }
    }

    fn draw_proven(&self, group: &mut Group) {
        let named = self.proven.iter();
        let mut named: Vec<_> = named.filter_map(|mark| Some((mark, mark.name.as_deref()?))).collect();
        named.sort_by(|(a, _), (b, _)| a.y.total_cmp(&b.y).then(b.x.total_cmp(&a.x)));
        let wanted: Vec<i32> = named.iter().map(|(mark, _)| mark.y as i32).collect();
        let lowest = (TOP + PLOT.height) as i32;
        let places = spread(&wanted, NAME_SPACING as i32, lowest);
        for (&(mark, name), place) in named.iter().zip(places) {
            let name_y = f64::from(place);
            PLOT.draw_leader(group, [mark.x, mark.y], name_y, mark.kind);
            PLOT.draw_name(group, name_y, name);
        }
        for mark in &self.proven {
            mark.kind.draw(group, mark.x, mark.y);
        }
    }

    fn draw_unsafe(&self, group: &mut Group) {
        for (index, test) in self.not_proven.iter().enumerate() {
            let y = PLOT.strip_top() + 4.0 + (index as f64 + 0.5) * NAME_SPACING;
            for &x in &test.places {
                Kind::Uncertified.draw(group, x, y);
            }
            PLOT.draw_name(group, y, &test.name);
        }
    }
}

fn name_of_proven(row: &ElementaryRow, set: &ElementarySet) -> String {
    let name = match row.method {
        ElementaryMethod::Certified(tolerance) => format!("certified {tolerance:e}"),
        ElementaryMethod::TightInclusion(tolerance) => format!("Tight-Inclusion {tolerance:e}"),
        _ => "exact".to_owned(),
    };
    let time = time(row.nanoseconds * 1e-9);
    let alarms = match row.false_alarms {
        0 => String::new(),
        some => format!(", {} false", grouped(some as u64)),
    };
    format!("{name}{}: {time}{alarms}", part_asked(row.asked, set))
}

/// With the worst of all tolerances.
fn name_of_unsafe(name: &str, rows: &[&ElementaryRow], set: &ElementarySet) -> String {
    let Some(asked) = rows.iter().map(|row| row.asked).min() else {
        return format!("{name}: not asked");
    };
    let most = |count: fn(&ElementaryRow) -> usize| {
        let counts = rows.iter().map(|row| count(row));
        grouped(counts.max().unwrap_or_default() as u64)
    };
    format!(
        "{name}{}: {}{} missed, {} late, {} false",
        part_asked(asked, set),
        if rows.len() > 1 { "up to " } else { "" },
        most(|row| row.missed),
        most(|row| row.late),
        most(|row| row.false_alarms),
    )
}

/// How many pairs a test was asked about, if not all.
fn part_asked(asked: usize, set: &ElementarySet) -> String {
    if asked < set.vertex_face + set.edge_edge {
        format!(" ({} pairs)", grouped(asked as u64))
    } else {
        String::new()
    }
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

/// Lines across, and their names.
fn lines() -> impl Iterator<Item = (f64, String)> {
    let powers = (SMALLEST_POWER..=0).rev().step_by(2);
    let named = powers.map(|power| {
        let name = match power {
            0 => "1".to_owned(),
            power => format!("1e{power}"),
        };
        (height_of(10.0_f64.powi(power)), name)
    });
    named.chain([(0.0, "none".to_owned())])
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
            "certified 1e-2: 50.0 ns, 1,234 false",
            "certified 1e-12: 50.0 ns, 1,234 false",
            "Tight-Inclusion 1e-12 (500 pairs): 50.0 ns, 1,234 false",
            "exact: 50.0 ns, 1,234 false",
            "without bounds: up to 3 missed, 0 late, 1,234 false",
            "cubic: 3 missed, 0 late, 1,234 false",
        ] {
            assert!(texts.contains(&label), "{label}: {texts:?}");
        }
        // Only the ends of a line are named.
        assert!(!texts.iter().any(|text| text.contains("1e-9")), "{texts:?}");
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn ten_times_the_error_is_a_line_down_and_none_is_above_all() {
        assert_eq!(height_of(0.0), 0.0);
        assert!((height_of(1e-16) - STEP).abs() < 1e-9);
        assert!((height_of(1e-4) - height_of(1e-5) - STEP).abs() < 1e-9);
        assert!((height_of(1.0) - PLOT.height).abs() < 1e-9);
    }
}
