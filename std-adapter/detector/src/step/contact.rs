//! What a step finds.

use crate::PairKind;

/// A pair for which contact during the step is not excluded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<S> {
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
    /// The vertex and the face, or the two edges, as numbered by the [`Topology`]. [It tells](Topology::features_of) whether the face is a
    /// loose edge or a point.
    pub pair: [u32; 2],
    /// When, in [0, 1] of the step: not after the exact time, and hardly before it ([how early](CollisionDetector::earliest)).
    pub time: S,
}

/// What came of a step that was [truncated](crate::CollisionDetector::truncate).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Truncation {
    /// Vertices that go less than the whole of their way.
    pub held_back: usize,
    /// Pairs that are in contact at the start already, by the detector's criterion. Their vertices rest. Where there are none, the
    /// step is certainly free of contact.
    pub in_contact: usize,
    /// How often contacts were looked for.
    pub rounds: usize,
}

/// Two primitives of a mesh at rest that have a point in common, and no vertex. Numbered as by the [`Topology`](crate::Topology).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Intersection {
    /// An edge passes through a face, or touches it.
    EdgeFace {
        /// The edge.
        edge: u32,
        /// The face.
        face: u32,
    },
    /// A vertex touches a face of which an edge belongs to a triangle of the vertex: they are folded flat onto each other. Or a
    /// [loose point](crate::Topology::with_loose_features) touches a face, edge or point.
    VertexFace {
        /// The vertex.
        vertex: u32,
        /// The face.
        face: u32,
    },
    /// Two edges touch that belong to triangles with a common edge: they are folded flat onto each other.
    EdgeEdge {
        /// The edges, the smaller number first.
        edges: [u32; 2],
    },
}
