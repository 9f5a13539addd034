//! The vertices, edges and triangles of a mesh, and how they hang together.

use crate::PairKind;
use std::borrow::Cow;
use std::fmt;

/// The vertices, edges and triangles of a mesh that may be anything a file can hold: edges with
/// one, two or more triangles, several components, vertices without a triangle, duplicate
/// triangles, and triangles that name a vertex twice. Nothing is dropped or renumbered.
///
/// [Loose edges and points](Self::with_loose_features), of ropes, hair and particles, are faces that name a vertex twice, or three
/// times: such collide as what they are, a segment and a point.
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
    /// Triangles, and then what is loose.
    triangles: Vec<[u32; 3]>,
    /// How many of them are loose edges, and points.
    loose: [usize; 2],
    edges: Vec<[u32; 2]>,
    triangle_edges: Vec<[u32; 3]>,
}

/// What the two sides of a [pair](Topology::features_of) are, numbered as by the [`Topology`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FeaturePair {
    /// A vertex and a point.
    VertexVertex {
        /// The vertex, and the point's vertex.
        vertices: [u32; 2],
    },
    /// A vertex and a loose edge.
    VertexEdge {
        /// The vertex.
        vertex: u32,
        /// The edge.
        edge: u32,
    },
    /// A vertex and a triangle.
    VertexFace {
        /// The vertex.
        vertex: u32,
        /// The face.
        face: u32,
    },
    /// Two edges, of triangles or loose.
    EdgeEdge {
        /// The edges, the smaller number first.
        edges: [u32; 2],
    },
}

/// Why a list of triangles has no [`Topology`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TopologyError {
    /// A triangle names a vertex that does not exist.
    VertexOutOfRange {
        /// The first such triangle.
        triangle: usize,
        /// The vertex that it names.
        vertex: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// A loose edge, or a point, names a vertex that does not exist.
    LooseVertexOutOfRange {
        /// The first such edge, or point, in the list that was given.
        index: usize,
        /// Whether it is a point.
        is_point: bool,
        /// The vertex that it names.
        vertex: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// There are no triangles, and no loose edges or points.
    NoTriangles,
    /// Vertices, or the corners of all triangles, are too many to be numbered by a `u32`.
    TooLarge {
        /// How many vertices there are.
        vertex_count: usize,
        /// How many triangles there are.
        triangle_count: usize,
    },
}

impl fmt::Display for TopologyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::VertexOutOfRange {
                triangle,
                vertex,
                vertex_count,
            } => write!(
                f,
                "triangle {triangle} names vertex {vertex}, but there are {vertex_count} vertices, numbered from 0"
            ),
            Self::LooseVertexOutOfRange {
                index,
                is_point,
                vertex,
                vertex_count,
            } => write!(
                f,
                "{} {index} names vertex {vertex}, but there are {vertex_count} vertices, numbered from 0",
                if is_point { "point" } else { "loose edge" }
            ),
            Self::NoTriangles => f.write_str("the mesh has no triangles"),
            Self::TooLarge {
                vertex_count,
                triangle_count,
            } => write!(
                f,
                "the mesh has {vertex_count} vertices and {triangle_count} triangles: more than {} vertices or {} triangles cannot be numbered",
                u32::MAX,
                Topology::MAX_TRIANGLES
            ),
        }
    }
}

impl std::error::Error for TopologyError {}

impl Topology {
    /// Stands in [`triangle_edges`](Self::triangle_edges) where a triangle has no edge because
    /// both ends are the same vertex.
    pub const NO_EDGE: u32 = u32::MAX;

    /// The most triangles: three edges to each must be numbered below [`NO_EDGE`](Self::NO_EDGE).
    pub const MAX_TRIANGLES: usize = (u32::MAX / 3) as usize;

    /// Finds the edges of `triangles`, in O(v + n log d) time for v vertices, n triangles and at
    /// most d edges to a vertex; in O(n log n) if few of many vertices have a triangle. Memory is bounded by what the triangles name.
    ///
    /// # Errors
    /// If there are no triangles, a triangle names a vertex that does not exist, or there are more
    /// than a `u32` can number.
    pub fn new(vertex_count: usize, triangles: Vec<[u32; 3]>) -> Result<Self, TopologyError> {
        Self::with_loose_features(vertex_count, triangles, &[], &[])
    }

