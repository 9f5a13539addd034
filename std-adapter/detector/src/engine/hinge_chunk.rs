//! The buffers of one thread for hinges.

use crate::mesh::Hinge;
use selvedge_core::batch::Mask;

#[derive(Debug, Default)]
pub(super) struct HingeChunk {
    pub(super) hinges: Vec<Hinge>,
    /// For each hinge that may be coplanar, its index twice, and the rows of its vertices.
    pub(super) indices: Vec<[u32; 2]>,
    pub(super) rows: Vec<[u32; 4]>,
    pub(super) masks: Vec<Mask>,
}

impl HingeChunk {
    pub(super) fn clear(&mut self) {
        self.hinges.clear();
        self.indices.clear();
        self.rows.clear();
    }
}
