//! Draws the common parts of all plots: panels in two columns below a head. Each panel has a plot, names beside it, and a strip
//! below for unsafe methods.

use super::look::Look;
use super::svg::{PAPER_WHITE, line, px, text};
use maud::{Markup, PreEscaped, html};

// Lengths are in pixels, at the picture's own size.
const MARGIN: f64 = 24.0;
const FONT_SIZE: f64 = 14.0;
const SMALL: f64 = 12.5;
/// The largest mean width of a letter in the fonts below, for each pixel of font size.
const LETTER: f64 = 0.54;
const COLUMNS: usize = 2;
const COLUMN_GAP: f64 = 30.0;
const ROW_GAP: f64 = 16.0;
const LEGEND: f64 = 92.0;

/// The width of the names of lines in a panel.
const LEFT: f64 = 72.0;
/// The height of the heading.
const TOP: f64 = 72.0;
/// The distance from a plot to the names beside it.
const NAME_GAP: f64 = 24.0;
const NAME_SPACING: f64 = 18.0;
/// The distance below which marks touch.
const TOUCHING: f64 = 10.0;
const STRIP_GAP: f64 = 12.0;
/// The height of the axis below the strip, with its numbers and its title.
const FOOT: f64 = 46.0;
/// The distance from the middle of a line of small letters down to its baseline.
const BASELINE: f64 = 4.5;

const STYLE: &str = "\
text { font: 14px system-ui, -apple-system, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif; fill: #1f2328 } \
.small { font-size: 12.5px } .title { font-size: 21px } .title, .bold { font-weight: bold } \
.faint { fill: #656d76 } .unsafe { fill: #d55e00 } .middle { text-anchor: middle } .end { text-anchor: end } \
.rule { stroke: #d0d7de } .axis { stroke: #656d76 } polyline { fill: none }";

/// A picture of panels with common axes.
pub(super) struct Plot<'a> {
    pub(super) title: &'a str,
    /// The text above the legend. A plot without a legend explains itself in the panel's title.
    pub(super) explanation: &'a str,
    /// The meaning of marks.
    pub(super) legend: &'a [(Look, &'a str)],
    pub(super) size: [f64; 2],
    /// The places from the left, some with names.
    pub(super) ticks: Vec<(f64, Option<String>)>,
    /// The title of the axis to the right.
    pub(super) across: &'a str,
    /// The title of the axis upwards.
    pub(super) upwards: &'a str,
    /// The lines across, from the top down, with their names.
    pub(super) lines: Vec<(f64, String)>,
    /// The number of rows of the strip for unsafe methods.
    pub(super) strip_rows: usize,
}

/// One plot, its points in pixels from its top left corner.
#[derive(Default)]
pub(super) struct Panel {
    pub(super) title: String,
    pub(super) subtitle: String,
    /// A note in place of marks.
    pub(super) note: Option<&'static str>,
    pub(super) curves: Vec<Curve>,
    pub(super) marks: Vec<Mark>,
    pub(super) strip: Vec<StripRow>,
}

pub(super) struct Curve {
    pub(super) points: Vec<[f64; 2]>,
    pub(super) colour: &'static str,
    pub(super) width: f64,
    pub(super) is_dashed: bool,
}

pub(super) struct Mark {
    pub(super) look: Look,
    pub(super) at: [f64; 2],
    pub(super) name: Option<String>,
}

/// A method without a place on the axis upwards.
pub(super) struct StripRow {
    pub(super) places: Vec<f64>,
    pub(super) name: String,
}