    /// As [`new`](Self::new), with edges and points that need belong to no triangle: ropes, hair, wires, particles. There may be
    /// no triangles at all.
    ///
    /// Each is one more face, in their order after the triangles: an edge is (a, b, b), a point (p, p, p). A detector asks the same
    /// certified and exact tests about them as about triangles, and all that is promised of those holds: a face without area is a
    /// segment, or a point. So pairs of vertices with them are [`PairKind::VertexFace`], and [`features_of`](Self::features_of) says
    /// what they are.
    ///
    /// * **Every edge with every edge**, loose or not, as ever.
    /// * **Every vertex that something names with every loose edge and every point.** Two points are a pair twice, either first. A vertex
    ///   at an edge is also told of by the edges that end in it, if any; but not by those that share a vertex with that edge: where a
    ///   rope's end folds back, say. So one touch is often several contacts, as that of a vertex and an edge of triangles is.
    /// * A vertex that nothing names touches nothing: name it a point. Without separation points touch only if they meet exactly.
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
    /// If there is nothing, something names a vertex that does not exist, or there are more than a `u32` can number.
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
        let (found, triangle_edges) = find_edges(&Named::by(vertex_count, &triangles));
        Ok(Self {
            vertex_count,
            triangles,
            loose: [edges.len(), points.len()],
            edges: found,
            triangle_edges,
        })
    }

    /// What the two sides of a pair of this kind are: a face that names a vertex twice is an edge, three times a point.
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
    /// If the pair is not of this mesh.
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

    /// The four vertices of a pair of this kind: the vertex and the face's three, or the two edges' ends.
    ///
    /// # Panics
    /// If the pair is not of this mesh.
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

    /// Whether the pair is of this mesh.
    pub(crate) fn has_pair(&self, kind: PairKind, pair: [u32; 2]) -> bool {
        let edges = self.edges.len();
        let [firsts, seconds] = match kind {
            PairKind::VertexFace => [self.vertex_count, self.triangles.len()],
            PairKind::EdgeEdge => [edges, edges],
        };
        let [first, second] = pair.map(|primitive| primitive as usize);
        first < firsts && second < seconds
    }

    /// How many vertices there are, those without a triangle included.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// The three vertices of each triangle, as given; then [loose edges and points](Self::with_loose_features), which name a vertex
    /// twice, or three times.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Each edge once, as `[smaller vertex, larger vertex]`, sorted by the larger vertex, then by
    /// the smaller. Public collision benchmarks number edges in this order.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The three edges of each triangle, as indices into [`edges`](Self::edges): entry k joins the
    /// triangle's vertices k and (k + 1) mod 3.
    ///
    /// A degenerate triangle (v, v, w) has [`NO_EDGE`](Self::NO_EDGE) where both ends are v, and
    /// its other two entries name the *same* edge. A triangle (v, v, v) has no edge at all.
    #[must_use]
    pub fn triangle_edges(&self) -> &[[u32; 3]] {
        &self.triangle_edges
    }

    /// For each vertex the one with the smallest number that triangles connect it to: the same for all of a component.
    ///
    /// ```
    /// let topology = selvedge::Topology::new(7, vec![[0, 1, 2], [5, 3, 4]])?;
    /// assert_eq!(topology.components(), [0, 0, 0, 3, 3, 3, 6]);
    /// # Ok::<(), selvedge::TopologyError>(())
    /// ```
    #[must_use]
    pub fn components(&self) -> Vec<u32> {
        firsts(self.vertex_count, &self.triangles)
    }

    /// Counts what is unusual about the mesh. Takes about as long as [`Topology::new`].
    #[must_use]
    pub fn statistics(&self) -> TopologyStatistics {
        let (components, used) = count_components(&Named::by(self.vertex_count, &self.triangles));
        let [loose_edges, points] = self.loose;
        let triangles = self.proper_triangles();
        let mut statistics = TopologyStatistics {
            components,
            isolated_vertices: self.vertex_count - used,
            degenerate_triangles: triangles.iter().filter(|t| is_degenerate(t)).count(),
            duplicate_triangles: count_duplicates(&Named::by(self.vertex_count, triangles)),
            loose_edges,
            points,
            ..TopologyStatistics::default()
        };
        for count in self.triangles_per_edge() {
            match count {
                // A loose one.
                0 => {}
                1 => statistics.boundary_edges += 1,
                2 => statistics.interior_edges += 1,
                _ => statistics.non_manifold_edges += 1,
            }
        }
        statistics
    }

    /// The vertices of what was given as triangles.
    #[must_use]
    pub fn proper_triangles(&self) -> &[[u32; 3]] {
        &self.triangles[..self.triangles.len() - self.loose[0] - self.loose[1]]
    }

    /// The ends of [loose edges](Self::with_loose_features), as given.
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

    /// The vertices of [points](Self::with_loose_features), as given.
    #[must_use]
    pub fn points(&self) -> impl ExactSizeIterator<Item = u32> {
        let first = self.triangles.len() - self.loose[1];
        self.triangles[first..].iter().map(|&[point, ..]| point)
    }

    /// How many triangles each edge has; a triangle (v, v, w) counts once for its edge v-w.
    fn triangles_per_edge(&self) -> Vec<u32> {
        let mut counts = vec![0; self.edges.len()];
        for &[a, b, c] in &self.triangle_edges[..self.proper_triangles().len()] {
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

/// What is unusual about a mesh. None of it is an error: everything is kept and takes part in
/// collision, except isolated vertices, which belong to nothing and so can touch nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TopologyStatistics {
    /// Sets of triangles, loose edges and points connected through shared vertices.
    pub components: usize,
    /// Vertices without a triangle, and that are not loose. They keep their number.
    pub isolated_vertices: usize,
    /// Edges with one triangle.
    pub boundary_edges: usize,
    /// Edges with two triangles.
    pub interior_edges: usize,
    /// Edges with three triangles or more.
    pub non_manifold_edges: usize,
    /// Triangles with the same set of vertices as an earlier one, whatever the order.
    pub duplicate_triangles: usize,
    /// Triangles that name a vertex twice. A triangle of zero area with three different vertices
    /// is not counted: that is geometry, and changes as the mesh moves.
    pub degenerate_triangles: usize,
    /// [Loose edges](Topology::with_loose_features) that were given.
    pub loose_edges: usize,
    /// Points that were given.
    pub points: usize,
}

impl fmt::Display for TopologyStatistics {
    /// One line that names only what is there: `1 component, 41 boundary and 1996 interior edges`.
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

pub(super) fn is_degenerate(&[a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// The vertices that triangles name, numbered so that a list of them all is not much longer than that of the triangles.
struct Named<'a> {
    vertex_count: usize,
    triangles: Cow<'a, [[u32; 3]]>,
    /// The vertices by their own numbers, in order, if they have others.
    names: Option<Vec<u32>>,
}

/// Vertices for each corner of a triangle, from which on most must be without one. A mesh has one for each six.
const SPARSE: usize = 4;

impl<'a> Named<'a> {
    fn by(vertex_count: usize, triangles: &'a [[u32; 3]]) -> Self {
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
        // It is there: the list is of all of them.
        let number = |vertex: u32| names.partition_point(|&name| name < vertex) as u32;
        Self {
            vertex_count: names.len(),
            triangles: triangles.iter().map(|corners| corners.map(number)).collect(),
            names: Some(names),
        }
    }

    /// The mesh's own number of a vertex. In the same order.
    fn name(&self, vertex: u32) -> u32 {
        self.names.as_ref().map_or(vertex, |names| names[vertex as usize])
    }
}

/// Edges in their order, and each triangle's three.
fn find_edges(named: &Named<'_>) -> (Vec<[u32; 2]>, Vec<[u32; 3]>) {
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
    let groups = Groups::new(named.vertex_count, slots);

    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(triangles.len() * 3 / 2);
    let mut triangle_edges = vec![[Topology::NO_EDGE; 3]; triangles.len()];
    for (larger, group) in groups.iter() {
        for same_edge in group.chunk_by(|a, b| a.0 == b.0) {
            for &(_, slot) in same_edge {
                triangle_edges[slot as usize / 3][slot as usize % 3] = edges.len() as u32;
            }
            edges.push([same_edge[0].0, larger].map(|end| named.name(end)));
        }
    }
    (edges, triangle_edges)
}

/// How many triangles have the same set of vertices as an earlier one.
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
    let groups = Groups::new(named.vertex_count, keys);
    let distinct: usize = groups.iter().map(|(_, group)| group.chunk_by(|a, b| a == b).count()).sum();
    triangles.len() - distinct
}

/// How many sets of connected triangles there are, and how many vertices with a triangle.
fn count_components(named: &Named<'_>) -> (usize, usize) {
    let mut is_used = vec![false; named.vertex_count];
    let vertices = named.triangles.iter().flatten();
    vertices.for_each(|&vertex| is_used[vertex as usize] = true);
    let used = is_used.iter().filter(|&&is_used| is_used).count();
    let own = (0..).zip(firsts(named.vertex_count, &named.triangles)).zip(is_used);
    let components = own.filter(|&((vertex, first), is_used)| is_used && vertex == first).count();
    (components, used)
}

/// For each vertex the one with the smallest number of its component.
fn firsts(vertex_count: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    // Union-find over vertices, by path halving and the smaller number as root.
    let mut parents: Vec<u32> = (0..vertex_count as u32).collect();
    for &[a, b, c] in triangles {
        for (u, v) in [(a, b), (b, c)] {
            let (u, v) = (root(&mut parents, u), root(&mut parents, v));
            parents[u.max(v) as usize] = u.min(v);
        }
    }
    (0..vertex_count as u32).map(|vertex| root(&mut parents, vertex)).collect()
}

fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let grandparent = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = grandparent;
        vertex = grandparent;
    }
    vertex
}

