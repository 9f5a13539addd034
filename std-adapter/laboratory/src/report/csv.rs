//! Writes tables for other programs.

use super::distributed;
use super::paper::paper_row;
use crate::methods::Stage;
use crate::pipeline::Contact;
use crate::study::{Comparison, ComparisonRow};
use ::csv::Writer;
use selvedge::PairKind;
use selvedge::Topology;
use selvedge_core::Scalar;
use std::io::{self, Write};

/// A column and its field, empty where the method lacks it.
type Column = (&'static str, fn(&ComparisonRow) -> Option<String>);

/// The pairs after a stage, and the seconds of a stage.
macro_rules! field {
    ($row:ident.$counts:ident.$kind:ident) => {
        |$row| Some($row.$counts.$kind.to_string())
    };
    (seconds of $stage:ident) => {
        |row| {
            Some(
                row.stages
                    .iter()
                    .find(|report| report.stage == Stage::$stage)?
                    .seconds
                    .to_string(),
            )
        }
    };
}

const COLUMNS: [Column; 24] = [
    ("pipeline", |row| Some(row.preset.to_string())),
    ("reconstructed", |row| Some(row.preset.is_reconstructed().to_string())),
    ("triangle_pairs", |row| {
        row.has_triangle_pairs.then(|| row.triangle_pairs.to_string())
    }),
    ("vf_distributed", |row| Some(distributed(row)?.vertex_face.to_string())),
    ("vf_after_boxes", field!(row.after_boxes.vertex_face)),
    ("vf_after_filter", field!(row.candidates.vertex_face)),
    ("vf_contacts", field!(row.contacts.vertex_face)),
    ("ee_distributed", |row| Some(distributed(row)?.edge_edge.to_string())),
    ("ee_after_boxes", field!(row.after_boxes.edge_edge)),
    ("ee_after_filter", field!(row.candidates.edge_edge)),
    ("ee_contacts", field!(row.contacts.edge_edge)),
    ("frames_per_second", |row| Some(row.frames_per_second.to_string())),
    ("vf_missed", field!(row.missed.vertex_face)),
    ("ee_missed", field!(row.missed.edge_edge)),
    ("broad_phase_seconds", |row| Some(row.broad_phase_seconds.to_string())),
    ("distribution_seconds", field!(seconds of Distribution)),
    ("boxes_seconds", field!(seconds of Boxes)),
    ("relative_boxes_seconds", field!(seconds of RelativeBoxes)),
    ("subspace_seconds", field!(seconds of Subspace)),
    ("non_coplanarity_seconds", field!(seconds of NonCoplanarity)),
    ("elementary_seconds", field!(seconds of Elementary)),
    ("paper_vf", |row| Some(paper_row(row.preset)?.vertex_face.to_string())),
    ("paper_ee", |row| Some(paper_row(row.preset)?.edge_edge.to_string())),
    ("paper_frames_per_second", |row| {
        Some(paper_row(row.preset)?.frames_per_second.to_string())
    }),
];

/// Writes a comparison, one row for each method. Counts are means per step, times are seconds per step. The last three columns
/// have the paper's own numbers for the methods in its Table 1. A field is empty if the method lacks the value.
///
/// # Errors
/// Returns the errors of `out`.
pub fn comparison_csv(comparison: &Comparison, out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    writer.write_record(COLUMNS.map(|(name, _)| name))?;
    for row in &comparison.rows {
        writer.write_record(COLUMNS.map(|(_, field)| field(row).unwrap_or_default()))?;
    }
    writer.flush()
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
