//! Reads meshes of files, and takes those of code, to their place in the scene.

use super::file_mesh::{FileMesh, LEFT_OUT};
use super::keyframes::{AXIS, KEY_ANGLE, unit_axis};
use super::placement::{Placement, TRANSLATION};
use super::shapes::check;
use crate::input::{Field, LENGTH, NamedMesh, RATIO, SceneError, Table, ValueError};
use selvedge::Mesh;
use selvedge_core::glam::{DAffine3, DVec3};
use selvedge_files::mesh::{self, FileProblem, LooseMesh, MeshError, ReadOptions};
use std::path::{Path, PathBuf};

/// The keys that place a mesh, and merge its vertices.
pub(crate) const MESH_KEYS: [&str; 5] = ["scale", "unit", "rotation", "translation", WELD.name];

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
    let read = read_file(table, false)?;
    Ok(read.placed(table)?.mesh)
}

/// Returns the mesh from code that `mesh` names.
pub(super) fn of_code(table: &Table<'_>) -> Result<Mesh, SceneError> {
    let read = Read::of_code(table, table.named_mesh()?)?;
    Ok(read.placed(table)?.mesh)
}

pub(crate) struct ClothMesh {
    pub(crate) mesh: Mesh,
    pub(crate) loose_edges: Vec<[u32; 2]>,
    /// The positions at rest, if they are not those of the mesh.
    pub(crate) rest: Option<Vec<DVec3>>,
    /// The number of isolated vertices, which were left out.
    pub(crate) left_out: usize,
    pub(crate) file: FileMesh,
}

/// Reads a cloth's mesh: triangles, or triangles and loose edges, at least one. Isolated vertices are left out, unless they
/// belong to loose edges that are not wanted.
pub(crate) fn cloth_of_file(table: &Table<'_>, with_loose_edges: bool) -> Result<ClothMesh, SceneError> {
    let mut read = read_file(table, true)?;
    if let Some(rest) = table.text("rest_file")? {
        let options = ReadOptions {
            loose_features: true,
            ..ReadOptions::default()
        };
        let at_rest = read_whole(table, "rest_file", &table.folder().join(rest), &options)?.positions;
        read.set_rest(table, "rest_file", at_rest)?;
    }
    let mut placed = read.placed(table)?;
    let is_without_loose_edges = placed.loose_edges.is_empty();
    if with_loose_edges && is_without_loose_edges {
        let message =
            "`linear_density` is for edges that belong to no triangle (lines `l` of an OBJ file), but the file has none";
        return Err(table.error("file", message.to_owned()));
    }
    if !with_loose_edges {
        placed.file.loose_edges.clear();
    }
    let is_whole = with_loose_edges || is_without_loose_edges;
    let is_empty = placed.mesh.triangles.is_empty() && is_without_loose_edges;
    let left_out = if is_whole && !is_empty {
        placed.leave_out_isolated()
    } else {
        0
    };
    placed.of_cloth(table, left_out)
}

/// Returns a cloth's mesh from code. All its vertices keep their numbers, so none may be isolated.
pub(crate) fn cloth_of_code(table: &Table<'_>, given: &NamedMesh) -> Result<ClothMesh, SceneError> {
    let placed = Read::of_code(table, given)?.placed(table)?;
    let Placed {
        mesh, loose_edges, file, ..
    } = &placed;
    let mut is_used = vec![false; mesh.positions.len()];
    let named = mesh.triangles.as_flattened().iter().chain(loose_edges.as_flattened());
    named.for_each(|&vertex| is_used[vertex as usize] = true);
    if let Some(isolated) = is_used.iter().position(|used| !used) {
        let vertex = (0_u32..).zip(&file.vertex_of).find(|(_, own)| **own == isolated as u32);
        let vertex = vertex.map_or(isolated as u32, |(vertex, _)| vertex);
        let message = format!("vertex {vertex} of the mesh belongs to no face and no edge; leave such vertices out");
        return Err(table.error("mesh", message));
    }
    placed.of_cloth(table, 0)
}

