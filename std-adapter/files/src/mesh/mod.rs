//! Mesh files: OBJ, PLY, STL, OFF and glTF, read exactly; OBJ and PLY, written exactly; point caches.
//!
//! Positions keep their order and their number, and every bit that the file holds: a vertex that no face names is kept, several
//! objects in one file are one mesh, nothing is merged. Polygons are split into triangles by their shape. [`read`] returns
//! triangles alone; [`read_with_loose_features`] keeps edges and points that belong to none. Normals, colours, texture
//! coordinates and materials are ignored.

pub(crate) mod checks;
mod error;
mod findings;
pub(crate) mod format;
mod frame_difference;
mod gltf;
mod notes;
mod obj;
mod off;
mod options;
mod parsed;
mod ply;
mod point_cache;
mod polygon;
mod sequence;
mod step;
mod stl;
#[cfg(test)]
mod tests;
mod text;

pub use crate::problem::FileProblem;
pub use error::{MeshError, SequenceProblem};
pub use findings::{Findings, THIN};
pub use format::{FileFormat, PlyEncoding};
pub use frame_difference::FrameDifference;
pub use notes::{FilePart, LeftOut, MeshNotes};
pub use options::ReadOptions;
pub use point_cache::{CacheFormat, read_point_cache};
pub use sequence::{MeshSequence, read_sequence, read_sequence_from};
pub use step::{MeshStep, read_step};

use crate::FileSource;
use crate::temporary_file;
use checks::{check_finite, corner};
use parsed::Parsed;
use selvedge::{Mesh, Topology, TopologyError};
use selvedge_core::glam::DVec3;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// A mesh and a report about its file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// The mesh. All vertices are finite, and all triangles are in range; there is at least one.
    pub mesh: Mesh,
    /// A report about the file.
    pub notes: MeshNotes,
}

/// Reads the mesh file at `path`, in the format that its extension names.
///
/// # Errors
/// Returns an error if the file cannot be read, is not in its format, is too short or too long, or has no face. Coordinates must
/// be finite, and each face needs at least three vertices, which must exist. The message names the file and the line, element or
/// vertex.
pub fn read(path: &Path) -> Result<MeshFile, MeshError> {
    let read = load(&FileSource::Disk, path, &ReadOptions::default()).and_then(Parsed::into_file);
    read.map_err(|problem| MeshError::file(path, problem))
}

/// A mesh with ropes, hair and particles: positions, and the topology of triangles, then [loose edges and
/// points](Topology::with_loose_features).
#[derive(Clone, Debug, PartialEq)]
pub struct LooseMesh {
    /// The position of each vertex; all are finite.
    pub positions: Vec<DVec3>,
    /// The triangles, loose edges and points; there is at least one of them.
    pub topology: Topology,
    /// A report about the file.
    pub notes: MeshNotes,
}

/// Reads the mesh file at `path` like [`read`], together with edges and points that belong to no triangle. In OBJ these are the
/// lines `l` (each piece of one is an edge) and `p`; in PLY they are the element `edge` (`vertex1`, `vertex2`). A PLY file with
/// neither faces nor edges is a cloud of points: all its vertices.
///
/// # Errors
/// Returns the errors of [`read`], except that a file may have edges or points alone. Also returns an error if one of these names
/// a vertex that does not exist.
pub fn read_with_loose_features(path: &Path) -> Result<LooseMesh, MeshError> {
    read_with(path, &WITH_LOOSE_FEATURES)
}

const WITH_LOOSE_FEATURES: ReadOptions<'static> = ReadOptions {
    loose_features: true,
    only: None,
    weld: None,
};

/// Reads the requested parts of the mesh file at `path`, like [`read`].
///
/// # Errors
/// Returns the errors of [`read`] and, on request, of [`read_with_loose_features`]. Also returns an error if the file has no such
/// group or object.
pub fn read_with(path: &Path, options: &ReadOptions<'_>) -> Result<LooseMesh, MeshError> {
    read_from(&FileSource::Disk, path, options)
}

