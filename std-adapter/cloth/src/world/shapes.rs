//! Meshes of simple shapes, and from files. Simple shapes have the same bits on every platform, since `libm` computes their
//! sines.

use super::file_mesh::{FileMesh, LEFT_OUT};
use super::keyframes::{AXIS, KEY_ANGLE, unit_axis};
use super::placement::{Placement, TRANSLATION};
use crate::input::{Field, LARGEST_COORDINATE, LENGTH, RATIO, SceneError, Table, ValueError};
use libm::{cos, sin};
use selvedge::Mesh;
use selvedge_core::glam::{DAffine3, DVec3};
use selvedge_files::mesh::{self, FileProblem, LooseMesh, MeshError, ReadOptions};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::{Path, PathBuf};

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

/// The keys of a shape "file" that say how the file is read.
pub(crate) const FILE_KEYS: [&str; 7] = ["file", "group", "scale", "unit", "rotation", "translation", WELD.name];

const SCALE: Field = Field::new("scale", RATIO, 1e-6, 1e6);
const WELD: Field = Field::new("weld", LENGTH, 0.0, 0.1);
const UNITS: [(&str, f64); 6] = [
    ("m", 1.0),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("in", 0.0254),
    ("ft", 0.3048),
];

/// Reads the triangles of the file that `file` names, with all vertices.
pub(crate) fn of_file(table: &Table<'_>) -> Result<Mesh, SceneError> {
    let (mesh, ..) = read_file(table, false)?;
    Ok(mesh)
}

pub(crate) struct ClothMesh {
    pub(crate) mesh: Mesh,
    pub(crate) loose_edges: Vec<[u32; 2]>,
    /// The number of isolated vertices, which were left out.
    pub(crate) left_out: usize,
    pub(crate) file: FileMesh,
}

/// Reads a cloth's mesh: triangles, or triangles and loose edges, at least one. Isolated vertices are left out, unless they
/// belong to loose edges that are not wanted.
pub(crate) fn cloth_of_file(table: &Table<'_>, with_loose_edges: bool) -> Result<ClothMesh, SceneError> {
    let (mut mesh, mut loose_edges, mut file) = read_file(table, true)?;
    if with_loose_edges && loose_edges.is_empty() {
        let message =
            "`linear_density` is for edges that belong to no triangle (lines `l` of an OBJ file), but the file has none";
        return Err(table.error("file", message.to_owned()));
    }
    let is_whole = with_loose_edges || loose_edges.is_empty();
    if !with_loose_edges {
        file.loose_edges.clear();
    }
    let mut left_out = 0;
    if is_whole && !(mesh.triangles.is_empty() && loose_edges.is_empty()) {
        left_out = leave_out_isolated(&mut mesh, &mut loose_edges, &mut file);
    }
    Ok(ClothMesh {
        mesh,
        loose_edges,
        left_out,
        file,
    })
}

/// Reads a file, or the group of it that `group` names, in metres and with vertices merged according to `weld`.
fn read_file(table: &Table<'_>, loose_features: bool) -> Result<(Mesh, Vec<[u32; 2]>, FileMesh), SceneError> {
    let wrong = |message: String| table.error("file", message);
    let only = table.text("group")?;
    let options = ReadOptions {
        loose_features,
        only,
        weld: None,
    };
    let LooseMesh { positions, topology, .. } = read_whole(table, "file", &path(table)?, &options)?;
    let triangles = topology.proper_triangles().to_vec();
    let mut positions = positions;
    place(&placement(table)?, &mut positions);
    let mut edges: Vec<[u32; 2]> = topology.loose_edges().collect();
    let mut mesh = Mesh { positions, triangles };
    let mut file = FileMesh::new(&mesh, &edges);
    if let Some(tolerance) = table.number(&WELD)? {
        let welded = mesh.welded(tolerance);
        let ends = |ends: [u32; 2]| ends.map(|end| welded.vertex_of[end as usize]);
        edges = edges.into_iter().map(ends).filter(|[from, to]| from != to).collect();
        file.renumber(&welded.vertex_of);
        mesh = welded.mesh;
    }
    if only.is_some() {
        leave_out_isolated(&mut mesh, &mut edges, &mut file);
    }
    check(&mesh).map_err(|error| wrong(error.message))?;
    Ok((mesh, edges, file))
}

