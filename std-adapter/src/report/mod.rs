//! What studies found, as tables, CSV, JSON, plots and pictures. Everything is returned as text or bytes, or written
//! to what the caller hands over; nothing here opens a file. The same data gives the same bytes, on every machine.

#[cfg(feature = "accuracy")]
mod accuracy_svg;
mod csv;
mod figure;
mod findings;
#[cfg(feature = "simulation")]
mod gltf;
pub mod json;
mod number;
mod paper;
mod plot;
#[cfg(feature = "simulation")]
mod simulation_html;
mod step;
mod table_svg;
pub mod tables;

pub use self::csv::{comparison_csv, contacts_csv, pairs_csv};
#[cfg(feature = "accuracy")]
pub use accuracy_svg::accuracy_svg;
pub use figure::{FIGURE_SIZE, FigureError, FigurePairs, figure_3};
pub use findings::{Finding, findings};
#[cfg(feature = "simulation")]
pub use gltf::animated_gltf;
pub use paper::{PaperRow, paper_row};
pub use plot::scaling_svg;
#[cfg(feature = "simulation")]
pub use simulation_html::simulation_html;
pub use step::StepSummary;
pub use table_svg::comparison_svg;

use crate::pipeline::Stage;
use crate::study::{ComparisonRow, MeanCounts, ScalingPoint};

/// The primitive pairs of a method before any culling test.
fn distributed(row: &ComparisonRow) -> MeanCounts {
    let stage = row
        .stages
        .iter()
        .find(|stage| stage.stage == Stage::Distribution);
    stage.map(|stage| stage.survivors).unwrap_or_default()
}

/// Each size's time for a step over n log n, as a multiple of the first size's: 1 throughout for a cost of n log n.
fn n_log_n_ratios(points: &[ScalingPoint]) -> Vec<f64> {
    let cost = |point: &ScalingPoint| {
        let n = point.triangles as f64;
        point.step.seconds / (n * n.ln())
    };
    let first = points.first().map_or(1.0, cost);
    points.iter().map(|point| cost(point) / first).collect()
}