/// Items grouped by a key below a known bound and sorted within each group: a counting sort by
/// key, then a small sort for each group. A mesh has few items to a vertex, so this is much faster
/// than sorting everything at once.
#[derive(Debug)]
pub(super) struct Groups<T> {
    /// Group k is `items[starts[k]..starts[k + 1]]`.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T: Copy + Default + Ord> Groups<T> {
    pub(super) fn new(key_count: usize, keyed: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        let mut starts = vec![0_u32; key_count + 1];
        for (key, _) in keyed.clone() {
            starts[key as usize + 1] += 1;
        }
        for key in 0..key_count {
            starts[key + 1] += starts[key];
        }
        let mut items = vec![T::default(); starts[key_count] as usize];
        let mut next = starts.clone();
        for (key, item) in keyed {
            let place = &mut next[key as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        for key in 0..key_count {
            items[starts[key] as usize..starts[key + 1] as usize].sort_unstable();
        }
        Self { starts, items }
    }

    /// The group of a key.
    pub(super) fn of(&self, key: usize) -> &[T] {
        &self.items[self.starts[key] as usize..self.starts[key + 1] as usize]
    }

    /// The groups in order of their keys; some may be empty.
    fn iter(&self) -> impl Iterator<Item = (u32, &[T])> {
        self.starts.windows(2).enumerate().map(|(key, bounds)| {
            let group = &self.items[bounds[0] as usize..bounds[1] as usize];
            (key as u32, group)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::{BTreeMap, BTreeSet};

    /// Any triangles over a few vertices: many duplicates, degenerates and non-manifold edges.
    fn index_soup() -> impl Strategy<Value = (usize, Vec<[u32; 3]>)> {
        (1..9_u32).prop_flat_map(|vertex_count| {
            let triangles = prop::collection::vec(prop::array::uniform3(0..vertex_count), 1..24);
            (Just(vertex_count as usize), triangles)
        })
    }

    fn naive_edges(triangles: &[[u32; 3]]) -> BTreeMap<(u32, u32), BTreeSet<usize>> {
        let mut edges: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
        for (index, t) in triangles.iter().enumerate() {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                if a != b {
                    edges.entry((a.max(b), a.min(b))).or_default().insert(index);
                }
            }
        }
        edges
    }

    /// Grows each component until nothing more joins it.
    fn naive_components(triangles: &[[u32; 3]]) -> usize {
        let mut rest: Vec<BTreeSet<u32>> = triangles.iter().map(|t| t.iter().copied().collect()).collect();
        let mut components = 0;
        while let Some(mut component) = rest.pop() {
            while let Some(index) = rest.iter().position(|t| !t.is_disjoint(&component)) {
                component.extend(rest.swap_remove(index));
            }
            components += 1;
        }
        components
    }

    proptest! {
        #[test]
        fn vertices_without_a_triangle_change_no_edge_but_its_vertices_numbers((n, triangles) in index_soup()) {
            let far = |vertex: u32| 400_000_000 * vertex + 5;
            let topology = Topology::new(n, triangles.clone()).unwrap();
            let scattered = triangles.iter().map(|corners| corners.map(far)).collect();
            let scattered = Topology::new(u32::MAX as usize, scattered).unwrap();
            let edges: Vec<_> = topology.edges().iter().map(|ends| ends.map(far)).collect();
            prop_assert_eq!(scattered.edges(), edges);
            prop_assert_eq!(scattered.triangle_edges(), topology.triangle_edges());
            let expected = topology.statistics();
            let isolated_vertices = expected.isolated_vertices + u32::MAX as usize - n;
            prop_assert_eq!(scattered.statistics(), TopologyStatistics { isolated_vertices, ..expected });
        }

        #[test]
        fn edges_are_each_found_once_and_sorted_by_larger_then_smaller_vertex((n, triangles) in index_soup()) {
            let topology = Topology::new(n, triangles.clone()).unwrap();
            let expected: Vec<[u32; 2]> = naive_edges(&triangles).keys().map(|&(large, small)| [small, large]).collect();
            prop_assert_eq!(topology.edges(), expected);
        }

        #[test]
        fn a_triangles_edge_k_joins_its_vertices_k_and_k_plus_1((n, triangles) in index_soup()) {
            let topology = Topology::new(n, triangles.clone()).unwrap();
            prop_assert_eq!(topology.triangles(), &triangles);
            for (triangle, edges) in triangles.iter().zip(topology.triangle_edges()) {
                for k in 0..3 {
                    let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                    if a == b {
                        prop_assert_eq!(edges[k], Topology::NO_EDGE);
                    } else {
                        prop_assert_eq!(topology.edges()[edges[k] as usize], [a.min(b), a.max(b)]);
                    }
                }
            }
        }

        #[test]
        fn statistics_agree_with_a_naive_recount((n, triangles) in index_soup()) {
            let statistics = Topology::new(n, triangles.clone()).unwrap().statistics();
            let edges = naive_edges(&triangles);
            let edges_with = |wanted: fn(usize) -> bool| edges.values().filter(|t| wanted(t.len())).count();
            let sets: Vec<BTreeSet<u32>> = triangles.iter().map(|t| t.iter().copied().collect()).collect();
            let used: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
            prop_assert_eq!(statistics, TopologyStatistics {
                components: naive_components(&triangles),
                isolated_vertices: n - used.len(),
                boundary_edges: edges_with(|count| count == 1),
                interior_edges: edges_with(|count| count == 2),
                non_manifold_edges: edges_with(|count| count >= 3),
                duplicate_triangles: (0..sets.len()).filter(|&i| sets[..i].contains(&sets[i])).count(),
                degenerate_triangles: sets.iter().filter(|set| set.len() < 3).count(),
                loose_edges: 0,
                points: 0,
            });
        }
    }

    #[test]
    fn a_triangle_that_names_a_vertex_twice_has_one_edge_in_two_entries() {
        let topology = Topology::new(2, vec![[0, 0, 1]]).unwrap();
        assert_eq!(topology.edges(), [[0, 1]]);
        assert_eq!(topology.triangle_edges(), [[Topology::NO_EDGE, 0, 0]]);
        assert_eq!(topology.statistics().boundary_edges, 1);
    }

    #[test]
    fn a_triangle_of_one_vertex_has_no_edge_and_is_a_component() {
        let topology = Topology::new(1, vec![[0, 0, 0]]).unwrap();
        assert_eq!(topology.triangle_edges(), [[Topology::NO_EDGE; 3]]);
        assert_eq!(topology.statistics().components, 1);
        assert_eq!(topology.statistics().isolated_vertices, 0);
    }

    #[test]
    fn an_index_out_of_range_is_refused_with_the_first_triangle_and_its_vertex() {
        let error = Topology::new(3, vec![[0, 1, 2], [0, 3, 1], [9, 9, 9]]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "triangle 1 names vertex 3, but there are 3 vertices, numbered from 0"
        );
    }

    #[test]
    fn a_mesh_without_triangles_is_refused() {
        assert_eq!(Topology::new(3, vec![]).unwrap_err(), TopologyError::NoTriangles);
    }

    #[test]
    fn more_vertices_than_a_u32_can_number_are_refused_before_memory_is_asked_for() {
        let error = Topology::new(usize::MAX, vec![[0, 1, 2]]).unwrap_err();
        assert!(matches!(error, TopologyError::TooLarge { .. }), "{error}");
    }

    #[test]
    fn statistics_print_only_what_is_unusual() {
        let plain = Topology::new(3, vec![[0, 1, 2]]).unwrap().statistics();
        assert_eq!(plain.to_string(), "1 component, 3 boundary and 0 interior edges");
        let odd = Topology::new(5, vec![[0, 1, 2], [2, 1, 0], [3, 3, 3]]).unwrap().statistics();
        assert_eq!(
            odd.to_string(),
            "2 components, 0 boundary and 3 interior edges, 1 isolated vertex, 1 duplicate triangle, 1 degenerate triangle"
        );
    }
}
