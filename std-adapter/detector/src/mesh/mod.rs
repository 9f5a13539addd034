//! Triangle meshes in memory, and their topology.
//!
//! A [`Mesh`] is positions and triangles, nothing else. [`Topology`] is what a mesh's triangles
//! say about its edges; it does not change while the mesh moves, so it is built once.

mod hinges;
mod topology;
mod weld;

pub(crate) use hinges::{Hinge, Hinges};
pub use topology::{FeaturePair, Topology, TopologyError, TopologyStatistics};
pub use weld::{WeldedMesh, first_coincident};

use selvedge_core::glam::DVec3;

/// A triangle mesh.
///
/// Nothing is promised about the triangles by the type itself: indices may be out of range until
/// [`Mesh::topology`] has accepted them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, in the caller's length unit.
    pub positions: Vec<DVec3>,
    /// The three vertices of each triangle, as indices into [`positions`](Self::positions).
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The topology of this mesh.
    ///
    /// # Errors
    /// Those of [`Topology::new`].
    pub fn topology(&self) -> Result<Topology, TopologyError> {
        Topology::new(self.positions.len(), self.triangles.clone())
    }
}