/// Reads the wanted parts of a mesh file of any source, like [`read_with`].
///
/// # Errors
/// Those of [`read_with`].
pub fn read_from(source: &FileSource, path: &Path, options: &ReadOptions<'_>) -> Result<LooseMesh, MeshError> {
    let read = load(source, path, options).and_then(Parsed::into_loose);
    read.map_err(|problem| MeshError::file(path, problem))
}

/// Reads such a mesh from the bytes of a file, like [`read_bytes`].
///
/// # Errors
/// Returns the errors of [`read_with_loose_features`], without the file's name.
///
/// ```
/// use selvedge_files::mesh::{FileFormat, read_bytes_with_loose_features};
///
/// // A rope of two pieces, and a particle.
/// let rope = read_bytes_with_loose_features(b"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nl 1 2 3\np 4\n", FileFormat::Obj)?;
/// assert_eq!(rope.topology.triangles(), [[0, 1, 1], [1, 2, 2], [3, 3, 3]]);
/// # Ok::<(), selvedge_files::mesh::FileProblem>(())
/// ```
pub fn read_bytes_with_loose_features(bytes: &[u8], format: FileFormat) -> Result<LooseMesh, FileProblem> {
    parse(bytes, format, &WITH_LOOSE_FEATURES)?.into_loose()
}

/// Reads the requested parts of the bytes of a file, like [`read_with`].
///
/// # Errors
/// Returns the errors of [`read_with`], without the file's name.
pub fn read_bytes_with(bytes: &[u8], format: FileFormat, options: &ReadOptions<'_>) -> Result<LooseMesh, FileProblem> {
    parse(bytes, format, options)?.into_loose()
}

/// Reads a mesh from the bytes of a file. For [`FileFormat::Ply`] the header decides on the encoding, not the argument. No input
/// causes a panic, and the memory is in proportion to the input.
///
/// # Errors
/// Returns the errors of [`read`], without the file's name.
///
/// ```
/// use selvedge_files::mesh::{FileFormat, read_bytes};
///
/// let file = read_bytes(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", FileFormat::Obj)?;
/// assert_eq!(file.mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
/// assert_eq!(file.notes.polygons_triangulated, 1);
/// # Ok::<(), selvedge_files::mesh::FileProblem>(())
/// ```
pub fn read_bytes(bytes: &[u8], format: FileFormat) -> Result<MeshFile, FileProblem> {
    parse(bytes, format, &ReadOptions::default())?.into_file()
}

/// Writes `mesh` to `path`, in the format that its extension names. A reader gets every bit back.
///
/// The file appears in one piece: it is written under another name in the same folder and renamed when complete. On an error
/// there is no new file, and an older one is unchanged.
///
/// # Errors
/// Returns an error if the extension is unknown, the file cannot be written, or the mesh is one that [`read`] would refuse.
pub fn write(path: &Path, mesh: &Mesh) -> Result<(), MeshError> {
    write_with_loose_edges(path, mesh, &[])
}

/// Writes `mesh` to `path` like [`write()`], together with edges that belong to no triangle, each by its two vertices. They are
/// lines `l` of an OBJ file, or the element `edge` of a PLY file; [`read_with_loose_features`] reads them. If there are edges,
/// the mesh needs no triangles.
///
/// ```
/// use selvedge::{Mesh, glam::DVec3};
/// use selvedge_files::mesh::{read_with_loose_features, write_with_loose_edges};
///
/// let rope = Mesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::X * 2.0], triangles: Vec::new() };
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("rope.obj");
/// write_with_loose_edges(&path, &rope, &[[0, 1], [1, 2]])?;
/// assert!(read_with_loose_features(&path)?.topology.loose_edges().eq([[0, 1], [1, 2]]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the errors of [`write()`]. Also returns an error if an edge names a vertex that does not exist.
pub fn write_with_loose_edges(path: &Path, mesh: &Mesh, loose_edges: &[[u32; 2]]) -> Result<(), MeshError> {
    match FileFormat::from_path(path) {
        Some(format) => write_checked(path, mesh, loose_edges, format),
        None => Err(MeshError::file(path, FileProblem::UnknownExtension)),
    }
}

fn write_checked(path: &Path, mesh: &Mesh, loose_edges: &[[u32; 2]], format: FileFormat) -> Result<(), MeshError> {
    check(mesh, loose_edges)
        .and_then(|()| save(path, mesh, loose_edges, format).map_err(FileProblem::Write))
        .map_err(|problem| MeshError::file(path, problem))
}

