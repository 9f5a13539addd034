//! What accuracy costs in time, as a plot.

mod axes;
#[cfg(feature = "files")]
mod elementary;
mod marks;
mod panel;

#[cfg(feature = "files")]
pub use elementary::elementary_svg;

use super::table_svg::{FAINT_INK, FONT, INK, PAPER_WHITE, prose_width};
use crate::study::{Accuracy, AccuracySet};
use axes::TimeAxis;
use marks::Kind;
use panel::Panel;
use svg::node::element::{Group, Rectangle, Text};
use svg::{Document, Node};

// Lengths in pixels, at the picture's own size.
const MARGIN: f64 = 24.0;
const FONT_SIZE: f64 = 14.0;
const TITLE_SIZE: f64 = 21.0;
const COLUMNS: usize = 2;
const COLUMN_GAP: f64 = 30.0;
const ROW_GAP: f64 = 26.0;
const HEAD_HEIGHT: f64 = 124.0;

/// Accuracy against time, as an SVG picture with its own light background: a panel for each set of pairs and format.
///
/// To the right, time per pair (logarithmic, the same in all panels): sixteen pairs side by side on the best instruction
/// set, except where the name says otherwise. Up, the share of the pairs that exact arithmetic culls which a filter culls as
/// well: each line is ten times closer to all. Filters without a proof have no place on that axis; they stand in a strip
/// of their own, with the number of pairs that they cull without proof.
#[must_use]
pub fn accuracy_svg(accuracy: &Accuracy) -> String {
    let panels: Vec<Panel> = accuracy.sets.iter().map(Panel::new).collect();
    let times = panels.iter().flat_map(Panel::times);
    let axis = TimeAxis::over(times, panel::PLOT_WIDTH);
    let width = 2.0 * MARGIN + COLUMNS as f64 * panel::WIDTH + COLUMN_GAP;
    let rows = panels.len().div_ceil(COLUMNS) as f64;
    let height = HEAD_HEIGHT + rows * (panel::HEIGHT + ROW_GAP);

    let mut picture = Group::new()
        .set("font-family", FONT)
        .set("font-size", FONT_SIZE)
        .set("fill", INK);
    draw_head(&mut picture, accuracy);
    for (index, panel) in panels.iter().enumerate() {
        let (row, column) = ((index / COLUMNS) as f64, (index % COLUMNS) as f64);
        let x = MARGIN + column * (panel::WIDTH + COLUMN_GAP);
        let y = HEAD_HEIGHT + row * (panel::HEIGHT + ROW_GAP);
        let mut group = Group::new().set("transform", format!("translate({x} {y})"));
        panel.draw(&mut group, &axis);
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

fn draw_head(picture: &mut Group, accuracy: &Accuracy) {
    let title = text(MARGIN, 36.0, "What accuracy costs in time")
        .set("font-size", TITLE_SIZE)
        .set("font-weight", "bold");
    picture.append(title);
    let mut backends = accuracy.sets.iter().filter_map(best_backend);
    let lanes = backends.next_back().unwrap_or("no");
    let separation = match accuracy.options.separation {
        0.0 => String::new(),
        separation => format!(", separation {separation}"),
    };
    let explanation = format!(
        "Up: culls more of what exact arithmetic culls. Left: faster. Pairs are gathered from a mesh by one thread, \
         sixteen side by side ({lanes}){separation}."
    );
    picture.append(text(MARGIN, 62.0, &explanation).set("fill", FAINT_INK));
    let mut x = MARGIN + 6.0;
    for kind in Kind::ALL {
        let y = 92.0;
        kind.draw(picture, x, y - 5.0);
        picture.append(text(x + 12.0, y, kind.legend()));
        x += 12.0 + prose_width(kind.legend(), FONT_SIZE) + 26.0;
    }
}

/// The instruction set of the plotted times.
fn best_backend(set: &AccuracySet) -> Option<&'static str> {
    Some(set.rows.last()?.best_time()?.backend)
}

fn text(x: f64, y: f64, content: &str) -> Text {
    Text::new(content).set("x", x).set("y", y)
}

#[cfg(test)]
mod tests;
