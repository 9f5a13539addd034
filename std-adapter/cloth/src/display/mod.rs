//! Cloth and ropes as triangles with normals, for programs that show them.

mod normals;
mod tubes;

pub use normals::vertex_normals;
pub use tubes::Tubes;
