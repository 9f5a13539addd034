//! Distributes a candidate triangle pair to its primitive pairs: at most 6 vertex–face and 9 edge–edge.
//!
//! The rules are the paper's, with its misprints corrected. They pair each vertex that A represents with face B, each vertex that
//! B represents with face A, and each edge of A with each edge of B. If every vertex and edge is represented exactly once, no
//! primitive pair is distributed twice over all triangle pairs. Each one is distributed if the triangle pairs include every two
//! triangles whose boxes overlap, *adjacent ones included*. Reason: a triangle's swept box contains those of its vertices and
//! edges.
//!
//! Primitive pairs that share a vertex are skipped: they touch at every time, and no step could resolve them.

use crate::features::{FeatureTriangle, Features};
use arrayvec::ArrayVec;

/// The primitive pairs of one candidate triangle pair.
#[derive(Clone, Debug, Default)]
pub struct Distribution<I> {
    /// Vertex and face.
    pub vertex_face: ArrayVec<[I; 2], 6>,
    /// An edge of the first triangle and an edge of the second.
    pub edge_edge: ArrayVec<[I; 2], 9>,
}

/// Distributes a candidate triangle pair by the features that each triangle represents.
///
/// ```
/// use selvedge_core::{distribution::distribute, FeatureEdge, FeatureTriangle, Features};
/// let triangle = |face: u32, [a, b, c]: [u32; 3]| FeatureTriangle {
///     face,
///     vertices: [a, b, c],
///     edges: [[a, b], [b, c], [c, a]].map(|ends| FeatureEdge { edge: ends[0], ends }),
///     features: Features::ALL,
/// };
/// let apart = distribute(&triangle(0, [0, 1, 2]), &triangle(1, [3, 4, 5]));
/// assert_eq!((apart.vertex_face.len(), apart.edge_edge.len()), (6, 9));
/// // Across a common edge, only two vertices face a triangle that they do not belong to,
/// // and each of the two outer edges of one side meets one of the other.
/// let adjacent = distribute(&triangle(0, [0, 1, 2]), &triangle(1, [2, 1, 3]));
/// assert_eq!((adjacent.vertex_face.len(), adjacent.edge_edge.len()), (2, 2));
/// ```
#[inline]
#[must_use]
pub fn distribute<I: Copy + PartialEq>(a: &FeatureTriangle<I>, b: &FeatureTriangle<I>) -> Distribution<I> {
    let mut pairs = Distribution {
        vertex_face: ArrayVec::new(),
        edge_edge: ArrayVec::new(),
    };
    if !Features::are_compatible(a.features, b.features) {
        return pairs;
    }
    for (from, face) in [(a, b), (b, a)] {
        for &vertex in from.vertices.iter().take(from.features.vertices()) {
            if !face.vertices.contains(&vertex) {
                // The vector is never full, with at most 3 + 3. `push` would add a panic path.
                let _ = pairs.vertex_face.try_push([vertex, face.face]);
            }
        }
    }
    for first in a.edges.iter().take(a.features.edges()) {
        for second in b.edges.iter().take(b.features.edges()) {
            let share = |end| second.ends[0] == end || second.ends[1] == end;
            if !share(first.ends[0]) && !share(first.ends[1]) {
                // The vector is never full, with at most 3 × 3.
                let _ = pairs.edge_edge.try_push([first.edge, second.edge]);
            }
        }
    }
    pairs
}
