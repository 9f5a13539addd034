use super::table;
use crate::methods::Stage;
use crate::report::number::{counted, three_figures};
use crate::report::paper::printed;
use crate::report::{distributed, mesh_size};
use crate::study::{Comparison, ComparisonRow, MeanCounts};

/// Returns tables of every method on the same steps: the paper's Table 1 beside its own numbers, and each stage's survivors and
/// time.
pub fn comparison(comparison: &Comparison) -> String {
    let mut text = format!(
        "{}\n{}\n{}, {}, the fastest of {}; f64\n",
        comparison.name,
        mesh_size(comparison.vertices, comparison.edges, comparison.triangles),
        counted(comparison.steps, "step"),
        counted(comparison.threads, "thread"),
        counted(comparison.rounds, "round"),
    );
    text += "\nTable 1. Candidate pairs a step and steps a second, beside the paper's\n\n";
    text += &table_1(comparison);
    text += "\nVertex–face pairs a step, after each stage\n\n";
    text += &survivors(comparison, |counts| counts.vertex_face);
    text += "\nEdge–edge pairs a step, after each stage\n\n";
    text += &survivors(comparison, |counts| counts.edge_edge);
    text += "\nMilliseconds a step, by stage";
    text += if comparison.threads > 1 {
        " (after the broad phase: summed over threads)\n\n"
    } else {
        "\n\n"
    };
    text += &times(comparison);
    text += &notes(comparison);
    text
}

fn name(row: &ComparisonRow) -> String {
    let mark = if row.preset.is_reconstructed() { "*" } else { "" };
    format!("{}{mark}", row.preset)
}

fn table_1(comparison: &Comparison) -> String {
    let rows = comparison.rows.iter().map(|row| {
        let [vertex_face, edge_edge, frames_per_second] = printed(row.preset);
        [
            name(row),
            three_figures(row.candidates.vertex_face),
            three_figures(row.candidates.edge_edge),
            three_figures(row.frames_per_second),
            vertex_face,
            edge_edge,
            frames_per_second,
        ]
    });
    let header = [
        "method",
        "VF",
        "EE",
        "steps/s",
        "paper:\nVF",
        "paper:\nEE",
        "paper:\nframes/s",
    ];
    table(header, rows)
}

fn survivors(comparison: &Comparison, kind: fn(&MeanCounts) -> f64) -> String {
    let header = ["method", "distributed", "boxes", "filter", "contacts", "missed"];
    let rows = comparison.rows.iter().map(|row| {
        [
            name(row),
            distributed(row).map_or_else(String::new, |counts| three_figures(kind(&counts))),
            three_figures(kind(&row.after_boxes)),
            three_figures(kind(&row.candidates)),
            three_figures(kind(&row.contacts)),
            three_figures(kind(&row.missed)),
        ]
    });
    table(header, rows)
}

fn times(comparison: &Comparison) -> String {
    let header = [
        "method",
        "broad\nphase",
        "distri-\nbution",
        "boxes",
        "relative\nboxes",
        "filter",
        "elemen-\ntary",
        "step",
    ];
    let rows = comparison.rows.iter().map(|row| {
        let of = |wanted: &[Stage]| {
            let stage = row.stages.iter().find(|stage| wanted.contains(&stage.stage));
            stage.map_or_else(String::new, |stage| three_figures(1e3 * stage.seconds))
        };
        [
            name(row),
            three_figures(1e3 * row.broad_phase_seconds),
            of(&[Stage::Distribution]),
            of(&[Stage::Boxes]),
            of(&[Stage::RelativeBoxes]),
            of(&[Stage::Subspace, Stage::NonCoplanarity]),
            of(&[Stage::Elementary]),
            three_figures(1e3 * 1.0 / row.frames_per_second),
        ]
    });
    table(header, rows)
}

fn notes(comparison: &Comparison) -> String {
    let mut text = String::from("\n");
    if comparison.rows.iter().any(|row| row.preset.is_reconstructed()) {
        text += "* reconstructed: the original could not be read; no reproduction is claimed.\n";
    }
    text += "Steps a second count culling and elementary tests. The paper's frames a second\nare those of its whole simulation, on its own mesh and machine.\n";
    text
}
