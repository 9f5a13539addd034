//! The numbering of pairs: by positions in hierarchies, or by the numbers of the mesh.

use crate::broad_phase::{Hierarchies, Pairing};
use crate::mesh::Topology;
use selvedge_core::PairKind;

/// How pairs are numbered.
#[derive(Clone, Copy)]
pub(super) enum Numbering<'a> {
    /// Positions in the hierarchies.
    Positions(&'a Hierarchies),
    /// The mesh's own numbers.
    Mesh(&'a Topology),
    /// The mesh's own numbers, with rows by positions in the hierarchies.
    Placed(&'a Hierarchies),
    /// Positions of faces and edges in the hierarchies. An edge is a vertex that moves from one end to the other; its row comes
    /// after those of all vertices.
    FacesAndEdges(&'a Hierarchies),
    /// Positions in the hierarchies of two meshes, with the first row of each.
    Between(Pairing<'a>, [u32; 2]),
}

impl Numbering<'_> {
    /// Returns the rows of a pair's vertices.
    #[inline(always)]
    pub(super) fn vertices(&self, kind: PairKind, pair: [u32; 2]) -> [u32; 4] {
        match self {
            Self::Positions(hierarchies) => hierarchies.vertices(kind, pair),
            Self::Mesh(topology) => topology.vertices_of(kind, pair),
            Self::Placed(hierarchies) => {
                let vertices = hierarchies.topology().vertices_of(kind, pair);
                vertices.map(|vertex| hierarchies.position_of(vertex))
            }
            Self::FacesAndEdges(hierarchies) => {
                let [face, edge] = pair;
                let [a, b, c] = hierarchies.face_corners(face);
                [hierarchies.vertex_positions() as u32 + edge, a, b, c]
            }
            Self::Between(pairing, first_rows) => pairing.rows_of(pair, *first_rows),
        }
    }

    /// Replaces `rows` by those of many pairs of one kind.
    pub(super) fn vertices_of_all(&self, kind: PairKind, pairs: &[[u32; 2]], rows: &mut [[u32; 4]]) {
        match self {
            Self::Positions(hierarchies) => hierarchies.vertices_of_all(kind, pairs, rows),
            _ => {
                for (rows, &pair) in rows.iter_mut().zip(pairs) {
                    *rows = self.vertices(kind, pair);
                }
            }
        }
    }

    pub(super) fn in_mesh(&self, kind: PairKind, pair: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Positions(hierarchies) => hierarchies.in_mesh(kind, pair),
            Self::Mesh(_) | Self::Placed(_) => pair,
            Self::FacesAndEdges(hierarchies) => hierarchies.face_edge_in_mesh(pair),
            Self::Between(pairing, _) => pairing.in_meshes(pair),
        }
    }
}
