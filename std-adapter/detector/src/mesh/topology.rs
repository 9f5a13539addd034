//! The vertices, edges and triangles of a mesh, and how they are connected.

use super::components;
use super::edges::{MAX_TRIANGLES, NO_EDGE, Named, find_edges};
use super::error::TopologyError;
use super::features::FeaturePair;
use selvedge_core::PairKind;

/// The vertices, edges and triangles of a mesh.
///
/// The mesh may be anything that a file can hold. It may have edges with one, two or more triangles, several components, vertices
/// without a triangle, duplicate triangles, and triangles that name a vertex twice. Nothing is dropped or renumbered.
///
/// [Loose edges and points](Self::with_loose_features), for ropes, hair and particles, are faces that name a vertex twice or
/// three times. They collide as the segment or point that they are.
///
/// ```
/// use selvedge::Topology;
///
/// // Two triangles that share the edge 1-2, and vertex 4, which has no triangle.
/// let topology = Topology::new(5, vec![[0, 1, 2], [2, 1, 3]])?;
/// assert_eq!(topology.edges(), [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]);
/// assert_eq!(topology.triangle_edges(), [[0, 2, 1], [2, 3, 4]]);
/// assert_eq!(topology.statistics().interior_edges, 1);
/// assert_eq!(topology.statistics().isolated_vertices, 1);
/// # Ok::<(), selvedge::TopologyError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    vertex_count: usize,
    /// Triangles, then loose edges, then points.
    triangles: Vec<[u32; 3]>,
    /// The number of loose edges, and of points.
    loose: [usize; 2],
    edges: Vec<[u32; 2]>,
    triangle_edges: Vec<[u32; 3]>,
}

impl Topology {
    /// Marks a side without an edge in [`triangle_edges`](Self::triangle_edges), where both ends are the same vertex.
    pub const NO_EDGE: u32 = NO_EDGE;

    /// The largest number of triangles. Three edges of each must have numbers below [`NO_EDGE`](Self::NO_EDGE).
    pub const MAX_TRIANGLES: usize = MAX_TRIANGLES;

    /// Finds the edges of `triangles`.
    ///
    /// It takes O(v + n log d) time for v vertices, n triangles and at most d edges at a vertex. It takes O(n log n) if few of
    /// many vertices have a triangle. Memory is proportional to the number of triangles.
    ///
    /// # Errors
    /// Returns an error if there are no triangles or more than a `u32` can number, or a triangle names a vertex that does not
    /// exist.
    pub fn new(vertex_count: usize, triangles: Vec<[u32; 3]>) -> Result<Self, TopologyError> {
        Self::with_loose_features(vertex_count, triangles, &[], &[])
    }

