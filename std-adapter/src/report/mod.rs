//! What studies found, as tables, CSV, JSON, plots and pictures. Everything is returned as text or bytes, or written
//! to what the caller hands over; nothing here opens a file. The same data gives the same bytes, on every machine.

mod csv;
mod figure;
mod findings;
pub mod json;
mod number;
mod paper;
mod plot;
mod step;
mod table_svg;
pub mod tables;

pub use self::csv::{comparison_csv, contacts_csv, pairs_csv};
pub use figure::{FIGURE_SIZE, FigureError, FigurePairs, figure_3};
pub use findings::{Finding, findings};
pub use paper::{PaperRow, paper_row};
pub use plot::scaling_svg;
pub use step::StepSummary;
pub use table_svg::comparison_svg;

use crate::pipeline::Stage;
use crate::study::{ComparisonRow, MeanCounts};

/// The primitive pairs of a method before any culling test.
fn distributed(row: &ComparisonRow) -> MeanCounts {
    let stage = row
        .stages
        .iter()
        .find(|stage| stage.stage == Stage::Distribution);
    stage.map(|stage| stage.survivors).unwrap_or_default()
}
