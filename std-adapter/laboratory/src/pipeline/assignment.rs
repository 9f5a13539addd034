//! Assigns each vertex and each edge to the triangle that represents it, once per mesh.

use selvedge::Topology;
use selvedge_core::{FeatureEdge, FeatureTriangle, Features};

/// The triangles of a mesh for distribution: lists of vertices and edges, represented ones first.
#[derive(Clone, Debug)]
pub struct FeatureAssignment {
    triangles: Vec<FeatureTriangle<u32>>,
}

impl FeatureAssignment {
    /// Assigns by the paper's greedy rule: triangle by triangle, each takes the vertices and edges that no earlier one has taken.
    /// Every vertex with a triangle, and every edge, ends up with exactly one representative.
    ///
    /// ```
    /// use selvedge::Topology;
    /// use selvedge_laboratory::pipeline::FeatureAssignment;
    /// let topology = Topology::new(4, vec![[0, 1, 2], [2, 1, 3]])?;
    /// let assignment = FeatureAssignment::representative(&topology);
    /// let counts = |k: usize| {
    ///     let features = assignment.triangles()[k].features;
    ///     (features.vertices(), features.edges())
    /// };
    /// assert_eq!((counts(0), counts(1)), ((3, 3), (1, 2)));
    /// assert_eq!(assignment.triangles()[1].vertices[0], 3);
    /// # Ok::<(), selvedge::TopologyError>(())
    /// ```
    pub fn representative(topology: &Topology) -> Self {
        let mut vertex_taken = vec![false; topology.vertex_count()];
        let mut edge_taken = vec![false; topology.edges().len()];
        let mut take = |taken: Taken| match taken {
            Taken::Vertex(vertex) => !std::mem::replace(&mut vertex_taken[vertex as usize], true),
            Taken::Edge(edge) => !std::mem::replace(&mut edge_taken[edge as usize], true),
        };
        Self::assign(topology, &mut take)
    }

    /// Lets every triangle represent all its vertices and edges, for methods that remove duplicates otherwise, or not at all.
    pub fn every_feature(topology: &Topology) -> Self {
        Self::assign(topology, &mut |_| true)
    }

    /// Returns the triangles, in the mesh's order.
    pub fn triangles(&self) -> &[FeatureTriangle<u32>] {
        &self.triangles
    }

    fn assign(topology: &Topology, take: &mut impl FnMut(Taken) -> bool) -> Self {
        let triangles = (0..topology.triangles().len())
            .map(|face| {
                let vertices = topology.triangles()[face];
                let edges = topology.triangle_edges()[face];
                let (vertices, represented_vertices) = first_taken(vertices, |k| {
                    !vertices[..k].contains(&vertices[k]) && take(Taken::Vertex(vertices[k]))
                });
                let (edges, represented_edges) = first_taken(edges, |k| {
                    edges[k] != Topology::NO_EDGE && !edges[..k].contains(&edges[k]) && take(Taken::Edge(edges[k]))
                });
                FeatureTriangle {
                    face: face as u32,
                    vertices,
                    edges: edges.map(|edge| FeatureEdge {
                        edge,
                        ends: topology.edges().get(edge as usize).copied().unwrap_or_default(),
                    }),
                    // There are never more than three of each.
                    features: Features::new(represented_vertices, represented_edges).unwrap_or_default(),
                }
            })
            .collect();
        Self { triangles }
    }
}

enum Taken {
    Vertex(u32),
    Edge(u32),
}

/// Returns the same three items with those that `take` selects first, and the number of these.
fn first_taken(items: [u32; 3], mut take: impl FnMut(usize) -> bool) -> ([u32; 3], u8) {
    let taken = [take(0), take(1), take(2)];
    let mut order = [0, 1, 2];
    order.sort_by_key(|&k: &usize| !taken[k]);
    (order.map(|k| items[k]), taken.iter().map(|&taken| u8::from(taken)).sum())
}
