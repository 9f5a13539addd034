//! Normals of vertices.

use selvedge_core::glam::DVec3;

/// Computes the normal of each vertex: the mean direction of its triangles, weighted by area. Replaces `normals`. Vertices
/// without triangles get zero.
///
/// ```
/// use selvedge_cloth::glam::DVec3;
///
/// let mut normals = Vec::new();
/// selvedge_cloth::vertex_normals(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]], &mut normals);
/// assert_eq!(normals, [DVec3::Z; 3]);
/// ```
///
/// # Panics
/// Panics if a triangle has a vertex that is not in `positions`.
pub fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]], normals: &mut Vec<DVec3>) {
    normals.clear();
    normals.resize(positions.len(), DVec3::ZERO);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        let area = (b - a).cross(c - a);
        for &vertex in triangle {
            normals[vertex as usize] += area;
        }
    }
    for normal in normals {
        *normal = normal.normalize_or_zero();
    }
}
