//! What `--json` prints: names are lower case with underscores, values lower case with hyphens, times are seconds
//! unless the name says nanoseconds.

use super::distributed;
use super::findings::findings;
use super::paper::paper_row;
use super::step::StepSummary;
use crate::pipeline::{PairCounts, Stage, StepReport};
use crate::study::{Comparison, ComparisonRow, MeanCounts};
use serde_json::{Value, json};

/// One step: `selvedge cull`.
#[must_use]
pub fn step(summary: &StepSummary) -> Value {
    let contacts = summary.report.contacts();
    json!({
        "pipeline": summary.preset.name(),
        "scalar": summary.scalar,
        "vertices": summary.vertices,
        "edges": summary.edges,
        "triangles": summary.triangles,
        "threads": summary.threads,
        "stages": step_stages(&summary.report),
        "contacts": {
            "vertex_face": contacts.vertex_face,
            "edge_edge": contacts.edge_edge,
            "earliest": summary.earliest,
        },
        "seconds": summary.report.seconds,
    })
}

fn step_stages(report: &StepReport) -> Vec<Value> {
    let mut stages = vec![json!({
        "stage": Stage::BroadPhase.name(),
        "triangle_pairs": report.triangle_pairs,
        "seconds": report.broad_phase_seconds,
    })];
    stages.extend(report.stages.iter().map(|stage| {
        let PairCounts {
            vertex_face,
            edge_edge,
        } = stage.survivors;
        json!({
            "stage": stage.stage.name(),
            "vertex_face": vertex_face,
            "edge_edge": edge_edge,
            "seconds": stage.seconds,
        })
    }));
    stages
}

/// Every method on the same steps: `selvedge compare`.
#[must_use]
pub fn comparison(comparison: &Comparison) -> Value {
    json!({
        "scene": comparison.name,
        "vertices": comparison.vertices,
        "edges": comparison.edges,
        "triangles": comparison.triangles,
        "steps": comparison.steps,
        "threads": comparison.threads,
        "rounds": comparison.rounds,
        "rows": comparison.rows.iter().map(comparison_row).collect::<Vec<_>>(),
        "findings": findings(comparison)
            .iter()
            .map(|finding| json!({"text": finding.text, "as_expected": finding.as_expected}))
            .collect::<Vec<_>>(),
    })
}

fn comparison_row(row: &ComparisonRow) -> Value {
    let kind = |pick: fn(&MeanCounts) -> f64| {
        json!({
            "distributed": pick(&distributed(row)),
            "after_boxes": pick(&row.after_boxes),
            "after_filter": pick(&row.candidates),
            "contacts": pick(&row.contacts),
        })
    };
    json!({
        "pipeline": row.preset.name(),
        "reconstructed": row.preset.is_reconstructed(),
        "vertex_face": kind(|counts| counts.vertex_face),
        "edge_edge": kind(|counts| counts.edge_edge),
        // Nothing decides exactly yet which pairs truly touch.
        "missed": Value::Null,
        "frames_per_second": row.frames_per_second,
        "stages": comparison_stages(row),
        "paper": paper_row(row.preset).map(|paper| json!({
            "row": paper.label,
            "vertex_face": paper.vertex_face,
            "edge_edge": paper.edge_edge,
            "frames_per_second": paper.frames_per_second,
        })),
    })
}

fn comparison_stages(row: &ComparisonRow) -> Vec<Value> {
    let mut stages = vec![json!({
        "stage": Stage::BroadPhase.name(),
        "triangle_pairs": row.triangle_pairs,
        "seconds": row.broad_phase_seconds,
    })];
    stages.extend(row.stages.iter().map(|stage| {
        json!({
            "stage": stage.stage.name(),
            "vertex_face": stage.survivors.vertex_face,
            "edge_edge": stage.survivors.edge_edge,
            "seconds": stage.seconds,
        })
    }));
    stages
}
