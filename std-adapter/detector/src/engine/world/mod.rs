//! A step of several meshes.

mod handles;
mod mesh;
mod stage;
mod vertex_path;

pub use handles::MeshHandle;
pub(crate) use mesh::{Frames, Moves, WorldMesh, between_poses};
pub(crate) use stage::{Given, MOST_VERTICES, Stage};
pub(crate) use vertex_path::{VertexPath, vertex_paths, vertices_of};
