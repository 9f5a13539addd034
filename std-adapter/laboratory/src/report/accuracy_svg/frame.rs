//! What the plots of accuracy have in common: panels in two columns below a head; in each a plot, time to the right, names
//! beside it, and a strip below for what is unsafe.

use super::axes::TimeAxis;
use super::marks::Kind;
use crate::report::table_svg::{FAINT_INK, FONT, INK, PAPER_WHITE, RULE, prose_width};
use svg::node::element::{Group, Line, Rectangle, Text};
use svg::{Document, Node};

// Lengths in pixels, at the picture's own size.
const MARGIN: f64 = 24.0;
const FONT_SIZE: f64 = 14.0;
const TITLE_SIZE: f64 = 21.0;
pub(super) const SMALL: f64 = 12.5;
const COLUMNS: usize = 2;
const COLUMN_GAP: f64 = 30.0;
const ROW_GAP: f64 = 16.0;
const HEAD_HEIGHT: f64 = 124.0;

/// A panel's room for the names of lines.
pub(super) const LEFT: f64 = 72.0;
/// Its room for the heading.
pub(super) const TOP: f64 = 72.0;
/// From a plot to the names beside it.
const NAME_GAP: f64 = 24.0;
const STRIP_GAP: f64 = 12.0;
/// Below the strip: the axis, its numbers and its title.
const FOOT: f64 = 46.0;
const STRIP: &str = "#fbe9de";

/// What stands above all panels.
pub(super) struct Head<'a> {
    pub(super) title: &'a str,
    pub(super) explanation: &'a str,
    /// What marks mean.
    pub(super) legend: &'a [(Kind, &'a str)],
}

impl Head<'_> {
    fn draw(&self, picture: &mut Group) {
        let title = text(MARGIN, 36.0, self.title);
        picture.append(title.set("font-size", TITLE_SIZE).set("font-weight", "bold"));
        picture.append(text(MARGIN, 62.0, self.explanation).set("fill", FAINT_INK));
        let mut x = MARGIN + 6.0;
        for (kind, meaning) in self.legend {
            let y = 92.0;
            kind.draw(picture, x, y - 5.0);
            picture.append(text(x + 12.0, y, meaning));
            x += 12.0 + prose_width(meaning, FONT_SIZE) + 26.0;
        }
    }
}

/// A picture of panels of one size, on a light background of its own.
pub(super) fn picture<T>(
    head: &Head<'_>,
    [panel_width, panel_height]: [f64; 2],
    panels: &[T],
    draw_panel: impl Fn(&mut Group, &T),
) -> String {
    let width = 2.0 * MARGIN + COLUMNS as f64 * panel_width + COLUMN_GAP;
    let rows = panels.len().div_ceil(COLUMNS) as f64;
    let height = HEAD_HEIGHT + rows * (panel_height + ROW_GAP);
    let mut picture = Group::new()
        .set("font-family", FONT)
        .set("font-size", FONT_SIZE)
        .set("fill", INK);
    head.draw(&mut picture);
    for (index, panel) in panels.iter().enumerate() {
        let (row, column) = ((index / COLUMNS) as f64, (index % COLUMNS) as f64);
        let x = MARGIN + column * (panel_width + COLUMN_GAP);
        let y = HEAD_HEIGHT + row * (panel_height + ROW_GAP);
        let mut group = Group::new().set("transform", format!("translate({x} {y})"));
        draw_panel(&mut group, panel);
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

/// A panel's heading: whose pairs, how many, and what goes up.
pub(super) fn draw_heading(group: &mut Group, title: &str, pairs: &str, upwards: &str) {
    group.append(text(0.0, 16.0, title).set("font-weight", "bold"));
    for (y, content) in [(35.0, pairs), (TOP - 18.0, upwards)] {
        group.append(small(0.0, y, content).set("fill", FAINT_INK));
    }
}

/// The size of a panel's plot, below [`TOP`] and right of [`LEFT`].
pub(super) struct Plot {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) strip_height: f64,
}

impl Plot {
    /// Of the whole panel.
    pub(super) const fn panel_height(&self) -> f64 {
        self.strip_bottom() + FOOT
    }

    pub(super) const fn strip_top(&self) -> f64 {
        TOP + self.height + STRIP_GAP
    }

    const fn strip_bottom(&self) -> f64 {
        self.strip_top() + self.strip_height
    }

    /// Where the names of marks begin.
    pub(super) const fn names_from(&self) -> f64 {
        LEFT + self.width + NAME_GAP
    }

    /// The lines to be drawn across are given from the plot's top, with their names.
    pub(super) fn draw_axes<N: AsRef<str>>(&self, group: &mut Group, axis: &TimeAxis, lines: impl IntoIterator<Item = (f64, N)>) {
        let right = LEFT + self.width;
        let (strip, bottom) = (self.strip_top(), self.strip_bottom());
        let background = Rectangle::new()
            .set("x", LEFT)
            .set("y", strip)
            .set("width", self.width)
            .set("height", self.strip_height)
            .set("fill", STRIP);
        group.append(background);
        let name = |y: f64, name: &str| small(LEFT - 8.0, y + 4.5, name).set("text-anchor", "end");
        for (y, of_line) in lines {
            group.append(line(LEFT, TOP + y, right, TOP + y).set("stroke", RULE));
            group.append(name(TOP + y, of_line.as_ref()));
        }
        let middle = strip + self.strip_height / 2.0;
        group.append(name(middle, "unsafe").set("fill", Kind::Uncertified.colour()));
        for (x, of_tick) in axis.ticks() {
            let x = LEFT + x;
            let length = if of_tick.is_some() { 7.0 } else { 4.0 };
            group.append(line(x, bottom, x, bottom + length).set("stroke", FAINT_INK));
            if let Some(of_tick) = of_tick {
                group.append(line(x, TOP, x, bottom).set("stroke", RULE));
                group.append(small(x, bottom + 21.0, &of_tick).set("text-anchor", "middle"));
            }
        }
        group.append(line(LEFT, bottom, right, bottom).set("stroke", FAINT_INK));
        let title = small(right, bottom + 38.0, "time per pair").set("text-anchor", "end");
        group.append(title.set("fill", FAINT_INK));
    }

    /// From a mark at (`x`, `y`) to its name, which stands at the height `name_y`.
    pub(super) fn draw_leader(&self, group: &mut Group, [x, y]: [f64; 2], name_y: f64, kind: Kind) {
        let leader = line(x, y, self.names_from() - 5.0, name_y)
            .set("stroke", kind.colour())
            .set("stroke-opacity", 0.45);
        group.append(leader);
    }

    /// A name at the height `y`.
    pub(super) fn draw_name(&self, group: &mut Group, y: f64, name: &str) {
        group.append(small(self.names_from(), y + 4.5, name).set("fill", INK));
    }
}

pub(super) fn text(x: f64, y: f64, content: &str) -> Text {
    Text::new(content).set("x", x).set("y", y)
}

fn small(x: f64, y: f64, content: &str) -> Text {
    text(x, y, content).set("font-size", SMALL)
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64) -> Line {
    Line::new()
        .set("x1", format!("{x1:.2}"))
        .set("y1", format!("{y1:.2}"))
        .set("x2", format!("{x2:.2}"))
        .set("y2", format!("{y2:.2}"))
}