/// A mesh as a file or code has it.
struct Read {
    mesh: Mesh,
    loose_edges: Vec<[u32; 2]>,
    rest: Option<Vec<DVec3>>,
    /// True if only a part of the mesh is wanted, so that vertices outside it are left out.
    is_part: bool,
    /// The key that names the mesh, for messages.
    key: &'static str,
}

/// A mesh in its place in the scene.
struct Placed {
    mesh: Mesh,
    loose_edges: Vec<[u32; 2]>,
    /// Of each vertex of the file.
    rest: Option<Vec<DVec3>>,
    file: FileMesh,
}

impl Read {
    fn of_code(table: &Table<'_>, given: &NamedMesh) -> Result<Self, SceneError> {
        let mut read = Self {
            mesh: given.mesh.clone(),
            loose_edges: given.loose_edges.clone(),
            rest: None,
            is_part: false,
            key: "mesh",
        };
        if let Some(rest) = &given.rest {
            read.set_rest(table, "mesh", rest.clone())?;
        }
        Ok(read)
    }

    fn set_rest(&mut self, table: &Table<'_>, key: &str, rest: Vec<DVec3>) -> Result<(), SceneError> {
        let (found, expected) = (rest.len(), self.mesh.positions.len());
        if found != expected {
            let message = format!("the shape at rest has {found} vertices, but the mesh has {expected}: they must be the same");
            return Err(table.error(key, message));
        }
        self.rest = Some(rest);
        Ok(())
    }

    /// Returns the mesh in metres and in its place, with vertices merged according to `weld`.
    fn placed(self, table: &Table<'_>) -> Result<Placed, SceneError> {
        let Self {
            mut mesh,
            mut loose_edges,
            mut rest,
            is_part,
            key,
        } = self;
        let wrong = |error: ValueError| table.error(key, error.message);
        check(&mesh).map_err(wrong)?;
        if let Some(end) = loose_edges
            .as_flattened()
            .iter()
            .find(|&&end| end as usize >= mesh.positions.len())
        {
            let count = mesh.positions.len();
            let message = format!("an edge of the mesh names the vertex {end}, but there are {count}, numbered from 0");
            return Err(table.error(key, message));
        }
        let placement = placement(table)?;
        place(&placement, &mut mesh.positions);
        if let Some(rest) = &mut rest {
            place(&placement, rest);
        }
        let mut file = FileMesh::new(&mesh, &loose_edges);
        if let Some(tolerance) = table.number(&WELD)? {
            let welded = mesh.welded(tolerance);
            let ends = |ends: [u32; 2]| ends.map(|end| welded.vertex_of[end as usize]);
            loose_edges = loose_edges.into_iter().map(ends).filter(|[from, to]| from != to).collect();
            file.renumber(&welded.vertex_of);
            mesh = welded.mesh;
        }
        let mut placed = Placed {
            mesh,
            loose_edges,
            rest,
            file,
        };
        if is_part {
            placed.leave_out_isolated();
        }
        check(&placed.mesh).map_err(wrong)?;
        Ok(placed)
    }
}

impl Placed {
    /// Removes isolated vertices and renumbers the others in their order. Returns the number of removed vertices.
    fn leave_out_isolated(&mut self) -> usize {
        let Self { mesh, loose_edges, .. } = self;
        let mut number = vec![LEFT_OUT; mesh.positions.len()];
        let named = mesh.triangles.as_flattened().iter().chain(loose_edges.as_flattened());
        named.for_each(|&vertex| number[vertex as usize] = 0);
        let used = number.iter_mut().filter(|number| **number == 0);
        used.zip(0..).for_each(|(number, new)| *number = new);
        let kept = mesh.positions.iter().zip(&number).filter(|(_, number)| **number != LEFT_OUT);
        let kept: Vec<DVec3> = kept.map(|(&position, _)| position).collect();
        let left_out = mesh.positions.len() - kept.len();
        mesh.positions = kept;
        let triangles = mesh.triangles.as_flattened_mut().iter_mut();
        let all = triangles.chain(loose_edges.as_flattened_mut());
        all.for_each(|vertex| *vertex = number[*vertex as usize]);
        self.file.renumber(&number);
        left_out
    }

