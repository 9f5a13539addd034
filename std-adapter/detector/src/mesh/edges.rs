//! Finds the edges of a list of triangles.

use super::adjacency::Adjacency;
use std::borrow::Cow;

/// Marks a triangle's side without an edge.
pub(super) const NO_EDGE: u32 = u32::MAX;

/// The largest number of triangles. Three edges of each must have numbers below [`NO_EDGE`].
pub(super) const MAX_TRIANGLES: usize = (u32::MAX / 3) as usize;

/// The vertices that triangles name. If few vertices have a triangle, they are renumbered, so that a list of them is short.
pub(super) struct Named<'a> {
    pub(super) vertex_count: usize,
    pub(super) triangles: Cow<'a, [[u32; 3]]>,
    /// The mesh's own numbers of the vertices, ascending, if they are renumbered.
    names: Option<Vec<u32>>,
}

/// The ratio of vertices to corners from which on most vertices have no triangle. A usual mesh has one vertex for six corners.
const SPARSE: usize = 4;

impl<'a> Named<'a> {
    pub(super) fn new(vertex_count: usize, triangles: &'a [[u32; 3]]) -> Self {
        if vertex_count / SPARSE <= 3 * triangles.len() {
            return Self {
                vertex_count,
                triangles: Cow::Borrowed(triangles),
                names: None,
            };
        }
        let mut names: Vec<u32> = triangles.iter().flatten().copied().collect();
        names.sort_unstable();
        names.dedup();
        // Every vertex is in the list.
        let number = |vertex: u32| names.partition_point(|&name| name < vertex) as u32;
        Self {
            vertex_count: names.len(),
            triangles: triangles.iter().map(|corners| corners.map(number)).collect(),
            names: Some(names),
        }
    }

    /// Returns the mesh's own number of a vertex. The order is the same.
    fn name(&self, vertex: u32) -> u32 {
        self.names.as_ref().map_or(vertex, |names| names[vertex as usize])
    }
}

/// Returns the edges in order, and the three edges of each triangle.
pub(super) fn find_edges(named: &Named<'_>) -> (Vec<[u32; 2]>, Vec<[u32; 3]>) {
    let triangles = &*named.triangles;
    // A slot is a triangle's entry: 3 × triangle + k.
    let ends = |slot: usize| {
        let (triangle, k) = (triangles[slot / 3], slot % 3);
        (triangle[k], triangle[(k + 1) % 3])
    };
    let slots = (0..triangles.len() * 3).filter_map(|slot| {
        let (a, b) = ends(slot);
        (a != b).then(|| (a.max(b), (a.min(b), slot as u32)))
    });
    // A mesh has few edges at each vertex, so this is much faster than one large sort.
    let groups = Adjacency::new(named.vertex_count, || slots.clone()).sorted();

    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(triangles.len() * 3 / 2);
    let mut triangle_edges = vec![[NO_EDGE; 3]; triangles.len()];
    for (larger, group) in (0..).zip(groups.iter()) {
        for same_edge in group.chunk_by(|a, b| a.0 == b.0) {
            for &(_, slot) in same_edge {
                triangle_edges[slot as usize / 3][slot as usize % 3] = edges.len() as u32;
            }
            edges.push([same_edge[0].0, larger].map(|end| named.name(end)));
        }
    }
    (edges, triangle_edges)
}
