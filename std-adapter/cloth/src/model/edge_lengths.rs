//! The lengths of a mesh's edges, over those at rest.

use super::triangle_edges::{edges_of, once_each};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

/// The edges of triangles, each with the inverse square of its largest length.
#[derive(Debug)]
pub(crate) struct Lengths(Vec<([u32; 2], f64)>);

impl Lengths {
    /// Finds the edges of a mesh at rest, which may become `limit` times as long.
    pub(crate) fn new(mesh: &Mesh, limit: f64) -> Self {
        let Mesh { positions, triangles } = mesh;
        let longest = |edge: [u32; 2]| {
            let [a, b] = edge.map(|vertex| positions[vertex as usize]);
            (edge, (a.distance_squared(b) * limit * limit).recip())
        };
        Self(once_each(edges_of(triangles)).into_iter().map(longest).collect())
    }

    /// Returns the largest ratio of a length to its limit.
    pub(crate) fn largest(&self, positions: &[DVec3]) -> f64 {
        let over =
            |&([a, b], per_square): &([u32; 2], f64)| positions[a as usize].distance_squared(positions[b as usize]) * per_square;
        // A comparison is one instruction, and `f64::max` several.
        let largest = self
            .0
            .iter()
            .map(over)
            .fold(0.0, |largest, over| if over > largest { over } else { largest });
        largest.sqrt()
    }
}