/// Returns the bytes of a file that holds `mesh`, as [`write()`] would write it. It is the inverse of [`read_bytes`].
///
/// # Errors
/// Returns an error if the mesh is one that [`read`] would refuse.
///
/// ```
/// use selvedge::{Mesh, glam::DVec3};
/// use selvedge_files::mesh::{FileFormat, write_bytes};
///
/// let mesh = Mesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2]],
/// };
/// let bytes = write_bytes(&mesh, FileFormat::Obj)?;
/// assert_eq!(bytes, b"v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.0 1.0 0.0\nf 1 2 3\n");
/// # Ok::<(), selvedge_files::mesh::FileProblem>(())
/// ```
pub fn write_bytes(mesh: &Mesh, format: FileFormat) -> Result<Vec<u8>, FileProblem> {
    check(mesh, &[])?;
    let mut bytes = Vec::new();
    write_to(&mut bytes, mesh, &[], format).map_err(FileProblem::Write)?;
    Ok(bytes)
}

fn load(source: &FileSource, path: &Path, options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    if let FileSource::Disk = source
        && std::fs::metadata(path).map_err(FileProblem::from_read)?.is_dir()
    {
        return Err(FileProblem::Folder);
    }
    let format = FileFormat::from_path(path).ok_or(FileProblem::UnknownExtension)?;
    let bytes = source.read(path).map_err(FileProblem::from_read)?;
    parse_at(&bytes, source.beside(path), format, options)
}

fn parse(bytes: &[u8], format: FileFormat, options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    parse_at(bytes, Path::new(""), format, options)
}

/// Parses a file. Other files that it names are relative to the path.
fn parse_at(bytes: &[u8], path: &Path, format: FileFormat, options: &ReadOptions<'_>) -> Result<Parsed, FileProblem> {
    if bytes.is_empty() {
        return Err(FileProblem::Empty);
    }
    match format {
        FileFormat::Obj => obj::parse(bytes, options),
        FileFormat::Ply(_) => ply::parse(bytes, options),
        FileFormat::Stl => stl::parse(bytes, options),
        FileFormat::Off => off::parse(bytes, options),
        FileFormat::Gltf => gltf::parse(bytes, path, options),
    }
    .map(|parsed| Parsed {
        weld: options.weld,
        ..parsed
    })
}

/// Refuses a mesh that could not be read again.
fn check(mesh: &Mesh, loose_edges: &[[u32; 2]]) -> Result<(), FileProblem> {
    for (vertex, position) in mesh.positions.iter().enumerate() {
        check_finite(vertex, *position, None)?;
    }
    if mesh.triangles.is_empty() && loose_edges.is_empty() {
        return Err(TopologyError::NoTriangles.into());
    }
    let vertex_count = mesh.positions.len();
    for (index, ends) in loose_edges.iter().enumerate() {
        if let Some(&vertex) = ends.iter().find(|&&v| v as usize >= vertex_count) {
            let error = TopologyError::LooseVertexOutOfRange {
                index,
                is_point: false,
                vertex,
                vertex_count,
            };
            return Err(error.into());
        }
    }
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        for &vertex in triangle {
            corner(face, vertex.into(), vertex_count, None)?;
        }
    }
    Ok(())
}

fn save(path: &Path, mesh: &Mesh, loose_edges: &[[u32; 2]], format: FileFormat) -> io::Result<()> {
    let mut out = BufWriter::new(temporary_file::beside(path)?);
    write_to(&mut out, mesh, loose_edges, format)?;
    out.flush()?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

fn write_to(out: &mut impl Write, mesh: &Mesh, loose_edges: &[[u32; 2]], format: FileFormat) -> io::Result<()> {
    match format {
        FileFormat::Obj => obj::write(out, mesh, loose_edges),
        FileFormat::Ply(encoding) => ply::write(out, mesh, loose_edges, encoding),
        FileFormat::Stl | FileFormat::Off | FileFormat::Gltf => Err(io::Error::new(
            io::ErrorKind::Unsupported,
            "this format is only read; name the file .obj or .ply",
        )),
    }
}