    /// Returns this as a cloth's mesh, of whose vertices `left_out` are already removed. Vertices that `weld` merges must be near
    /// each other at rest too.
    fn of_cloth(self, table: &Table<'_>, left_out: usize) -> Result<ClothMesh, SceneError> {
        let tolerance = table.number(&WELD)?.unwrap_or(0.0);
        let mut of_cloth = vec![None; self.mesh.positions.len()];
        let own = self.file.vertex_of.iter();
        for (vertex, (&position, &own)) in self.rest.iter().flatten().zip(own).enumerate() {
            // Vertices that the cloth does not have are `LEFT_OUT`.
            match of_cloth.get_mut(own as usize) {
                Some(Some(first)) if position.distance(*first) > tolerance => {
                    let message = format!(
                        "`weld` merges the vertex {vertex} with another one that is {} away in the shape at rest: sew them with [effects.seams] instead",
                        LENGTH.written(position.distance(*first))
                    );
                    return Err(table.error(WELD.name, message));
                }
                Some(place @ None) => *place = Some(position),
                _ => {}
            }
        }
        Ok(ClothMesh {
            mesh: self.mesh,
            loose_edges: self.loose_edges,
            rest: self.rest.map(|_| of_cloth.into_iter().flatten().collect()),
            left_out,
            file: self.file,
        })
    }
}

/// Reads a file, or the group of it that `group` names.
fn read_file(table: &Table<'_>, loose_features: bool) -> Result<Read, SceneError> {
    let only = table.text("group")?;
    let options = ReadOptions {
        loose_features,
        only,
        weld: None,
    };
    let LooseMesh { positions, topology, .. } = read_whole(table, "file", &path(table)?, &options)?;
    let triangles = topology.proper_triangles().to_vec();
    Ok(Read {
        loose_edges: topology.loose_edges().collect(),
        mesh: Mesh { positions, triangles },
        rest: None,
        is_part: only.is_some(),
        key: "file",
    })
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

/// Reads the way from the positions of a file to those of the scene, in metres: `unit` and `scale`, then `rotation`, then
/// `translation`.
pub(super) fn placement(table: &Table<'_>) -> Result<DAffine3, SceneError> {
    let scale = table.number(&SCALE)?.unwrap_or(1.0) * table.choice("unit", &UNITS)?.unwrap_or(1.0);
    let mut placement = Placement::at(table.vector(&TRANSLATION)?.unwrap_or_default());
    if let Some(rotation) = table.table("rotation")? {
        rotation.expect_keys(&[AXIS.name, KEY_ANGLE.name])?;
        let axis = unit_axis(rotation.required_vector(&AXIS)?).map_err(|error| rotation.placed(&error))?;
        placement = Placement::default().turned_and_moved(axis, rotation.required_number(&KEY_ANGLE)?, placement.translation);
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

fn path(table: &Table<'_>) -> Result<PathBuf, SceneError> {
    let Some(file) = table.text("file")? else {
        let message = "shape \"file\" needs `file`, such as \"shirt.obj\"".to_owned();
        return Err(table.error("file", message));
    };
    Ok(table.folder().join(file))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn isolated_vertices_are_left_out_and_the_others_keep_their_order() {
        let mesh = Mesh::new((0..7).map(|x| DVec3::X * f64::from(x)).collect(), vec![[6, 1, 4]]);
        let loose_edges = vec![[2, 6]];
        let mut placed = Placed {
            file: FileMesh::new(&mesh, &loose_edges),
            mesh,
            loose_edges,
            rest: None,
        };
        assert_eq!(placed.leave_out_isolated(), 3);
        assert_eq!(placed.file.vertex_of, [LEFT_OUT, 0, 1, LEFT_OUT, 2, LEFT_OUT, 3]);
        assert_eq!(placed.mesh.positions, [1.0, 2.0, 4.0, 6.0].map(|x| DVec3::X * x));
        assert_eq!((placed.mesh.triangles, placed.loose_edges), (vec![[3, 0, 2]], vec![[1, 3]]));
    }
}
