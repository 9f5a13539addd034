//! The edges of triangles.

/// Returns the edges of triangles as each goes round: an inner edge twice.
pub(crate) fn edges_of(triangles: &[[u32; 3]]) -> impl Iterator<Item = [u32; 2]> + Clone {
    triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
}

/// Returns the edge with the smaller number first.
pub(crate) fn undirected([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Returns every edge once, in order, whatever its direction.
pub(crate) fn once_each(edges: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut edges: Vec<_> = edges.map(undirected).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Returns whether each edge has two triangles that face the same way.
pub(crate) fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let mut there: Vec<[u32; 2]> = edges_of(triangles).collect();
    let mut back: Vec<[u32; 2]> = edges_of(triangles).map(|[a, b]| [b, a]).collect();
    there.sort_unstable();
    back.sort_unstable();
    !there.is_empty() && there == back && there.windows(2).all(|two| two[0] != two[1])
}
