//! What accuracy costs in time, as a plot.

mod axes;
mod elementary;
mod frame;
mod marks;
mod panel;

pub use elementary::elementary_svg;

use crate::study::{Accuracy, AccuracySet};
use axes::TimeAxis;
use frame::{Head, picture};
use marks::Kind;
use panel::Panel;

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
    let axis = TimeAxis::over(times, panel::PLOT.width);
    let mut backends = accuracy.sets.iter().filter_map(best_backend);
    let lanes = backends.next_back().unwrap_or("no");
    let separation = match accuracy.options.separation {
        0.0 => String::new(),
        separation => format!(", separation {separation}"),
    };
    let head = Head {
        title: "What accuracy costs in time",
        explanation: &format!(
            "Up: culls more of what exact arithmetic culls. Left: faster. Pairs are gathered from a mesh by one thread, \
             sixteen side by side ({lanes}){separation}."
        ),
        legend: &Kind::ALL.map(|kind| (kind, kind.legend())),
    };
    let size = [panel::WIDTH, panel::PLOT.panel_height()];
    picture(&head, size, &panels, |group, panel| {
        panel.draw(group, &axis);
    })
}

/// The instruction set of the plotted times.
fn best_backend(set: &AccuracySet) -> Option<&'static str> {
    Some(set.rows.last()?.best_time()?.backend)
}

#[cfg(test)]
mod tests;
