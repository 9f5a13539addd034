//! Meshes of simple shapes. They have the same bits on every platform, since `libm` computes their sines.

use crate::input::{LARGEST_COORDINATE, ValueError};
use libm::{cos, sin};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Makes a parallelogram with a corner and two sides, in `cells` along each. Diagonals alternate, so that no direction is
/// favoured.
///
/// Vertices are numbered row by row along the first side.
pub(crate) fn sheet(corner: DVec3, sides: [DVec3; 2], cells: [u32; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    let [columns, rows] = cells;
    for row in 0..=rows {
        for column in 0..=columns {
            let [s, t] = [(column, columns), (row, rows)].map(|(k, n)| f64::from(k) / f64::from(n));
            mesh.positions.push(corner + sides[0] * s + sides[1] * t);
        }
    }
    let at = |column: u32, row: u32| row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [at(column, row), at(column + 1, row)];
            let [c, d] = [at(column, row + 1), at(column + 1, row + 1)];
            mesh.triangles.extend(if (row + column) % 2 == 0 {
                [[a, b, d], [a, d, c]]
            } else {
                [[a, b, c], [b, d, c]]
            });
        }
    }
    mesh
}

/// Joins rings of vertices into a tube; each ring is turned by half a vertex against the one before. `rings` holds for each ring
/// its place along `axis` and its radius. Triangles turn anticlockwise seen from outside.
fn rings(origin: DVec3, axis: DVec3, around: u32, rings: impl IntoIterator<Item = (f64, f64)>) -> Mesh {
    let side = axis.any_orthonormal_vector();
    let other = axis.cross(side);
    let mut mesh = Mesh::default();
    let mut count = 0_u32;
    for (along, radius) in rings {
        for point in 0..around {
            let angle = TAU * f64::from(2 * point + count % 2) / f64::from(2 * around);
            let outward = side * cos(angle) + other * sin(angle);
            mesh.positions.push(origin + axis * along + outward * radius);
        }
        count += 1;
    }
    for ring in 0..count.saturating_sub(1) {
        for point in 0..around {
            let next = (point + 1) % around;
            let [here, there] = [ring * around, (ring + 1) * around];
            let [a, b, c, d] = [here + point, here + next, there + point, there + next];
            mesh.triangles.extend(if ring % 2 == 0 {
                [[a, b, c], [b, d, c]]
            } else {
                [[a, b, d], [a, d, c]]
            });
        }
    }
    mesh
}

/// Makes an open tube between two points, with `cells` around and along it.
pub(crate) fn tube([from, to]: [DVec3; 2], radius: f64, cells: [u32; 2]) -> Mesh {
    let length = from.distance(to);
    let axis = (to - from) / length;
    let [around, along] = cells;
    let ring = |k: u32| (length * f64::from(k) / f64::from(along), radius);
    rings(from, axis, around, (0..=along).map(ring))
}

/// Makes a capsule: all points within `radius` of a line between two points; a ball if they are equal. Its vertices lie on the
/// capsule's surface, its triangles a little inside.
pub(crate) fn capsule([from, to]: [DVec3; 2], radius: f64, around: u32) -> Mesh {
    let length = from.distance(to);
    let axis = (to - from).try_normalize().unwrap_or(DVec3::Z);
    let quarter = (around / 4).max(2);
    let pitch = TAU * radius / f64::from(around);
    let steps = (length / pitch).ceil().clamp(0.0, 1e4) as u32;
    let cap = |k: u32| FRAC_PI_2 * f64::from(k) / f64::from(quarter);
    let first = (1..=quarter).map(|k| (-radius * cos(cap(k)), radius * sin(cap(k))));
    let middle = (1..steps).map(|k| (length * f64::from(k) / f64::from(steps), radius));
    // A ball has one equator.
    let last = u32::from(steps == 0);
    let last = (1..=quarter - last)
        .rev()
        .map(|k| (length + radius * cos(cap(k)), radius * sin(cap(k))));
    let mut mesh = rings(from, axis, around, first.chain(middle).chain(last));
    let ring_count = mesh.positions.len() as u32 / around;
    let [start, end] = [ring_count * around, ring_count * around + 1];
    mesh.positions.push(from - axis * radius);
    mesh.positions.push(to + axis * radius);
    let outermost = (ring_count - 1) * around;
    for point in 0..around {
        let next = (point + 1) % around;
        mesh.triangles.push([start, next, point]);
        mesh.triangles.push([end, outermost + point, outermost + next]);
    }
    mesh
}

/// Checks that coordinates are in range, and that triangles name existing vertices.
pub(super) fn check(mesh: &Mesh) -> Result<(), ValueError> {
    let is_near = |p: &DVec3| p.abs().cmple(DVec3::splat(LARGEST_COORDINATE)).all();
    if let Some(far) = mesh.positions.iter().find(|p| !is_near(p)) {
        // Not with three hundred digits.
        let [x, y, z] = far
            .to_array()
            .map(|x| if x.abs() < 1e7 { format!("{x}") } else { format!("{x:.3e}") });
        let message = format!("the mesh has a vertex at [{x}, {y}, {z}], beyond {LARGEST_COORDINATE} metres");
        return Err(ValueError::new("mesh", message));
    }
    let count = mesh.positions.len();
    match mesh.triangles.iter().flatten().find(|&&vertex| vertex as usize >= count) {
        None => Ok(()),
        Some(vertex) => {
            let message = format!("a triangle of the mesh names the vertex {vertex}, but there are {count}, numbered from 0");
            Err(ValueError::new("mesh", message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns six times the volume that a mesh encloses.
    fn enclosed(mesh: &Mesh) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
        let parts = mesh.triangles.iter().map(corners);
        parts.map(|[a, b, c]| a.dot(b.cross(c))).sum()
    }

    #[test]
    fn a_sheet_has_two_triangles_a_cell_all_facing_the_same_way() {
        let mesh = sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [3, 2]);
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (12, 12));
        assert!(mesh.triangles.iter().all(|t| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            (b - a).cross(c - a).z > 0.0
        }));
        assert_eq!(mesh.topology().unwrap().statistics().boundary_edges, 10);
    }

    #[test]
    fn a_tube_is_open_at_both_ends_and_faces_outwards() {
        let mesh = tube([DVec3::ZERO, DVec3::Z], 0.1, [8, 5]);
        let statistics = mesh.topology().unwrap().statistics();
        assert_eq!((statistics.boundary_edges, statistics.components), (16, 1));
        assert!(mesh.triangles.iter().all(|t| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            (b - a).cross(c - a).dot((a + b + c).with_z(0.0)) > 0.0
        }));
    }

    #[test]
    fn capsules_and_balls_are_closed_face_outwards_and_enclose_nearly_their_volume() {
        for length in [0.0, 0.5] {
            let ends = [DVec3::X, DVec3::X + length * DVec3::Y];
            let mesh = capsule(ends, 0.2, 32);
            let statistics = mesh.topology().unwrap().statistics();
            assert_eq!((statistics.boundary_edges, statistics.components), (0, 1));
            assert_eq!(statistics.non_manifold_edges, 0);
            let exact = TAU / 2.0 * 0.04 * (length + 4.0 / 3.0 * 0.2);
            let ratio = enclosed(&mesh) / 6.0 / exact;
            assert!((0.95..1.0).contains(&ratio), "{length}: {ratio}");
        }
    }
}
