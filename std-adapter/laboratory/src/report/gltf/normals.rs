//! Which way a surface faces at its vertices.

use selvedge_core::glam::DVec3;

/// The mean direction of the triangles at each vertex, weighted by area, of length one; `fallback` where they have none.
pub(super) fn vertex_normals(positions: &[[f32; 3]], triangles: &[[u32; 3]], fallback: DVec3) -> Vec<[f32; 3]> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|vertex| DVec3::from(positions[vertex as usize].map(f64::from)));
        let [a, b, c] = corners;
        let area = (b - a).cross(c - a);
        for &vertex in triangle {
            sums[vertex as usize] += area;
        }
    }
    let unit = |sum: DVec3| sum.try_normalize().unwrap_or(fallback);
    sums.into_iter()
        .map(|sum| unit(sum).to_array().map(|number| number as f32))
        .collect()
}
