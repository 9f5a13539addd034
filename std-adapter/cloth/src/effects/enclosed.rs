//! Closed cloths: whether a cloth is closed, and its volume.

use selvedge::{Mesh, Topology};

/// Returns the volume in m³ of a closed mesh, V = ⅙Σ a·(b × c). It is relative to the first vertex, so that it does not depend on
/// the place of the mesh. It is negative if the triangles face inwards.
pub(super) fn volume(mesh: &Mesh) -> f64 {
    let origin = mesh.positions[0];
    let parts = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize] - origin);
        a.dot(b.cross(c))
    });
    parts.sum::<f64>() / 6.0
}

/// Returns the number of open edges of a cloth; zero if it is closed.
pub(super) fn open_edges(topology: &Topology) -> usize {
    let statistics = topology.statistics();
    statistics.boundary_edges + statistics.non_manifold_edges
}