    /// Makes a topology with edges and points that need not belong to a triangle: ropes, hair, wires, particles. There may be no
    /// triangles at all.
    ///
    /// Each loose edge or point is one more face, after the triangles: an edge is (a, b, b), a point (p, p, p). A face without
    /// area is a segment or a point, so the same certified and exact tests apply, with the same guarantees. Pairs of a vertex
    /// with such a face are [`PairKind::VertexFace`]; [`features_of`](Self::features_of) says what they are.
    ///
    /// * **Every edge is tested with every edge**, loose or not.
    /// * **Every vertex of a primitive is tested with every loose edge and every point.** Two points make two pairs, one in each
    ///   order. Where a vertex meets a loose edge, the edges that end in the vertex meet it too, unless they share a vertex with
    ///   it. So one touch often gives several contacts, as it does for triangles.
    /// * A vertex that belongs to no primitive touches nothing; name it a point. Without a separation, points touch only if they
    ///   meet exactly.
    ///
    /// ```
    /// use selvedge::{CollisionDetector, Criterion, FeaturePair, Topology};
    /// use selvedge_core::elementary::Limits;
    ///
    /// // A particle, 2, falls past a rope of one piece, and comes within 0.1 of it; another, 3, never does.
    /// let topology = Topology::with_loose_features(4, vec![], &[[0, 1]], &[2, 3])?;
    /// let start = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.05, 1.0], [0.5, 9.0, 1.0]];
    /// let mut end = start;
    /// end[2][2] = -1.0;
    ///
    /// let mut detector = CollisionDetector::<f64>::new(topology);
    /// detector.set_criterion(Criterion::Within(Limits { tolerance: 1e-6, separation: 0.1 }))?;
    /// let mut contacts = Vec::new();
    /// detector.contacts(&start, &end, &mut contacts)?;
    /// let features = contacts.iter().map(|contact| detector.topology().features_of(contact.kind, contact.pair));
    /// assert!(features.eq([FeaturePair::VertexEdge { vertex: 2, edge: 0 }]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if there are no primitives or more than a `u32` can number, or one names a vertex that does not exist.
    pub fn with_loose_features(
        vertex_count: usize,
        mut triangles: Vec<[u32; 3]>,
        edges: &[[u32; 2]],
        points: &[u32],
    ) -> Result<Self, TopologyError> {
        let faces = triangles.len().saturating_add(edges.len()).saturating_add(points.len());
        if faces == 0 {
            return Err(TopologyError::NoTriangles);
        }
        if vertex_count > u32::MAX as usize || faces > Self::MAX_TRIANGLES {
            return Err(TopologyError::TooLarge {
                vertex_count,
                triangle_count: faces,
            });
        }
        let unknown = |vertices: &[u32]| vertices.iter().copied().find(|&vertex| vertex as usize >= vertex_count);
        for (triangle, vertices) in triangles.iter().enumerate() {
            if let Some(vertex) = unknown(vertices) {
                return Err(TopologyError::VertexOutOfRange {
                    triangle,
                    vertex,
                    vertex_count,
                });
            }
        }
        let unknown_of = |(index, vertices): (usize, &[u32]), is_point| {
            unknown(vertices).map(|vertex| TopologyError::LooseVertexOutOfRange {
                index,
                is_point,
                vertex,
                vertex_count,
            })
        };
        let mut of_edges = edges.iter().map(<[u32; 2]>::as_slice).enumerate();
        let mut of_points = points.iter().map(std::slice::from_ref).enumerate();
        let first = of_edges.find_map(|edge| unknown_of(edge, false));
        if let Some(error) = first.or_else(|| of_points.find_map(|point| unknown_of(point, true))) {
            return Err(error);
        }
        triangles.extend(edges.iter().map(|&[a, b]| [a, b, b]));
        triangles.extend(points.iter().map(|&point| [point; 3]));
        let (found, triangle_edges) = find_edges(&Named::new(vertex_count, &triangles));
        Ok(Self {
            vertex_count,
            triangles,
            loose: [edges.len(), points.len()],
            edges: found,
            triangle_edges,
        })
    }

    /// Returns the features of a pair of this kind. A face that names a vertex twice is an edge; one that names it three times is
    /// a point.
    ///
    /// ```
    /// use selvedge::{FeaturePair, PairKind, Topology};
    /// let topology = Topology::with_loose_features(6, vec![[0, 1, 2]], &[[3, 4]], &[5])?;
    /// assert_eq!(topology.edges()[3], [3, 4]);
    /// let features = |pair| topology.features_of(PairKind::VertexFace, pair);
    /// assert_eq!(features([5, 0]), FeaturePair::VertexFace { vertex: 5, face: 0 });
    /// assert_eq!(features([0, 1]), FeaturePair::VertexEdge { vertex: 0, edge: 3 });
    /// assert_eq!(features([3, 2]), FeaturePair::VertexVertex { vertices: [3, 5] });
    /// # Ok::<(), selvedge::TopologyError>(())
    /// ```
    ///
    /// # Panics
    /// Panics if the pair is not of this mesh.
    #[must_use]
    pub fn features_of(&self, kind: PairKind, pair: [u32; 2]) -> FeaturePair {
        let [vertex, face] = pair;
        if kind == PairKind::EdgeEdge {
            return FeaturePair::EdgeEdge { edges: pair };
        }
        let corners = self.triangles[face as usize];
        let edges = self.triangle_edges[face as usize];
        match edges.into_iter().find(|&edge| edge != Self::NO_EDGE) {
            None => FeaturePair::VertexVertex {
                vertices: [vertex, corners[0]],
            },
            Some(edge) if is_degenerate(&corners) => FeaturePair::VertexEdge { vertex, edge },
            Some(_) => FeaturePair::VertexFace { vertex, face },
        }
    }

