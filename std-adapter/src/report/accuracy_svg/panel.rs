//! One set of pairs in one format.

use super::axes::{ShareAxis, TimeAxis};
use super::marks::Kind;
use super::text;
use crate::report::number::{grouped, percent, time};
use crate::report::plot::spread;
use crate::report::table_svg::{FAINT_INK, INK, RULE};
use crate::study::{AccuracyRow, AccuracySet, BackendTime, MeasuredFilter};
use selvedge_core::filter::Tier;
use svg::Node;
use svg::node::element::{Group, Line, Rectangle};

pub(super) const WIDTH: f64 = 590.0;
pub(super) const HEIGHT: f64 = 302.0;
pub(super) const PLOT_WIDTH: f64 = 266.0;
/// Room for the names of the lines.
const LEFT: f64 = 72.0;
/// Room for the heading.
const TOP: f64 = 66.0;
const LABEL_X: f64 = LEFT + PLOT_WIDTH + 24.0;
const LABEL_SPACING: f64 = 18.0;
/// Marks nearer to each other than this touch.
const TOUCHING: f64 = 10.0;
const SMALL: f64 = 12.5;
/// The strip of filters without proof: below the plot, as high as two labels.
const STRIP_GAP: f64 = 12.0;
const STRIP_HEIGHT: f64 = 2.0 * LABEL_SPACING + 6.0;
const STRIP: &str = "#fbe9de";

/// A set's marks, each with its label.
pub(super) struct Panel<'a> {
    set: &'a AccuracySet,
    proven: Vec<Mark>,
    unsafe_marks: Vec<Mark>,
}

struct Mark {
    kind: Kind,
    nanoseconds: f64,
    y: f64,
    label: String,
}

impl<'a> Panel<'a> {
    pub(super) fn new(set: &'a AccuracySet) -> Self {
        let mut panel = Self {
            set,
            proven: Vec::new(),
            unsafe_marks: Vec::new(),
        };
        for row in &set.rows {
            let kind = Kind::of(row.filter);
            panel.add(row, kind, row.best_time());
            if row.filter == MeasuredFilter::Tier(Tier::Permanent) {
                panel.add(row, Kind::OneAtATime, row.times.first().copied());
            }
        }
        panel
    }

    fn add(&mut self, row: &AccuracyRow, kind: Kind, time: Option<BackendTime>) {
        let Some(BackendTime { nanoseconds, .. }) =
            time.filter(|time| time.nanoseconds.is_finite())
        else {
            return;
        };
        let name = match row.filter {
            MeasuredFilter::Tier(Tier::Uncertified) => "as computed".to_owned(),
            filter => filter.name().replace('_', " "),
        };
        let one = if kind == Kind::OneAtATime {
            ", one by one"
        } else {
            ""
        };
        let label = format!("{name}{one}: {}", self::time(nanoseconds * 1e-9));
        let (y, label) = match kind {
            // The strip has two lines.
            Kind::Uncertified => {
                let line = self.unsafe_marks.len() as f64 + 0.5;
                let y = strip_top() + 3.0 + line * LABEL_SPACING;
                let false_culls = match row.culled_beyond_exact {
                    0 => "none false here".to_owned(),
                    some => format!("{} false", grouped(some as u64)),
                };
                (Some(y), format!("{label}, {false_culls}"))
            }
            kind => {
                let y = ShareAxis::place(row.kept_cullable, self.set.cullable);
                let beyond = percent(row.culled_beyond_exact, self.set.pairs(), 1);
                let label = match kind {
                    Kind::Subdivided => format!("{label}, +{beyond}"),
                    _ => label,
                };
                (y.map(|y| TOP + y), label)
            }
        };
        let marks = match kind {
            Kind::Uncertified => &mut self.unsafe_marks,
            _ => &mut self.proven,
        };
        marks.extend(y.map(|y| Mark {
            kind,
            nanoseconds,
            y,
            label,
        }));
    }

