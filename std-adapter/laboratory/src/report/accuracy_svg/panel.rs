//! One set of pairs in one format.

use super::axes::{ShareAxis, TimeAxis};
use super::frame::{LEFT, Plot, TOP, draw_heading, text};
use super::marks::Kind;
use crate::report::number::{grouped, percent, time};
use crate::report::plot::spread;
use crate::report::table_svg::FAINT_INK;
use crate::study::{AccuracyRow, AccuracySet, BackendTime, MeasuredFilter};
use selvedge_core::filter::Tier;
use svg::Node;
use svg::node::element::Group;

pub(super) const WIDTH: f64 = 590.0;
pub(super) const PLOT: Plot = Plot {
    width: 266.0,
    height: ShareAxis::HEIGHT,
    // As high as two labels.
    strip_height: 2.0 * LABEL_SPACING + 6.0,
};
const LABEL_SPACING: f64 = 18.0;
/// Marks nearer to each other than this touch.
const TOUCHING: f64 = 10.0;

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
        let Some(BackendTime { nanoseconds, .. }) = time.filter(|time| time.nanoseconds.is_finite()) else {
            return;
        };
        let name = match row.filter {
            MeasuredFilter::Tier(Tier::Uncertified) => "as computed".to_owned(),
            filter => filter.name().replace('_', " "),
        };
        let one = if kind == Kind::OneAtATime { ", one by one" } else { "" };
        let label = format!("{name}{one}: {}", self::time(nanoseconds * 1e-9));
        let (y, label) = match kind {
            // The strip has two lines.
            Kind::Uncertified => {
                let line = self.unsafe_marks.len() as f64 + 0.5;
                let y = PLOT.strip_top() + 3.0 + line * LABEL_SPACING;
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
        let set = self.set;
        let pairs = format!(
            "{} pairs, of which exact arithmetic culls {}",
            grouped(set.pairs() as u64),
            percent(set.cullable, set.pairs(), 1),
        );
        let title = format!("{}, {}", set.name, set.scalar);
        draw_heading(group, &title, &pairs, "of these it culls");
        if self.proven.is_empty() {
            let note = "exact arithmetic culls none of them";
            group.append(text(LEFT + 12.0, TOP + 40.0, note).set("fill", FAINT_INK));
        }
        PLOT.draw_axes(group, axis, ShareAxis::lines());
        self.draw_marks(group, axis);
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
        let wanted: Vec<i32> = proven.iter().map(|mark| line_of(mark) * TOUCHING as i32).collect();
        let lowest = (TOP + ShareAxis::HEIGHT) as i32;
        let places = spread(&wanted, LABEL_SPACING as i32, lowest);
        let in_strip = self.unsafe_marks.iter().map(|mark| (mark, mark.y));
        let placed = proven.iter().zip(places).map(|(&mark, y)| (mark, f64::from(y)));
        let all: Vec<(&Mark, f64)> = placed.chain(in_strip).collect();
        let x_of = |mark: &Mark| LEFT + axis.place(mark.nanoseconds);
        for &(mark, label_y) in &all {
            PLOT.draw_leader(group, [x_of(mark), mark.y], label_y, mark.kind);
        }
        for &(mark, label_y) in &all {
            mark.kind.draw(group, x_of(mark), mark.y);
            PLOT.draw_name(group, label_y, &mark.label);
        }
    }
}
