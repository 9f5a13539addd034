//! Turns results of studies and simulations into tables, CSV, JSON, plots, pictures, a page that works offline, and animated
//! glTF. Functions return text or bytes, or write to the caller's stream; they open no files. The same data gives the same bytes
//! on every machine.
//!
//! A [`Recorder`] turns a simulation into a [`Recording`], which reports read.

mod colours;
mod comparison;
mod csv;
mod figure;
pub mod gltf;
pub mod json;
mod number;
pub mod page;
mod paper;
mod plot;
mod prior;
mod recording;
pub mod side_by_side;
mod step;
pub mod still;
pub mod tables;
mod tangles;
mod truths;

pub use self::csv::{contacts_csv, pairs_csv};
pub use comparison::comparison_html;
pub use figure::{FIGURE_SIZE, figure_3};
pub use paper::{PaperRow, paper_row};
pub use plot::{accuracy_svg, convergence_svg, cost_of_accuracy_svg, cost_of_law_svg, elementary_svg, scaling_svg, truth_svg};
pub use prior::{PriorError, PriorRuns};
pub use recording::{About, Added, Knob, Measure, MeasureKind, PartKind, RecordedFrame, RecordedPart, RecordingError};
pub use recording::{Recorder, Recording, Series, SeriesKind};
pub use recording::{SimulationRecorder, Subject, costs_of_added_effects};
pub use step::{StepQuestion, StepSummary};
pub use tangles::{FileReport, MeshCheck, intersections_csv, intersections_json, mesh_checks, mesh_checks_json};
pub use tangles::{coloured_ply, crossing_triangles, intersecting_triangles, start_sentences, tangled_start_json};
pub use truths::truths_html;

use crate::methods::Stage;
use crate::study::{ComparisonRow, MeanCounts, ScalingPoint};

/// Returns the primitive pairs of a method before any culling test, if it distributes triangle pairs.
fn distributed(row: &ComparisonRow) -> Option<MeanCounts> {
    let stage = row.stages.iter().find(|stage| stage.stage == Stage::Distribution);
    stage.map(|stage| stage.survivors)
}

/// Writes the size, such as `693 vertices, 2,038 edges, 1,345 triangles`.
fn mesh_size(vertices: usize, edges: usize, triangles: usize) -> String {
    let [vertices, edges, triangles] = [vertices, edges, triangles].map(number::grouped);
    format!("{vertices} vertices, {edges} edges, {triangles} triangles")
}

/// Returns an effect's name in ordinary spelling, without underscores.
fn label(name: &str) -> String {
    name.replace("self_collision", "self-collision").replace('_', " ")
}

/// Writes a value with its unit in print: `15 µN·m` for `15 uN m`.
fn printed(value: &str) -> String {
    value.replace("uN", "µN").replace("N m", "N·m").replace("m2", "m²")
}

/// Replaces control characters, which XML and HTML cannot hold and a file's name may contain.
fn printable(text: &str) -> String {
    text.replace(|c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'), "\u{fffd}")
}

/// Returns each size's time for a step divided by n log n, relative to the first size's. A cost of n log n gives 1 throughout.
fn n_log_n_ratios(points: &[ScalingPoint]) -> Vec<f64> {
    let cost = |point: &ScalingPoint| {
        let n = point.triangles as f64;
        point.step.seconds / (n * n.ln())
    };
    let first = points.first().map_or(1.0, cost);
    points.iter().map(|point| cost(point) / first).collect()
}
