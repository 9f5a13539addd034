//! Rows of loose edges.

use selvedge::Adjacency;

/// A row of loose edges. No other loose edge starts at an inner vertex.
#[derive(Debug, PartialEq)]
pub(crate) struct Run {
    /// Vertices, each joined with the next. In a closed row the last is the first again.
    vertices: Vec<u32>,
    /// True if the row is closed, and no other edge starts where it closes.
    is_ring: bool,
}

/// Splits edges into rows; each edge is in one row. No two edges may join the same vertices.
pub(crate) fn runs(edges: &[[u32; 2]], vertex_count: usize) -> Vec<Run> {
    let ends = || (0..).zip(edges).flat_map(|(edge, ends)| ends.map(|vertex| (vertex, edge)));
    let edges_of = Adjacency::<u32>::new(vertex_count, ends);
    let goes_on = |vertex: u32| edges_of.of(vertex as usize).len() == 2;
    let mut is_taken = vec![false; edges.len()];
    let mut runs = Vec::new();
    let mut follow = |first: u32, edge: u32| {
        let mut next = Some(edge).filter(|&edge| !is_taken[edge as usize]);
        let mut vertices = vec![first];
        while let Some(edge) = next {
            is_taken[edge as usize] = true;
            let last = vertices[vertices.len() - 1];
            let [a, b] = edges[edge as usize];
            let reached = if a == last { b } else { a };
            vertices.push(reached);
            let others = edges_of.of(reached as usize).iter().copied();
            next = others.filter(|_| goes_on(reached)).find(|&other| !is_taken[other as usize]);
        }
        if let [first, .., last] = vertices[..] {
            let is_ring = first == last && goes_on(first);
            runs.push(Run { vertices, is_ring });
        }
    };
    for vertex in (0..vertex_count as u32).filter(|&vertex| !goes_on(vertex)) {
        edges_of.of(vertex as usize).iter().for_each(|&edge| follow(vertex, edge));
    }
    // The remaining edges form rings.
    (0..).zip(edges).for_each(|(edge, ends)| follow(ends[0], edge));
    runs
}

impl Run {
    pub(crate) fn into_vertices(self) -> Vec<u32> {
        self.vertices
    }

    fn is_closed(&self) -> bool {
        self.vertices.first() == self.vertices.last()
    }

    /// Returns rows of distinct vertices that contain each edge once.
    pub(crate) fn pieces(&self) -> Vec<Vec<u32>> {
        let all = &self.vertices;
        if !self.is_closed() {
            return vec![all.clone()];
        }
        let middle = all.len() / 2;
        vec![all[..=middle].to_vec(), all[middle..].to_vec()]
    }

    /// Returns rows of distinct vertices that contain each joint of two edges once.
    pub(crate) fn rows_of_joints(&self) -> Vec<Vec<u32>> {
        let all = &self.vertices;
        let edges = all.len() - 1;
        if !self.is_closed() {
            return if edges < 2 { Vec::new() } else { vec![all.clone()] };
        }
        // The last joint of a ring is the one where it closes; the vertex after the first follows it.
        let joints: Vec<usize> = (1..if self.is_ring { edges + 1 } else { edges }).collect();
        let most = edges.div_ceil(2).min(edges - 2);
        let row = |joints: &[usize]| {
            let [first, last] = [joints[0], joints[joints.len() - 1]];
            (first - 1..=last + 1).map(|k| all[k % edges]).collect()
        };
        joints.chunks(most).map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::triangle_edges::undirected;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    proptest! {
        #[test]
        fn pieces_have_each_edge_once_and_no_vertex_twice(
            edges in prop::collection::btree_set((0..9_u32, 0..9_u32).prop_filter("a loop", |(a, b)| a < b), 1..20),
        ) {
            let edges: Vec<[u32; 2]> = edges.into_iter().map(|(a, b)| [b, a]).collect();
            let mut found = Vec::new();
            let mut joints = Vec::new();
            for run in runs(&edges, 10) {
                for row in run.pieces().into_iter().chain(run.rows_of_joints()) {
                    prop_assert_eq!(row.iter().collect::<BTreeSet<_>>().len(), row.len());
                }
                found.extend(run.pieces().iter().flat_map(|row| row.windows(2).map(|two| undirected([two[0], two[1]])).collect::<Vec<_>>()));
                joints.extend(run.rows_of_joints().iter().flat_map(|row| row[1..row.len() - 1].to_vec()));
            }
            found.sort_unstable();
            let mut expected: Vec<_> = edges.iter().copied().map(undirected).collect();
            expected.sort_unstable();
            prop_assert_eq!(found, expected);
            joints.sort_unstable();
            let degree = |vertex: u32| edges.iter().filter(|ends| ends.contains(&vertex)).count();
            prop_assert_eq!(joints, (0..10).filter(|&vertex| degree(vertex) == 2).collect::<Vec<_>>());
        }
    }
}
