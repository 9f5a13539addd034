//! Triangle meshes in memory, and their topology.
//!
//! A [`Mesh`] is positions and triangles. A [`Topology`] holds the edges; it does not change while the mesh moves, so it is built
//! once.

mod adjacency;
mod components;
mod edges;
mod error;
mod features;
mod hinges;
mod statistics;
#[cfg(test)]
mod tests;
mod topology;
mod weld;

pub use adjacency::Adjacency;
pub use components::Components;
pub use error::TopologyError;
pub use features::FeaturePair;
pub(crate) use hinges::{Hinge, Hinges};
pub use statistics::TopologyStatistics;
pub use topology::Topology;
pub use weld::{WeldedMesh, first_coincident};

use selvedge_core::glam::DVec3;

/// A triangle mesh. Indices may be out of range until [`Mesh::topology`] accepts them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, in the caller's length unit.
    pub positions: Vec<DVec3>,
    /// The three vertices of each triangle, as indices into [`positions`](Self::positions).
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Makes a mesh.
    #[must_use]
    pub const fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        Self { positions, triangles }
    }

    /// Makes the topology of this mesh.
    ///
    /// # Errors
    /// Returns the errors of [`Topology::new`].
    pub fn topology(&self) -> Result<Topology, TopologyError> {
        Topology::new(self.positions.len(), self.triangles.clone())
    }
}