impl Plot<'_> {
    /// Returns the SVG file.
    pub(super) fn draw(&self, panels: &[Panel]) -> String {
        let head_height = if self.legend.is_empty() { 56.0 } else { LEGEND + 32.0 };
        let names = panels.iter().flat_map(Panel::names);
        let widest = names.fold(0.0, |widest: f64, name| widest.max(width_of(name, SMALL)));
        let columns = panels.len().clamp(1, COLUMNS);
        let panel_width = (self.names_from() + widest).ceil();
        let panels_width = columns as f64 * panel_width + (columns - 1) as f64 * COLUMN_GAP;
        let width = 2.0 * MARGIN + panels_width.max(width_of(self.explanation, FONT_SIZE).ceil());
        let rows = panels.len().div_ceil(COLUMNS) as f64;
        let height = head_height + rows * (self.panel_height() + ROW_GAP);
        let placed = panels.iter().enumerate().map(|(index, panel)| {
            let (row, column) = ((index / COLUMNS) as f64, (index % COLUMNS) as f64);
            let x = MARGIN + column * (panel_width + COLUMN_GAP);
            let y = head_height + row * (self.panel_height() + ROW_GAP);
            (format!("translate({x} {y})"), panel)
        });
        let picture = html! {
            svg xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img" {
                style { (PreEscaped(STYLE)) }
                rect width="100%" height="100%" fill=(PAPER_WHITE) {}
                (self.head())
                @for (place, panel) in placed { g transform=(place) { (self.panel(panel)) } }
            }
        };
        picture.into_string()
    }

    fn head(&self) -> Markup {
        let mut x = MARGIN + 6.0;
        let entries = self.legend.iter().map(|&(look, meaning)| {
            let left = x;
            x += 12.0 + width_of(meaning, FONT_SIZE) + 26.0;
            (left, look, meaning)
        });
        html! {
            (text("title", [MARGIN, 36.0], self.title))
            @if !self.explanation.is_empty() { (text("faint", [MARGIN, 62.0], self.explanation)) }
            @for (x, look, meaning) in entries {
                (look.mark([x, LEGEND - 5.0]))
                (text("", [x + 12.0, LEGEND], meaning))
            }
        }
    }

    fn panel(&self, panel: &Panel) -> Markup {
        html! {
            (text("bold", [0.0, 16.0], &panel.title))
            (text("small faint", [0.0, 35.0], &panel.subtitle))
            (text("small faint", [0.0, TOP - 18.0], self.upwards))
            g transform=(format!("translate({LEFT} {TOP})")) {
                @if let Some(note) = panel.note { (text("faint", [12.0, 40.0], note)) }
                (self.axes())
                @for curve in &panel.curves { (curve.draw()) }
                (self.marks(&panel.marks))
                @for (index, row) in panel.strip.iter().enumerate() {
                    @let y = self.strip_top() + 4.0 + (index as f64 + 0.5) * NAME_SPACING;
                    @if let [x] = row.places[..] { (self.leader(Look::UNSAFE, [x, y], y)) }
                    @for &x in &row.places { (Look::UNSAFE.mark([x, y])) }
                    (self.name(y, &row.name))
                }
            }
        }
    }

    fn axes(&self) -> Markup {
        let ([width, height], bottom) = (self.size, self.strip_bottom());
        let strip = (self.strip_rows > 0).then(|| (self.strip_top(), self.strip_height()));
        html! {
            @if let Some((top, height)) = strip {
                rect y=(px(top)) width=(px(width)) height=(px(height)) fill="#fbe9de" {}
                (text("small unsafe end", [-8.0, top + height / 2.0 + BASELINE], "unsafe"))
            }
            @for (y, name) in &self.lines {
                (line("rule", [0.0, *y], [width, *y]))
                (text("small end", [-8.0, y + BASELINE], name))
            }
            @for (x, name) in &self.ticks {
                @let length = if name.is_some() { 7.0 } else { 4.0 };
                (line("axis", [*x, bottom], [*x, bottom + length]))
                @if let Some(name) = name {
                    (line("rule", [*x, 0.0], [*x, bottom]))
                    (text("small middle", [*x, bottom + 21.0], name))
                }
            }
            @if strip.is_none() { (line("axis", [0.0, 0.0], [0.0, height])) }
            (line("axis", [0.0, bottom], [width, bottom]))
            (text("small faint end", [width, bottom + 38.0], self.across))
        }
    }

    /// Draws marks, with their names to the right, which never overlap.
    fn marks(&self, marks: &[Mark]) -> Markup {
        // Names spread downwards from a crowded line, and upwards near the plot's end. The rightmost of several marks on a line
        // has the nearest name, so that leaders do not cross. Marks that touch are on one line.
        let height = self.size[1];
        let line_of = |mark: &Mark| TOUCHING * (mark.at[1] / TOUCHING).round();
        let named = marks.iter().filter_map(|mark| Some((mark, mark.name.as_deref()?)));
        let mut named: Vec<(&Mark, &str)> = named.collect();
        named.sort_by(|(a, _), (b, _)| {
            let to_the_right = a.at[0].total_cmp(&b.at[0]);
            let is_low = line_of(a) > 0.8 * height;
            let on_line = if is_low { to_the_right } else { to_the_right.reverse() };
            let higher = a.at[1].total_cmp(&b.at[1]);
            line_of(a).total_cmp(&line_of(b)).then(on_line).then(higher)
        });
        let wanted: Vec<f64> = named.iter().map(|(mark, _)| line_of(mark)).collect();
        let places = spread(&wanted, NAME_SPACING, height);
        html! {
            @for ((mark, _), &y) in named.iter().zip(&places) {
                (self.leader(mark.look, mark.at, y))
            }
            @for mark in marks { (mark.look.mark(mark.at)) }
            @for ((_, name), &y) in named.iter().zip(&places) { (self.name(y, name)) }
        }
    }

    /// Draws a line from a mark to its name at the height `y`.
    fn leader(&self, look: Look, mark: [f64; 2], y: f64) -> Markup {
        let end = [self.names_from() - LEFT - 5.0, y];
        html! { g stroke=(look.colour) stroke-opacity="0.45" { (line("", mark, end)) } }
    }

    /// Writes a name beside the plot.
    fn name(&self, y: f64, name: &str) -> Markup {
        text("small", [self.names_from() - LEFT, y + BASELINE], name)
    }

    /// Returns the left end of the names of marks, from the panel's left.
    fn names_from(&self) -> f64 {
        LEFT + self.size[0] + NAME_GAP
    }

    /// Returns the top of the strip, from the plot's top.
    fn strip_top(&self) -> f64 {
        self.size[1] + STRIP_GAP
    }

    fn strip_height(&self) -> f64 {
        self.strip_rows as f64 * NAME_SPACING + 8.0
    }

    fn strip_bottom(&self) -> f64 {
        match self.strip_rows {
            0 => self.size[1],
            _ => self.strip_top() + self.strip_height(),
        }
    }

    fn panel_height(&self) -> f64 {
        TOP + self.strip_bottom() + FOOT
    }
}

