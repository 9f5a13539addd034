//! Counts of unusual properties of a mesh.

use super::adjacency::Adjacency;
use super::components;
use super::edges::Named;
use super::topology::{Topology, is_degenerate};
use std::fmt;

/// Counts of unusual properties of a mesh. They are not errors. Everything takes part in collision except isolated vertices,
/// which belong to no primitive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TopologyStatistics {
    /// The number of sets of triangles, loose edges and points connected through shared vertices.
    pub components: usize,
    /// The number of vertices without a triangle, loose edge or point. They keep their numbers.
    pub isolated_vertices: usize,
    /// The number of edges with one triangle.
    pub boundary_edges: usize,
    /// The number of edges with two triangles.
    pub interior_edges: usize,
    /// The number of edges with three triangles or more.
    pub non_manifold_edges: usize,
    /// The number of triangles with the same set of vertices as an earlier one, in any order.
    pub duplicate_triangles: usize,
    /// The number of triangles that name a vertex twice. A triangle of zero area with three different vertices is not counted:
    /// its area changes as the mesh moves.
    pub degenerate_triangles: usize,
    /// The number of [loose edges](Topology::with_loose_features) that were given.
    pub loose_edges: usize,
    /// The number of points that were given.
    pub points: usize,
}

impl fmt::Display for TopologyStatistics {
    /// Writes one line that names only non-zero counts: `1 component, 41 boundary and 1996 interior edges`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let s = |count| if count == 1 { "" } else { "s" };
        write!(
            f,
            "{} component{}, {} boundary and {} interior edges",
            self.components,
            s(self.components),
            self.boundary_edges,
            self.interior_edges
        )?;
        for (count, singular, plural) in [
            (self.non_manifold_edges, "non-manifold edge", "non-manifold edges"),
            (self.isolated_vertices, "isolated vertex", "isolated vertices"),
            (self.duplicate_triangles, "duplicate triangle", "duplicate triangles"),
            (self.degenerate_triangles, "degenerate triangle", "degenerate triangles"),
            (self.loose_edges, "loose edge", "loose edges"),
            (self.points, "point", "points"),
        ] {
            if count > 0 {
                write!(f, ", {count} {}", if count == 1 { singular } else { plural })?;
            }
        }
        Ok(())
    }
}

impl Topology {
    /// Counts unusual properties of the mesh. It takes about as long as [`Topology::new`].
    #[must_use]
    pub fn statistics(&self) -> TopologyStatistics {
        let (components, used) = count_components(&Named::new(self.vertex_count(), self.triangles()));
        let [loose_edges, points] = self.loose();
        let triangles = self.proper_triangles();
        let mut statistics = TopologyStatistics {
            components,
            isolated_vertices: self.vertex_count() - used,
            degenerate_triangles: triangles.iter().filter(|t| is_degenerate(t)).count(),
            duplicate_triangles: count_duplicates(&Named::new(self.vertex_count(), triangles)),
            loose_edges,
            points,
            ..TopologyStatistics::default()
        };
        for count in self.triangles_per_edge() {
            match count {
                // A loose edge.
                0 => {}
                1 => statistics.boundary_edges += 1,
                2 => statistics.interior_edges += 1,
                _ => statistics.non_manifold_edges += 1,
            }
        }
        statistics
    }

    /// Counts the triangles of each edge. A triangle (v, v, w) counts once for its edge v-w.
    fn triangles_per_edge(&self) -> Vec<u32> {
        let mut counts = vec![0; self.edges().len()];
        for &[a, b, c] in &self.triangle_edges()[..self.proper_triangles().len()] {
            let distinct = [Some(a), Some(b).filter(|_| b != a), Some(c).filter(|_| c != a && c != b)];
            for edge in distinct.into_iter().flatten() {
                if edge != Self::NO_EDGE {
                    counts[edge as usize] += 1;
                }
            }
        }
        counts
    }
}
/// Counts the triangles with the same set of vertices as an earlier one.
fn count_duplicates(named: &Named<'_>) -> usize {
    let triangles = &*named.triangles;
    let keys = triangles.iter().map(|&triangle| {
        let mut key = triangle;
        key.sort_unstable();
        // {v, w} is one set, whether it was written (v, v, w) or (v, w, w).
        if key[0] == key[1] {
            key[1] = key[2];
        }
        (key[2], (key[0], key[1]))
    });
    let groups = Adjacency::new(named.vertex_count, || keys.clone()).sorted();
    let distinct: usize = groups.iter().map(|group| group.chunk_by(|a, b| a == b).count()).sum();
    triangles.len() - distinct
}

/// Counts the sets of connected triangles, and the vertices that have a triangle.
fn count_components(named: &Named<'_>) -> (usize, usize) {
    let mut is_used = vec![false; named.vertex_count];
    let vertices = named.triangles.iter().flatten();
    vertices.for_each(|&vertex| is_used[vertex as usize] = true);
    let used = is_used.iter().filter(|&&is_used| is_used).count();
    let firsts = components::of_triangles(named.vertex_count, &named.triangles).into_firsts();
    let firsts = (0..).zip(firsts).zip(is_used);
    let components = firsts
        .filter(|&((vertex, first), is_used)| is_used && vertex == first)
        .count();
    (components, used)
}
