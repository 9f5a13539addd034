//! The results of a step.

use selvedge_core::PairKind;

/// A pair that may touch during the step, with the time of its contact.
///
/// The detector's [`Criterion`](crate::Criterion) defines a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<S> {
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
    /// The vertex and the face, or the two edges, as the [`Topology`](crate::Topology) numbers them.
    /// [`features_of`](crate::Topology::features_of) says whether the face is a loose edge or a point.
    pub pair: [u32; 2],
    /// The time in [0, 1] of the step. It is never after the exact time, and hardly before it: see [how
    /// early](crate::CollisionDetector::earliest).
    pub time: S,
}

/// The result of a [truncated](crate::CollisionDetector::truncate) step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Truncation {
    /// The number of vertices that stop short of their wanted positions.
    pub held_back: usize,
    /// The number of pairs that are in contact at the start, by the detector's criterion. Their vertices rest. If it is zero, the
    /// step is certainly free of contact.
    pub in_contact: usize,
    /// The number of searches for contacts.
    pub rounds: usize,
}

/// Two primitives of a mesh at rest that have a point in common, but no vertex. The [`Topology`](crate::Topology) numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Intersection {
    /// An edge passes through a face, or touches it.
    EdgeFace {
        /// The edge.
        edge: u32,
        /// The face.
        face: u32,
    },
    /// A vertex touches a face that has an edge in common with a triangle of the vertex: the two are folded flat onto each other.
    /// This also stands for a [loose point](crate::Topology::with_loose_features) that touches a face, edge or point.
    VertexFace {
        /// The vertex.
        vertex: u32,
        /// The face.
        face: u32,
    },
    /// Two edges touch whose triangles have a common edge and are folded flat onto each other.
    EdgeEdge {
        /// The edges, the smaller number first.
        edges: [u32; 2],
    },
}
