//! Sources of candidates.

use super::listed_pairs::PrimitiveBoxes;
use super::numbering::Numbering;
use super::question::Question;
use crate::broad_phase::{Hierarchies, Pairing, RowSlices};
use crate::simd::Level;
use selvedge_core::PairKind;

/// Candidates of one kind, and the question about them.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(super) candidates: Candidates<'a>,
    pub(super) level: Level,
    /// Translates the numbers of candidates.
    pub(super) numbering: Numbering<'a>,
    pub(super) rows: RowSlices<'a>,
    pub(super) question: Question,
}

#[derive(Clone, Copy)]
pub(super) enum Candidates<'a> {
    /// Pairs that a traversal of hierarchies finds, by their positions in the trees.
    Traversed(Pairing<'a>),
    /// Pairs of one kind from a list, as the mesh numbers them: those that the boxes leave, if there are any.
    Listed {
        kind: PairKind,
        pairs: &'a [[u32; 2]],
        boxes: Option<&'a PrimitiveBoxes>,
    },
}

impl<'a> Source<'a> {
    /// Returns the sources of a mesh that meets itself: VF, EE.
    pub(crate) fn within(hierarchies: &'a Hierarchies, question: Question) -> [Self; 2] {
        Pairing::all_within(hierarchies).map(|pairing| Self {
            candidates: Candidates::Traversed(pairing),
            level: hierarchies.level(),
            numbering: Numbering::Positions(hierarchies),
            rows: hierarchies.rows().slices(),
            question,
        })
    }

    /// Returns the source of a pairing of two meshes, whose rows begin at `first_rows`.
    pub(crate) fn between(pairing: Pairing<'a>, rows: RowSlices<'a>, first_rows: [u32; 2], question: Question) -> Self {
        Self {
            candidates: Candidates::Traversed(pairing),
            level: pairing.meshes[0].level(),
            numbering: Numbering::Between(pairing, first_rows),
            rows,
            question,
        }
    }

    /// Returns the sources of lists of pairs, VF and EE; `rows` are in the order of the mesh's vertices.
    pub(super) fn listed(
        hierarchies: &'a Hierarchies,
        rows: RowSlices<'a>,
        question: Question,
        [vertex_face, edge_edge]: [&'a [[u32; 2]]; 2],
        boxes: Option<&'a PrimitiveBoxes>,
    ) -> [Self; 2] {
        [(PairKind::VertexFace, vertex_face), (PairKind::EdgeEdge, edge_edge)].map(|(kind, pairs)| Self {
            candidates: Candidates::Listed { kind, pairs, boxes },
            level: hierarchies.level(),
            numbering: Numbering::Mesh(hierarchies.topology()),
            rows,
            question,
        })
    }

    pub(super) fn kind(&self) -> PairKind {
        match self.candidates {
            Candidates::Traversed(pairing) => pairing.kind,
            Candidates::Listed { kind, .. } => kind,
        }
    }
}
