//! Counts of pairs by kind.

use std::ops::AddAssign;

/// The number of pairs of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairCounts {
    /// The number of vertex–face pairs.
    pub vertex_face: u64,
    /// The number of edge–edge pairs.
    pub edge_edge: u64,
}

impl PairCounts {
    /// Returns the number of pairs of both kinds.
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
