//! The features of a pair: vertices, edges, faces.

/// The two features of a [pair](crate::Topology::features_of), numbered as by the [`Topology`](crate::Topology).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FeaturePair {
    /// A vertex and a point.
    VertexVertex {
        /// The vertex, and the point's vertex.
        vertices: [u32; 2],
    },
    /// A vertex and a loose edge.
    VertexEdge {
        /// The vertex.
        vertex: u32,
        /// The edge.
        edge: u32,
    },
    /// A vertex and a triangle.
    VertexFace {
        /// The vertex.
        vertex: u32,
        /// The face.
        face: u32,
    },
    /// Two edges, of triangles or loose.
    EdgeEdge {
        /// The edges, the smaller number first.
        edges: [u32; 2],
    },
}