    /// In nanoseconds.
    pub(super) fn times(&self) -> impl Iterator<Item = f64> {
        let marks = self.proven.iter().chain(&self.unsafe_marks);
        marks.map(|mark| mark.nanoseconds)
    }

    pub(super) fn draw(&self, group: &mut Group, axis: &TimeAxis) {
        self.draw_heading(group);
        draw_axes(group, axis);
        self.draw_marks(group, axis);
    }

    fn draw_heading(&self, group: &mut Group) {
        let set = self.set;
        let title = format!("{}, {}", set.name, set.scalar);
        group.append(text(0.0, 16.0, &title).set("font-weight", "bold"));
        let pairs = format!(
            "{} pairs, of which exact arithmetic culls {}",
            grouped(set.pairs() as u64),
            percent(set.cullable, set.pairs(), 1),
        );
        group.append(
            text(0.0, 35.0, &pairs)
                .set("font-size", SMALL)
                .set("fill", FAINT_INK),
        );
        let title = text(0.0, TOP - 11.0, "of these it culls");
        group.append(title.set("font-size", SMALL).set("fill", FAINT_INK));
        if self.proven.is_empty() {
            let note = text(
                LEFT + 12.0,
                TOP + 40.0,
                "exact arithmetic culls none of them",
            );
            group.append(note.set("fill", FAINT_INK));
        }
    }

    fn draw_marks(&self, group: &mut Group, axis: &TimeAxis) {
        // Labels leave a crowded line downwards in the upper half, upwards in the lower one. Of several marks on a line the
        // rightmost has the nearest label, so that leaders do not cross. Marks that touch are on a line.
        let line_of = |mark: &Mark| (mark.y / TOUCHING).round() as i32;
        let mut proven: Vec<&Mark> = self.proven.iter().collect();
        proven.sort_by(|a, b| {
            let by_time = a.nanoseconds.total_cmp(&b.nanoseconds);
            let is_low = f64::from(line_of(a)) * TOUCHING > TOP + ShareAxis::HEIGHT / 2.0;
            line_of(a)
                .cmp(&line_of(b))
                .then(if is_low { by_time } else { by_time.reverse() })
        });
        let wanted: Vec<i32> = proven
            .iter()
            .map(|mark| line_of(mark) * TOUCHING as i32)
            .collect();
        let lowest = (TOP + ShareAxis::HEIGHT) as i32;
        let places = spread(&wanted, LABEL_SPACING as i32, lowest);
        let in_strip = self.unsafe_marks.iter().map(|mark| (mark, mark.y));
        let placed = proven
            .iter()
            .zip(places)
            .map(|(&mark, y)| (mark, f64::from(y)));
        let all: Vec<(&Mark, f64)> = placed.chain(in_strip).collect();
        for &(mark, label_y) in &all {
            let x = LEFT + axis.place(mark.nanoseconds);
            let leader = line(x, mark.y, LABEL_X - 5.0, label_y)
                .set("stroke", mark.kind.colour())
                .set("stroke-opacity", 0.45);
            group.append(leader);
        }
        for &(mark, label_y) in &all {
            mark.kind
                .draw(group, LEFT + axis.place(mark.nanoseconds), mark.y);
            let label = text(LABEL_X, label_y + 4.5, &mark.label)
                .set("font-size", SMALL)
                .set("fill", INK);
            group.append(label);
        }
    }
}

fn strip_top() -> f64 {
    TOP + ShareAxis::HEIGHT + STRIP_GAP
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
    for (y, name) in ShareAxis::lines() {
        group.append(line(LEFT, TOP + y, right, TOP + y).set("stroke", RULE));
        group.append(small(LEFT - 8.0, TOP + y + 4.5, name).set("text-anchor", "end"));
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
    let title = small(right + 10.0, bottom + 21.0, "time per pair").set("fill", FAINT_INK);
    group.append(title);
}
