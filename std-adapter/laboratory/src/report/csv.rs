//! Writes tables for other programs.

use crate::pipeline::Contact;
use ::csv::Writer;
use selvedge::PairKind;
use selvedge::Topology;
use selvedge_core::Scalar;
use std::io::{self, Write};

/// Writes contacts as `kind,i0,i1,i2,i3,time`: vertex–face first, each kind in the order given. For VF, i0 is the vertex and i1
/// to i3 are the face's. For EE, i0, i1 and i2, i3 are the two edges. Vertices count from 0 as in the mesh's file. Times are in
/// [0, 1] of the step; as `f64` they read back exactly.
///
/// # Errors
/// Returns the errors of `out`.
pub fn contacts_csv<S: Scalar>(topology: &Topology, contacts: &[Contact<S>], out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    writer.write_record(["kind", "i0", "i1", "i2", "i3", "time"])?;
    for kind in PairKind::ALL {
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
