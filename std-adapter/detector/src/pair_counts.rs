//! How many pairs of each kind.

use std::ops::AddAssign;

/// How many pairs of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairCounts {
    /// Vertex–face pairs.
    pub vertex_face: u64,
    /// Edge–edge pairs.
    pub edge_edge: u64,
}

impl PairCounts {
    /// No pairs.
    pub(crate) const NONE: Self = Self {
        vertex_face: 0,
        edge_edge: 0,
    };

    /// Both kinds together.
    #[must_use]
    pub const fn total(self) -> u64 {
        self.vertex_face + self.edge_edge
    }
}

impl AddAssign for PairCounts {
    fn add_assign(&mut self, other: Self) {
        self.vertex_face += other.vertex_face;
        self.edge_edge += other.edge_edge;
    }
}