/// Reads a mesh file, which the value of `key` names. Refuses one of which something with an area cannot be read.
pub(super) fn read_whole(table: &Table<'_>, key: &str, path: &Path, options: &ReadOptions<'_>) -> Result<LooseMesh, SceneError> {
    let read = mesh::read_from(table.files(), path, options).map_err(|error| match &error {
        MeshError::File {
            problem: FileProblem::NoSuchGroup { .. } | FileProblem::NoGroups,
            ..
        } => table.error("group", error.to_string()),
        _ => table.error(key, error.to_string()),
    })?;
    match read.notes.missing() {
        None => Ok(read),
        Some(missing) => {
            let file = path.display();
            let message = format!("{file}: not all of the file can be read: {missing}; export it as plain triangles");
            Err(table.error(key, message))
        }
    }
}

/// Reads the way from the positions of a file to those of the scene, in metres: `unit` and `scale`, then `rotation`, then `translation`.
pub(super) fn placement(table: &Table<'_>) -> Result<DAffine3, SceneError> {
    let scale = table.number(&SCALE)?.unwrap_or(1.0) * table.choice("unit", &UNITS)?.unwrap_or(1.0);
    let mut placement = Placement::at(table.vector(&TRANSLATION)?.unwrap_or_default());
    if let Some(rotation) = table.table("rotation")? {
        rotation.expect_keys(&[AXIS.name, KEY_ANGLE.name])?;
        let axis = unit_axis(rotation.required_vector(&AXIS)?).map_err(|error| rotation.placed(&error))?;
        placement = Placement::default().on(axis, rotation.required_number(&KEY_ANGLE)?, placement.translation);
    }
    let Placement { rotation, translation } = placement;
    Ok(DAffine3::from_scale_rotation_translation(
        DVec3::splat(scale),
        rotation,
        translation,
    ))
}

/// Moves positions of a file to where they are in the scene. Without a placement all bits stay.
pub(super) fn place(placement: &DAffine3, positions: &mut [DVec3]) {
    if *placement != DAffine3::IDENTITY {
        positions
            .iter_mut()
            .for_each(|position| *position = placement.transform_point3(*position));
    }
}

/// Removes isolated vertices and renumbers the others in their order. Returns the number of removed vertices.
fn leave_out_isolated(mesh: &mut Mesh, loose_edges: &mut [[u32; 2]], file: &mut FileMesh) -> usize {
    let mut number = vec![LEFT_OUT; mesh.positions.len()];
    let named = mesh.triangles.as_flattened().iter().chain(loose_edges.as_flattened());
    named.for_each(|&vertex| number[vertex as usize] = 0);
    let used = number.iter_mut().filter(|number| **number == 0);
    used.zip(0..).for_each(|(number, new)| *number = new);
    let kept = mesh.positions.iter().zip(&number).filter(|(_, number)| **number != LEFT_OUT);
    let kept: Vec<DVec3> = kept.map(|(&position, _)| position).collect();
    let left_out = mesh.positions.len() - kept.len();
    mesh.positions = kept;
    let all = mesh
        .triangles
        .as_flattened_mut()
        .iter_mut()
        .chain(loose_edges.as_flattened_mut());
    all.for_each(|vertex| *vertex = number[*vertex as usize]);
    file.renumber(&number);
    left_out
}

fn path(table: &Table<'_>) -> Result<PathBuf, SceneError> {
    let Some(file) = table.text("file")? else {
        let message = "shape \"file\" needs `file`, such as \"shirt.obj\"".to_owned();
        return Err(table.error("file", message));
    };
    Ok(table.folder().join(file))
}

/// Checks that coordinates are in range, and that triangles name existing vertices.
pub(super) fn check(mesh: &Mesh) -> Result<(), ValueError> {
    let is_near = |p: &DVec3| p.abs().cmple(DVec3::splat(LARGEST_COORDINATE)).all();
    if let Some(far) = mesh.positions.iter().find(|p| !is_near(p)) {
        let message = format!("the mesh has a vertex at {far}, beyond {LARGEST_COORDINATE} metres");
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
    fn isolated_vertices_are_left_out_and_the_others_keep_their_order() {
        let mut mesh = Mesh::new((0..7).map(|x| DVec3::X * f64::from(x)).collect(), vec![[6, 1, 4]]);
        let mut loose = [[2, 6]];
        let mut file = FileMesh::new(&mesh, &loose);
        assert_eq!(leave_out_isolated(&mut mesh, &mut loose, &mut file), 3);
        assert_eq!(file.vertex_of, [LEFT_OUT, 0, 1, LEFT_OUT, 2, LEFT_OUT, 3]);
        assert_eq!(mesh.positions, [1.0, 2.0, 4.0, 6.0].map(|x| DVec3::X * x));
        assert_eq!((mesh.triangles, loose), (vec![[3, 0, 2]], [[1, 3]]));
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
