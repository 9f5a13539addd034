//! Representative features: the vertices and edges that a triangle represents.
//!
//! Triangles of a mesh share vertices and edges, so the 15 primitive pairs of the candidate triangle pairs repeat. Curtis et al.
//! 2008 assign every vertex and every edge to exactly one of its triangles, its *representative*. A pair is tested only where
//! both representatives meet; a face represents itself. The paper adds that each triangle lists the features it represents first,
//! so that two counts describe them.

/// The numbers of vertices and edges that a triangle represents, in one byte. They come first in its lists.
///
/// ```
/// use selvedge_core::Features;
/// let features = Features::new(1, 2).unwrap();
/// assert_eq!((features.vertices(), features.edges()), (1, 2));
/// assert!(Features::new(4, 0).is_none());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Features(u8); // bits 0 and 1: vertices; bits 2 and 3: edges

impl Features {
    /// Features of a triangle that represents nothing.
    pub const NONE: Self = Self(0);
    /// Features of a triangle that represents all three vertices and all three edges.
    pub const ALL: Self = Self(0b1111);

    /// Makes features from both counts. Returns `None` if a count exceeds 3.
    #[must_use]
    pub const fn new(vertices: u8, edges: u8) -> Option<Self> {
        if vertices > 3 || edges > 3 {
            return None;
        }
        Some(Self(vertices | edges << 2))
    }

    /// Returns the number of vertices, 0 to 3.
    #[inline(always)]
    #[must_use]
    pub const fn vertices(self) -> usize {
        (self.0 & 0b11) as usize
    }

    /// Returns the number of edges, 0 to 3.
    #[inline(always)]
    #[must_use]
    pub const fn edges(self) -> usize {
        (self.0 >> 2) as usize
    }

    /// Returns whether two triangles with these features have a pair to test: a vertex on either side, or an edge on both (the
    /// paper's *compatible feature pairs*).
    #[inline(always)]
    #[must_use]
    pub const fn are_compatible(self, other: Self) -> bool {
        (self.0 | other.0) & 0b11 != 0 || (self.0 >> 2 != 0 && other.0 >> 2 != 0)
    }
}

/// An edge of a triangle: its identity and the identities of its two ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FeatureEdge<I> {
    /// The edge's identity in the mesh.
    pub edge: I,
    /// The vertices that it joins.
    pub ends: [I; 2],
}

/// A triangle for distribution: its identity, its vertices and its edges, represented ones first.
///
/// `I` is the caller's name for vertices, edges and faces. Only equality of vertices matters here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FeatureTriangle<I> {
    /// The face's identity in the mesh.
    pub face: I,
    /// Its vertices, represented ones first.
    pub vertices: [I; 3],
    /// Its edges, represented ones first.
    pub edges: [FeatureEdge<I>; 3],
    /// The numbers of vertices and edges that it represents.
    pub features: Features,
}

#[cfg(test)]
mod tests {
    use super::Features;

    #[test]
    fn compatible_means_a_vertex_on_either_side_or_an_edge_on_both() {
        for (v, e, w, f) in (0..256u32).map(|k| (k & 3, k >> 2 & 3, k >> 4 & 3, k >> 6)) {
            let [v, e, w, f] = [v, e, w, f].map(|k| k as u8);
            let (a, b) = (Features::new(v, e).unwrap(), Features::new(w, f).unwrap());
            assert_eq!(a.are_compatible(b), v > 0 || w > 0 || (e > 0 && f > 0));
        }
    }
}