    /// Returns the four vertices of a pair of this kind: the vertex and the three of the face, or the ends of the two edges.
    ///
    /// # Panics
    /// Panics if the pair is not of this mesh.
    #[inline]
    #[must_use]
    pub fn vertices_of(&self, kind: PairKind, pair: [u32; 2]) -> [u32; 4] {
        let [first, second] = pair.map(|feature| feature as usize);
        match kind {
            PairKind::VertexFace => {
                let [a, b, c] = self.triangles[second];
                [pair[0], a, b, c]
            }
            PairKind::EdgeEdge => {
                let ([a, b], [c, d]) = (self.edges[first], self.edges[second]);
                [a, b, c, d]
            }
        }
    }

    pub(crate) fn has_pair(&self, kind: PairKind, pair: [u32; 2]) -> bool {
        let edges = self.edges.len();
        let [firsts, seconds] = match kind {
            PairKind::VertexFace => [self.vertex_count, self.triangles.len()],
            PairKind::EdgeEdge => [edges, edges],
        };
        let [first, second] = pair.map(|primitive| primitive as usize);
        first < firsts && second < seconds
    }

    /// Returns the number of vertices, including those without a triangle.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// Returns the three vertices of each triangle, as given. Then follow [loose edges and points](Self::with_loose_features),
    /// which name a vertex twice or three times.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns each edge once, as `[smaller vertex, larger vertex]`, sorted by the larger vertex and then by the smaller. Public
    /// collision benchmarks number edges in this order.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// Returns the three edges of each triangle, as indices into [`edges`](Self::edges). Entry k joins the triangle's vertices k
    /// and (k + 1) mod 3.
    ///
    /// A degenerate triangle (v, v, w) has [`NO_EDGE`](Self::NO_EDGE) where both ends are v. Its other two entries name the
    /// *same* edge. A triangle (v, v, v) has no edge.
    #[must_use]
    pub fn triangle_edges(&self) -> &[[u32; 3]] {
        &self.triangle_edges
    }

    /// Returns, for each vertex, the vertex with the smallest number in its connected component.
    ///
    /// ```
    /// let topology = selvedge::Topology::new(7, vec![[0, 1, 2], [5, 3, 4]])?;
    /// assert_eq!(topology.components(), [0, 0, 0, 3, 3, 3, 6]);
    /// # Ok::<(), selvedge::TopologyError>(())
    /// ```
    #[must_use]
    pub fn components(&self) -> Vec<u32> {
        components::of_triangles(self.vertex_count, &self.triangles).into_firsts()
    }

    /// Returns the triangles without loose edges and points.
    #[must_use]
    pub fn proper_triangles(&self) -> &[[u32; 3]] {
        &self.triangles[..self.triangles.len() - self.loose[0] - self.loose[1]]
    }

    /// Returns the ends of the [loose edges](Self::with_loose_features), as given.
    ///
    /// ```
    /// let topology = selvedge::Topology::with_loose_features(6, vec![[0, 1, 2]], &[[4, 3]], &[5])?;
    /// assert!(topology.loose_edges().eq([[4, 3]]) && topology.points().eq([5]));
    /// assert_eq!(topology.proper_triangles(), [[0, 1, 2]]);
    /// # Ok::<(), selvedge::TopologyError>(())
    /// ```
    #[must_use]
    pub fn loose_edges(&self) -> impl ExactSizeIterator<Item = [u32; 2]> {
        let first = self.proper_triangles().len();
        self.triangles[first..first + self.loose[0]].iter().map(|&[a, b, _]| [a, b])
    }

    /// Returns the numbers of loose edges and of points.
    pub(super) const fn loose(&self) -> [usize; 2] {
        self.loose
    }

    /// Returns the vertices of the [points](Self::with_loose_features), as given.
    #[must_use]
    pub fn points(&self) -> impl ExactSizeIterator<Item = u32> {
        let first = self.triangles.len() - self.loose[1];
        self.triangles[first..].iter().map(|&[point, ..]| point)
    }
}

/// Returns whether a triangle names a vertex twice.
pub(super) fn is_degenerate(&[a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}
