//! Writes tables for other programs.

use super::distributed;
use super::paper::paper_row;
use crate::methods::Stage;
use crate::pipeline::Contact;
use crate::study::{Comparison, ComparisonRow, MeanCounts};
use ::csv::Writer;
use selvedge::PairKind;
use selvedge::Topology;
use selvedge_core::Scalar;
use std::io::{self, Write};

/// The stages with a column of seconds, in the order of the data flow.
const STAGES: [(Stage, &str); 6] = [
    (Stage::Distribution, "distribution_seconds"),
    (Stage::Boxes, "boxes_seconds"),
    (Stage::RelativeBoxes, "relative_boxes_seconds"),
    (Stage::Subspace, "subspace_seconds"),
    (Stage::NonCoplanarity, "non_coplanarity_seconds"),
    (Stage::Elementary, "elementary_seconds"),
];

/// Writes a comparison, one row for each method. Counts are means per step, times are seconds per step. The last three columns
/// have the paper's own numbers for the methods in its Table 1. A field is empty if the method lacks the value.
///
/// # Errors
/// Returns the errors of `out`.
pub fn comparison_csv(comparison: &Comparison, out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    let mut header = vec!["pipeline", "reconstructed", "triangle_pairs"];
    header.extend(["vf_distributed", "vf_after_boxes", "vf_after_filter"]);
    header.extend(["vf_contacts", "ee_distributed", "ee_after_boxes"]);
    header.extend(["ee_after_filter", "ee_contacts", "frames_per_second"]);
    header.extend(["vf_missed", "ee_missed", "broad_phase_seconds"]);
    header.extend(STAGES.map(|(_, column)| column));
    header.extend(["paper_vf", "paper_ee", "paper_frames_per_second"]);
    writer.write_record(header)?;
    for row in &comparison.rows {
        writer.write_record(comparison_record(row))?;
    }
    writer.flush()
}

fn comparison_record(row: &ComparisonRow) -> Vec<String> {
    let distributed = distributed(row);
    let survivors = [row.after_boxes, row.candidates, row.contacts].map(Some);
    let survivors = std::iter::once(distributed).chain(survivors);
    let of_kind = |pick: fn(&MeanCounts) -> f64| {
        let text = move |counts: Option<MeanCounts>| counts.map_or_else(String::new, |counts| pick(&counts).to_string());
        survivors.clone().map(text)
    };
    let mut record = vec![
        row.preset.to_string(),
        row.preset.is_reconstructed().to_string(),
        if row.has_triangle_pairs {
            row.triangle_pairs.to_string()
        } else {
            String::new()
        },
    ];
    record.extend(of_kind(|counts| counts.vertex_face));
    record.extend(of_kind(|counts| counts.edge_edge));
    record.push(row.frames_per_second.to_string());
    record.push(row.missed.vertex_face.to_string());
    record.push(row.missed.edge_edge.to_string());
    record.push(row.broad_phase_seconds.to_string());
    record.extend(STAGES.map(|(wanted, _)| {
        let stage = row.stages.iter().find(|stage| stage.stage == wanted);
        stage.map_or_else(String::new, |stage| stage.seconds.to_string())
    }));
    match paper_row(row.preset) {
        None => record.extend([(); 3].map(|()| String::new())),
        Some(paper) => record.extend([
            paper.vertex_face.to_string(),
            paper.edge_edge.to_string(),
            paper.frames_per_second.to_string(),
        ]),
    }
    record
}

/// Writes contacts as `kind,i0,i1,i2,i3,time`: vertex–face first, each kind in the order given. For VF, i0 is the vertex and i1
/// to i3 are the face's. For EE, i0, i1 and i2, i3 are the two edges. Vertices count from 0 as in the mesh's file. Times are in
/// [0, 1] of the step; as `f64` they read back exactly.
///
/// # Errors
/// Returns the errors of `out`.
pub fn contacts_csv<S: Scalar>(topology: &Topology, contacts: &[Contact<S>], out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    writer.write_record(["kind", "i0", "i1", "i2", "i3", "time"])?;
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        for contact in contacts.iter().filter(|contact| contact.kind == kind) {
            let vertices = topology.vertices_of(kind, contact.pair);
            // The time is written as an `f64`: the shortest text of an `f32`, read as an `f64`, may be later than the contact.
            writer.serialize((kind.name(), vertices, contact.time.to_f64().to_string()))?;
        }
    }
    writer.flush()
}

/// Writes pairs as `kind,i0,i1,i2,i3`, like [`contacts_csv`] without times.
///
/// # Errors
/// Returns the errors of `out`.
pub fn pairs_csv(topology: &Topology, vertex_face: &[[u32; 2]], edge_edge: &[[u32; 2]], out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    writer.write_record(["kind", "i0", "i1", "i2", "i3"])?;
    for (kind, pairs) in [(PairKind::VertexFace, vertex_face), (PairKind::EdgeEdge, edge_edge)] {
        for &pair in pairs {
            writer.serialize((kind.name(), topology.vertices_of(kind, pair)))?;
        }
    }
    writer.flush()
}
