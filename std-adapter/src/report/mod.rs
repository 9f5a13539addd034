//! What studies found, as tables, CSV and JSON. Everything is returned as text; nothing here writes a file.

mod csv;
mod findings;
pub mod json;
mod number;
mod paper;
mod step;
pub mod tables;

pub use self::csv::{comparison_csv, contacts_csv, pairs_csv};
pub use findings::{Finding, findings};
pub use paper::{PaperRow, paper_row};
pub use step::StepSummary;

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
