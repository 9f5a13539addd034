//! Reasons for refusing a list of triangles.

use super::edges::MAX_TRIANGLES;
use std::fmt;

/// The reason why a list of triangles has no [`Topology`](crate::Topology).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TopologyError {
    /// A triangle names a vertex that does not exist.
    VertexOutOfRange {
        /// The first such triangle.
        triangle: usize,
        /// The vertex that it names.
        vertex: u32,
        /// The number of vertices.
        vertex_count: usize,
    },
    /// A loose edge, or a point, names a vertex that does not exist.
    LooseVertexOutOfRange {
        /// The first such edge or point in its list.
        index: usize,
        /// True for a point.
        is_point: bool,
        /// The vertex that it names.
        vertex: u32,
        /// The number of vertices.
        vertex_count: usize,
    },
    /// There are no triangles, and no loose edges or points.
    NoTriangles,
    /// Vertices, or the corners of all triangles, are too many to be numbered by a `u32`.
    TooLarge {
        /// The number of vertices.
        vertex_count: usize,
        /// The number of triangles.
        triangle_count: usize,
    },
}

impl fmt::Display for TopologyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::VertexOutOfRange {
                triangle,
                vertex,
                vertex_count,
            } => write!(
                f,
                "triangle {triangle} names vertex {vertex}, but there are {vertex_count} vertices, numbered from 0"
            ),
            Self::LooseVertexOutOfRange {
                index,
                is_point,
                vertex,
                vertex_count,
            } => write!(
                f,
                "{} {index} names vertex {vertex}, but there are {vertex_count} vertices, numbered from 0",
                if is_point { "point" } else { "loose edge" }
            ),
            Self::NoTriangles => f.write_str("the mesh has no triangles"),
            Self::TooLarge {
                vertex_count,
                triangle_count,
            } => write!(
                f,
                "the mesh has {vertex_count} vertices and {triangle_count} triangles: more than {} vertices or {} triangles cannot be numbered",
                u32::MAX,
                MAX_TRIANGLES
            ),
        }
    }
}

impl std::error::Error for TopologyError {}
