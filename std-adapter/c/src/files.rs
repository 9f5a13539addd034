//! Reads mesh files, and shows meshes as lists.

use crate::guard::guarded;
use crate::handles::{self, Handled, Living};
use crate::input::{Out, text};
use crate::status::{Failure, Status};
use selvedge::Mesh;
use selvedge_cloth::files::mesh;
use std::ffi::{CString, c_char};
use std::path::Path;
use std::ptr;

/// A mesh file that was read. Its pointer is a handle: a number that is looked up and never followed.
pub struct FileHandle {
    _nothing: [u8; 0],
}

/// The lists of a mesh. An empty list is at NULL.
#[repr(C)]
pub struct MeshLists {
    /// x y z of each vertex.
    pub positions: *const f64,
    /// The number of vertices.
    pub vertex_count: usize,
    /// Three vertices of each triangle.
    pub triangles: *const u32,
    /// The number of triangles.
    pub triangle_count: usize,
    /// Two vertices of each edge that belongs to no triangle.
    pub loose_edges: *const u32,
    /// The number of loose edges.
    pub loose_edge_count: usize,
    /// The vertices that are particles.
    pub points: *const u32,
    /// The number of particles.
    pub point_count: usize,
}

/// A mesh to whose lists C holds pointers.
#[derive(Default)]
pub(crate) struct ListedMesh {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    loose_edges: Vec<[u32; 2]>,
    points: Vec<u32>,
}

/// Returns the address of a list; NULL if it is empty.
fn start<T, N>(list: &[T]) -> *const N {
    if list.is_empty() { ptr::null() } else { list.as_ptr().cast() }
}

impl ListedMesh {
    pub(crate) fn new(Mesh { positions, triangles }: Mesh, loose_edges: Vec<[u32; 2]>, points: Vec<u32>) -> Self {
        Self {
            positions: positions.into_iter().map(|position| position.to_array()).collect(),
            triangles,
            loose_edges,
            points,
        }
    }

    pub(crate) fn lists(&self) -> MeshLists {
        MeshLists {
            positions: start(&self.positions),
            vertex_count: self.positions.len(),
            triangles: start(&self.triangles),
            triangle_count: self.triangles.len(),
            loose_edges: start(&self.loose_edges),
            loose_edge_count: self.loose_edges.len(),
            points: start(&self.points),
            point_count: self.points.len(),
        }
    }
}

/// A mesh file, and the report about it.
pub(crate) struct File {
    mesh: ListedMesh,
    missing: Option<CString>,
    notes: CString,
}

impl Handled for File {
    type Handle = FileHandle;
    const NAME: &'static str = "file";
    const NO_SUCH: Status = Status::NoSuchFile;

    fn living() -> &'static Living<Self> {
        static LIVING: Living<File> = Living::new();
        &LIVING
    }
}

/// Reads a mesh file: OBJ, PLY, STL or OFF, by its extension. Vertices have the file's numbers, positions every bit that the file
/// holds, in the file's unit. Polygons are split by their shape. SELVEDGE_STATUS_BAD_FILE means that it cannot be read; the
/// message names the place.
///
/// `*file` receives the handle; free it with selvedge_file_free.
///
/// # Safety
/// `path` points to a text that a zero ends, `file` to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_file_new(path: *const c_char, file: *mut *mut FileHandle) -> Status {
    guarded(|| {
        // SAFETY: the caller's promises.
        let (out, path) = unsafe { (Out::new("where the file goes", file)?, text("the path", path)?) };
        let read = mesh::read_with_loose_features(Path::new(path)).map_err(|error| Failure::new(Status::BadFile, error))?;
        // Reports contain no zero.
        let text = |text: String| CString::new(text).unwrap_or_default();
        let triangles = read.topology.proper_triangles().to_vec();
        let (edges, points) = (read.topology.loose_edges().collect(), read.topology.points().collect());
        let mesh = Mesh {
            positions: read.positions,
            triangles,
        };
        out.set(handles::keep(File {
            mesh: ListedMesh::new(mesh, edges, points),
            missing: read.notes.missing().map(text),
            notes: text(read.notes.to_string()),
        })?);
        Ok(())
    })
}

/// Returns the mesh of a file, and the report about it. `*missing` receives a text that names the parts which may have an area
/// and were not read, or NULL. With such parts, contacts of this mesh are not all contacts of the file. `*notes` receives one
/// line of counts, and of what was split or left out.
///
/// Lists and texts belong to the file. They stay valid until it is freed.
///
/// # Safety
/// `mesh` points to one entry, `missing` and `notes` to a pointer each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_file_mesh(
    file: *const FileHandle,
    mesh: *mut MeshLists,
    missing: *mut *const c_char,
    notes: *mut *const c_char,
) -> Status {
    handles::on::<File>(file, |_, file| {
        // SAFETY: the caller's promises.
        let [missing, notes] = unsafe { [Out::new("missing", missing)?, Out::new("notes", notes)?] };
        // SAFETY: the caller's promise.
        unsafe { Out::new("mesh", mesh) }?.set(file.mesh.lists());
        missing.set(file.missing.as_ref().map_or(ptr::null(), |text| text.as_ptr()));
        notes.set(file.notes.as_ptr());
        Ok(())
    })
}

/// Frees a file and its lists. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_file_free(file: *mut FileHandle) -> Status {
    handles::free::<File>(file)
}