impl Panel {
    fn names(&self) -> impl Iterator<Item = &str> {
        let marks = self.marks.iter().filter_map(|mark| mark.name.as_deref());
        marks.chain(self.strip.iter().map(|row| row.name.as_str()))
    }
}

impl Curve {
    fn draw(&self) -> Markup {
        let points = self.points.iter().map(|&[x, y]| format!("{},{} ", px(x), px(y)));
        let points: String = points.collect();
        let dashes = self.is_dashed.then_some("8 6");
        html! {
            polyline points=(points.trim_end()) stroke=(self.colour) stroke-width=(self.width) stroke-dasharray=[dashes] {}
        }
    }
}

fn width_of(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * LETTER * size
}

/// Returns positions in ascending order, at least `spacing` apart, near the wanted ones (also ascending). The last is not beyond
/// `end`.
fn spread(wanted: &[f64], spacing: f64, end: f64) -> Vec<f64> {
    let mut places: Vec<f64> = Vec::with_capacity(wanted.len());
    for &place in wanted {
        places.push(places.last().map_or(place, |last| place.max(last + spacing)));
    }
    let mut limit = end;
    for place in places.iter_mut().rev() {
        *place = place.min(limit);
        limit = *place - spacing;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_order_and_distance() {
        assert_eq!(spread(&[10.0, 12.0, 80.0], 19.0, 400.0), [10.0, 29.0, 80.0]);
        assert_eq!(spread(&[390.0, 395.0, 398.0], 19.0, 400.0), [362.0, 381.0, 400.0]);
    }
}
