//! The three hierarchies of a mesh, and their share of a step: refit, or build, and traversal.

use super::MovingStatistics;
use super::degradation::{Degradation, Prices};
use super::neighbours::Neighbours;
use super::pairing::Pairing;
use super::pairs::Sink;
use super::rows::Rows;
use super::traversal::{BlockPair, Common, Scratch, Trees};
use super::tree::Tree;
use crate::PairKind;
use crate::buffer::settle;
use crate::mesh::Topology;
use crate::parallel;
use crate::simd::{Level, best_level};
use crate::step::{CollisionFilter, Members, Motions};
use selvedge_core::Motion;
use selvedge_core::batch::VertexRow;
use selvedge_core::boxes::mapping::{Inset, Mapping};
use selvedge_core::boxes::{Aabb, moving::MovingBox};
use std::sync::Arc;

/// An item is an edge; there are about as many vertices and faces together.
///
/// Build: measured as the time of building all three hierarchies over the time of a test, 0.6 to 0.7 of a test for each edge and
/// halving on cloth-ball (46,598 vertices) and cloth-funnel (9,450).
///
/// Item: measured just after a build, 9.5 tests an edge with 12.8 candidates an edge (cloth-ball), 5.6 with 0.8
/// (cloth-funnel), hence a third for a candidate and 5.3 for an edge besides.
pub(super) const PRICES: Prices = Prices { build: 0.65, item: 16.0 };

/// What boxes are to hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fit {
    /// How far apart pairs must be not to be candidates; not negative, finite.
    pub(crate) separation: f64,
    /// The same of neighbours, if it is less.
    pub(crate) of_neighbours: f64,
    /// When in the step the boxes of the end are taken, in (0, 1].
    pub(crate) until: f64,
    /// Boxes for the whole step instead of two for its ends.
    pub(crate) is_swept: bool,
}

impl Default for Fit {
    fn default() -> Self {
        Self {
            separation: 0.0,
            of_neighbours: f64::INFINITY,
            until: 1.0,
            is_swept: false,
        }
    }
}

impl Fit {
    fn mapping(&self, motions: &dyn Motions, extent: &Aabb<f64>) -> Mapping {
        motions.mapping(extent, self.separation, self.until, self.is_swept)
    }
}

/// A part of a traversal, of about the same work as others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Share<'a> {
    /// What it finds.
    pub(crate) kind: PairKind,
    tasks: &'a [BlockPair],
}

/// Which vertices an update looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Refit {
    /// Those that move; once, those that rest.
    Moving,
    /// All, whichever count as moving. Then what is found does not depend on the updates before.
    All,
    /// Those that move, which alone have done so since the last update. What is found fits what was found then.
    Narrowed,
}

/// Trees over vertices, edges and faces. Everything is numbered by its position in its tree: what lies close together is so
/// in memory as well, whatever the mesh's own order.
#[derive(Debug)]
pub(crate) struct Hierarchies {
    topology: Arc<Topology>,
    level: Level,
    pub(super) vertices: Tree<1>,
    pub(super) edges: Tree<2>,
    pub(super) faces: Tree<3>,
    /// For each edge by position the positions of its two ends, and the edge as the mesh numbers it: what makes an EE pair's
    /// vertices, in one place.
    edge_ends: Vec<EdgeEnds>,
    /// The position of each of the mesh's vertices; isolated ones have none.
    positions: Vec<u32>,
    rows: Rows,
    boxes: Vec<MovingBox<f32>>,
    /// Which vertices move, if not all.
    moving: Option<Vec<bool>>,
    /// Which pairs are looked at, if not all.
    filter: Option<Arc<CollisionFilter>>,
    /// Which pairs have a separation of their own.
    neighbours: Option<Arc<Neighbours>>,
    refit: Refit,
    /// What the boxes of what rests were fitted with, if they are still good.
    fitted: Option<Mapping>,
    /// What the boxes hold.
    fit: Fit,
    extent: Aabb<f64>,
    tasks: [Vec<BlockPair>; 2],
    face_edge_tasks: Vec<BlockPair>,
    task_tests: u64,
    stack: Vec<BlockPair>,
    degradation: Degradation,
    /// Whether the last update has built them, or was the first one of everything after a build.
    is_new: bool,
    is_built: bool,
    /// Whether nothing has been found yet by what was built last, but for a few vertices.
    is_unmeasured: bool,
    statistics: MovingStatistics,
}

impl Hierarchies {
    pub(crate) fn new(topology: Arc<Topology>) -> Self {
        Self {
            topology,
            level: best_level(),
            vertices: Tree::default(),
            edges: Tree::default(),
            faces: Tree::default(),
            edge_ends: Vec::new(),
            positions: Vec::new(),
            rows: Rows::default(),
            boxes: Vec::new(),
            moving: None,
            filter: None,
            neighbours: None,
            refit: Refit::Moving,
            fitted: None,
            fit: Fit::default(),
            extent: Aabb::empty(),
            tasks: [Vec::new(), Vec::new()],
            face_edge_tasks: Vec::new(),
            task_tests: 0,
            stack: Vec::new(),
            degradation: Degradation::default(),
            is_new: false,
            is_built: false,
            is_unmeasured: false,
            statistics: MovingStatistics::default(),
        }
    }

    pub(crate) const fn set_level(&mut self, level: Level) {
        self.level = level;
    }

    pub(crate) const fn level(&self) -> Level {
        self.level
    }

    pub(crate) const fn topology(&self) -> &Arc<Topology> {
        &self.topology
    }

    pub(crate) const fn statistics(&self) -> MovingStatistics {
        self.statistics
    }

    /// The motion of each vertex, by position.
    pub(crate) const fn rows(&self) -> &Rows {
        &self.rows
    }

    /// The motion of a vertex of the mesh in the last update, if it has a triangle.
    pub(crate) fn motion_of(&self, vertex: usize) -> Option<Motion<f64>> {
        let position = *self.positions.get(vertex)?;
        self.rows.double().get(position as usize).map(VertexRow::motion)
    }

    /// Makes the rows in `f32` too, if they are exact.
    pub(crate) fn narrow(&mut self) {
        self.rows.narrow();
    }

    /// From the next update on only pairs with a vertex that moves are found; `None`: all. The others' positions are taken
    /// from the next update, and not looked at after it.
    pub(crate) fn set_moving(&mut self, moving: Option<Vec<bool>>) {
        self.moving = moving;
        self.fitted = None;
        self.mark();
    }

    /// From the next update on only pairs that the filter allows are found; `None`: all.
    pub(crate) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.filter = filter;
        self.note_members();
    }

    /// From the next update on these pairs have a separation of their own.
    pub(crate) fn set_neighbours(&mut self, neighbours: Option<Arc<Neighbours>>) {
        self.neighbours = neighbours;
        self.note_rest();
    }

    /// From the next update on only pairs with a wanted vertex are found. All vertices may move.
    pub(crate) fn set_wanted(&mut self, wanted: Vec<bool>) {
        self.refit = Refit::All;
        // Then nobody has to be asked.
        let are_all = wanted.iter().all(|&wanted| wanted);
        self.set_moving((!are_all).then_some(wanted));
    }

    /// From the next update on only pairs with a wanted vertex are found, and only wanted vertices are looked at: the boxes of the
    /// others stay as the last update left them.
    pub(crate) fn narrow_to(&mut self, wanted: Vec<bool>) {
        self.refit = Refit::Narrowed;
        self.moving = Some(wanted);
        self.mark();
    }

    /// Takes the positions of a step and finds where to look for pairs.
    pub(crate) fn update(&mut self, motions: &dyn Motions, fit: &Fit) {
        self.fit_boxes(motions, fit);
        self.find_tasks();
    }

    /// Takes the positions of a step.
    pub(crate) fn fit_boxes(&mut self, motions: &dyn Motions, fit: &Fit) {
        let is_whole = self.refit != Refit::Narrowed;
        let builds = !self.is_built || is_whole && self.are_degraded();
        // Rounding of boxes follows from it.
        if builds || self.refit == Refit::All {
            self.extent = extent(motions);
        }
        if builds {
            self.build(motions);
        }
        self.is_new = is_whole && std::mem::take(&mut self.is_unmeasured);
        let mapping = fit.mapping(motions, &self.extent);
        self.refit(motions, mapping);
        self.fit = *fit;
        self.task_tests = 0;
    }

    /// Builds them from these positions if that is worth its time: with wanted vertices that changes nothing of what updates find but the order.
    pub(crate) fn build_if_degraded(&mut self, motions: &dyn Motions) {
        if self.is_built && self.are_degraded() {
            self.build(motions);
        }
    }

    fn are_degraded(&self) -> bool {
        self.degradation.is_worth_a_build(PRICES, self.edges.len())
    }

    /// The box that holds all, as the last update left it.
    pub(crate) fn bounds(&self) -> MovingBox<f32> {
        let top = self.vertices.top().map(|top| self.vertices.levels[top].nodes[0].bounds);
        top.unwrap_or_else(MovingBox::empty)
    }

    fn build(&mut self, motions: &dyn Motions) {
        let middles = Fit::default().mapping(motions, &self.extent);
        let middle = |vertex: u32| {
            let motion = motions.of(vertex as usize);
            let moving = middles.vertex(motion.start.into(), motion.end.into());
            [0, 1, 2].map(|axis| {
                let middle = 0.5 * moving.start.lower[axis] + 0.5 * moving.end.lower[axis];
                if middle.is_finite() { middle } else { 0.0 }
            })
        };
        let topology = &*self.topology;
        let (edges, faces) = (topology.edges(), topology.triangles());
        // Which vertices have a triangle.
        self.positions.clear();
        self.positions.resize(topology.vertex_count(), NOWHERE);
        for &vertex in faces.iter().flatten() {
            self.positions[vertex as usize] = 0;
        }
        let positions = &self.positions;
        let used = (0..topology.vertex_count() as u32).filter(|&vertex| positions[vertex as usize] != NOWHERE);
        self.vertices.build(used, middle);
        for (position, &vertex) in (0..).zip(&self.vertices.primitives) {
            self.positions[vertex as usize] = position;
        }
        self.edges
            .build(0..edges.len() as u32, |edge| mean(edges[edge as usize].map(middle)));
        self.faces
            .build(0..faces.len() as u32, |face| mean(faces[face as usize].map(middle)));

        let positions = &self.positions;
        let position = |vertex: u32| positions[vertex as usize];
        self.vertices.connect(|vertex| [position(vertex)]);
        self.edges.connect(|edge| edges[edge as usize].map(position));
        self.faces.connect(|face| faces[face as usize].map(position));
        let edges = self.edges.vertices.iter().zip(&self.edges.primitives);
        self.edge_ends.clear();
        self.edge_ends.extend(edges.map(|(&ends, &edge)| EdgeEnds { ends, edge }));
        self.rows.clear();
        self.boxes.clear();
        self.fitted = None;
        self.mark();
        self.note_members();
        self.note_rest();
        self.degradation = Degradation::default();
        self.is_built = true;
        self.is_unmeasured = true;
        self.statistics.builds += 1;
    }

    fn mark(&mut self) {
        let Some(moving) = &self.moving else {
            self.vertices.mark_all();
            self.edges.mark_all();
            self.faces.mark_all();
            return;
        };
        let vertices = self.vertices.primitives.iter();
        let of_vertices: Vec<bool> = vertices.map(|&vertex| moving[vertex as usize]).collect();
        let moves = |position: u32| of_vertices[position as usize];
        self.vertices.mark(moves);
        self.edges.mark(moves);
        self.faces.mark(moves);
    }

    fn note_members(&mut self) {
        let vertices = &self.vertices.primitives;
        let members = |filter: &Arc<CollisionFilter>| vertices.iter().map(|&v| Members::of(filter, v)).collect();
        let members: Vec<_> = self.filter.as_ref().map_or_else(Vec::new, members);
        self.vertices.note_members(&members);
        self.edges.note_members(&members);
        self.faces.note_members(&members);
    }

    fn note_rest(&mut self) {
        let vertices = &self.vertices.primitives;
        let at_rest = |neighbours: &Arc<Neighbours>| vertices.iter().map(|&v| neighbours.at_rest(v)).collect();
        let at_rest: Vec<_> = self.neighbours.as_ref().map_or_else(Vec::new, at_rest);
        self.vertices.note_rest(&at_rest);
        self.edges.note_rest(&at_rest);
        self.faces.note_rest(&at_rest);
    }

    fn refit(&mut self, motions: &dyn Motions, mapping: Mapping) {
        // What rests keeps the rows and boxes that it has.
        let only_moving = self.moving.is_some() && self.refit != Refit::All && self.fitted == Some(mapping);
        let vertices = &self.vertices.primitives;
        let rows = self.rows.resize(vertices.len());
        self.boxes.resize(vertices.len(), MovingBox::empty());
        let moving = self.moving.as_deref().filter(|_| only_moving);
        parallel::for_each_chunk_with_chunk(rows, &mut self.boxes, VERTICES, |first, rows, boxes| {
            let own = rows.iter_mut().zip(boxes).zip(&vertices[first..]);
            for ((own_row, moving_box), &vertex) in own {
                let vertex = vertex as usize;
                if moving.is_none_or(|moving| moving[vertex]) {
                    let motion = motions.of(vertex);
                    *own_row = VertexRow::new(motion);
                    *moving_box = mapping.vertex(motion.start.into(), motion.end.into());
                }
            }
        });
        self.vertices.refit(&self.boxes, only_moving);
        self.edges.refit(&self.boxes, only_moving);
        self.faces.refit(&self.boxes, only_moving);
        self.fitted = Some(mapping);
    }

    fn find_tasks(&mut self) {
        let [vertex_face, edge_edge] = &mut self.tasks;
        let vertex_face_trees = Trees {
            first: &self.vertices,
            second: &self.faces,
            common: Common::Mesh,
            are_filtered: self.filter.is_some(),
            of_neighbours: None,
        };
        let edge_edge_trees = Trees {
            first: &self.edges,
            second: &self.edges,
            common: Common::Tree,
            are_filtered: self.filter.is_some(),
            of_neighbours: None,
        };
        let (level, stack) = (self.level, &mut self.stack);
        vertex_face.clear();
        edge_edge.clear();
        self.task_tests = vertex_face_trees.tasks(level, TASK_LEVEL, stack, vertex_face);
        self.task_tests += edge_edge_trees.tasks(level, TASK_LEVEL, stack, edge_edge);
        settle(vertex_face);
        settle(edge_edge);
    }

    /// Into how many parts the traversal is split on the threads there are: those of VF first.
    pub(crate) fn shares(&self) -> usize {
        2 * self.shares_of_kind()
    }

    fn shares_of_kind(&self) -> usize {
        // So many that an unlucky one does not keep the others waiting.
        match parallel::threads() {
            1 => 1,
            threads => SHARES * threads,
        }
    }

    /// One of the [`shares`](Self::shares). All of them, one after the other, are the traversal.
    pub(crate) fn share(&self, index: usize) -> Share<'_> {
        let shares = self.shares_of_kind();
        let (kind, index) = match index.checked_sub(shares) {
            None => (PairKind::VertexFace, index),
            Some(index) => (PairKind::EdgeEdge, index),
        };
        let tasks = &self.tasks[kind as usize];
        let bound = |index: usize| tasks.len() * index.min(shares) / shares;
        Share {
            kind,
            tasks: &tasks[bound(index)..bound(index + 1)],
        }
    }

    /// Gives `sink` the candidates of a share, by their positions. Returns the number of tests, or `None` if the sink has had
    /// enough.
    pub(crate) fn visit(&self, share: Share<'_>, scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        let Some(filter) = &self.filter else {
            return self.visit_all(share, scratch, sink);
        };
        let mut allowed = Allowed {
            hierarchies: self,
            filter,
            kind: share.kind,
            pairs: std::mem::take(&mut scratch.allowed),
            sink,
        };
        let tests = self.visit_all(share, scratch, &mut allowed);
        scratch.allowed = allowed.pairs;
        tests
    }

    fn visit_all(&self, share: Share<'_>, scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        Pairing::within(share.kind, self).visit(share.tasks, scratch, sink)
    }

    /// Whether it matters who is in a block.
    pub(super) const fn are_filtered(&self) -> bool {
        self.filter.is_some()
    }

    /// How neighbours are left out, if they have a separation of their own.
    pub(super) fn of_neighbours(&self) -> Option<Inset> {
        let is_less = self.neighbours.is_some() && self.fit.of_neighbours < self.fit.separation;
        is_less.then(|| Inset::new(self.fit.separation, self.fit.of_neighbours))
    }

    /// Finds where to look for faces and edges that are near each other, as the last update left them.
    pub(crate) fn find_face_edge_tasks(&mut self) {
        let trees = Trees {
            first: &self.faces,
            second: &self.edges,
            common: Common::Mesh,
            are_filtered: self.filter.is_some(),
            of_neighbours: None,
        };
        self.face_edge_tasks.clear();
        trees.tasks(self.level, TASK_LEVEL, &mut self.stack, &mut self.face_edge_tasks);
        settle(&mut self.face_edge_tasks);
    }

    /// Gives `sink` the faces and edges that are near each other and have no vertex in common, by their positions: a share of them
    /// out of so many. Returns the tests that it took; `None` if it has had enough. (Faces first, each of which is tested against sixteen edges at once: they
    /// are fewer.)
    pub(crate) fn visit_face_edge(&self, share: usize, shares: usize, scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        let tasks = &self.face_edge_tasks;
        let bound = |index: usize| tasks.len() * index / shares;
        let tasks = &tasks[bound(share)..bound(share + 1)];
        let trees = Trees {
            first: &self.faces,
            second: &self.edges,
            common: Common::Mesh,
            are_filtered: self.filter.is_some(),
            of_neighbours: None,
        };
        trees.pairs(self.level, tasks, scratch, sink)
    }

    /// A share of the vertices and faces, out of so many.
    pub(crate) fn vertex_face_share(&self, share: usize, shares: usize) -> Share<'_> {
        let tasks = &self.tasks[PairKind::VertexFace as usize];
        let bound = |index: usize| tasks.len() * index / shares;
        Share {
            kind: PairKind::VertexFace,
            tasks: &tasks[bound(share)..bound(share + 1)],
        }
    }

    /// How many positions there are: a row for each.
    pub(crate) fn vertex_positions(&self) -> usize {
        self.vertices.len()
    }

    /// The positions of each edge's ends, by its own position.
    pub(crate) fn edge_ends(&self) -> &[[u32; 2]] {
        &self.edges.vertices
    }

    /// The positions of a face's corners.
    #[inline(always)]
    pub(crate) fn face_corners(&self, face: u32) -> [u32; 3] {
        self.faces.vertices[face as usize]
    }

    /// The position of a vertex of the mesh that has a triangle.
    #[inline(always)]
    pub(crate) fn position_of(&self, vertex: u32) -> u32 {
        self.positions[vertex as usize]
    }

    /// Whether a vertex of the mesh takes part in every pair, not only in those with such a partner.
    pub(crate) fn moves(&self, vertex: u32) -> bool {
        self.moving.as_ref().is_none_or(|moving| moving[vertex as usize])
    }

    /// A face and an edge as the topology numbers them.
    pub(crate) fn face_edge_in_mesh(&self, [face, edge]: [u32; 2]) -> [u32; 2] {
        [self.faces.primitives[face as usize], self.edges.primitives[edge as usize]]
    }

    /// The candidates were found in so many tests, besides those of [`update`](Self::update).
    pub(crate) fn observe(&mut self, tests: u64, candidates: usize) {
        let tests = tests + self.task_tests;
        let items = self.edges.len();
        // Boxes of another kind cost something else.
        if self.fit.until == 1.0 && !self.fit.is_swept {
            self.degradation.observe(PRICES, tests, items, candidates, self.is_new);
        } else {
            self.degradation
                .observe_another(PRICES, tests, items, candidates, self.is_new);
        }
        self.statistics.box_tests = tests;
        self.statistics.candidates = candidates;
    }

    /// The same of faces and edges.
    pub(crate) fn observe_face_edge(&mut self, tests: u64, candidates: usize) {
        let tests = tests + self.task_tests;
        let items = self.edges.len();
        self.degradation
            .observe_another(PRICES, tests, items, candidates, self.is_new);
    }

    /// The positions of a pair's four vertices: vertex, face; or two edges, the one with the mesh's smaller number first, so that
    /// what is computed of them does not depend on where they are in the hierarchy.
    #[inline(always)]
    pub(crate) fn vertices(&self, kind: PairKind, [first, second]: [u32; 2]) -> [u32; 4] {
        let (first, second) = (first as usize, second as usize);
        match kind {
            PairKind::VertexFace => {
                let [a, b, c] = self.faces.vertices[second];
                [first as u32, a, b, c]
            }
            PairKind::EdgeEdge => {
                let (first, second) = (&self.edge_ends[first], &self.edge_ends[second]);
                let ([a, b], [c, d]) = (first.ends, second.ends);
                if first.edge < second.edge {
                    [a, b, c, d]
                } else {
                    [c, d, a, b]
                }
            }
        }
    }

    /// The same of many pairs of a kind, which is asked about once.
    pub(crate) fn vertices_of_all(&self, kind: PairKind, pairs: &[[u32; 2]], vertices: &mut [[u32; 4]]) {
        let own = vertices.iter_mut().zip(pairs);
        match kind {
            PairKind::VertexFace => {
                for (vertices, &pair) in own {
                    *vertices = self.vertices(PairKind::VertexFace, pair);
                }
            }
            PairKind::EdgeEdge => {
                for (vertices, &pair) in own {
                    *vertices = self.vertices(PairKind::EdgeEdge, pair);
                }
            }
        }
    }

    /// The pair as the topology numbers it: vertex and face; or two edges, the smaller number first.
    #[inline(always)]
    pub(crate) fn in_mesh(&self, kind: PairKind, [first, second]: [u32; 2]) -> [u32; 2] {
        let (first, second) = (first as usize, second as usize);
        match kind {
            PairKind::VertexFace => [self.vertices.primitives[first], self.faces.primitives[second]],
            PairKind::EdgeEdge => {
                let (a, b) = (self.edges.primitives[first], self.edges.primitives[second]);
                [a.min(b), a.max(b)]
            }
        }
    }
}

/// Hands on what a filter allows.
struct Allowed<'a> {
    hierarchies: &'a Hierarchies,
    filter: &'a CollisionFilter,
    kind: PairKind,
    pairs: Vec<[u32; 2]>,
    sink: &'a mut dyn Sink,
}

impl Sink for Allowed<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        let Self {
            hierarchies,
            filter,
            kind,
            pairs: allowed,
            sink,
        } = self;
        allowed.clear();
        allowed.extend(pairs.iter().filter(|&&pair| {
            let pair = hierarchies.in_mesh(*kind, pair);
            filter.allows(*kind, pair, hierarchies.topology.vertices_of(*kind, pair))
        }));
        sink.take(allowed)
    }
}

/// An edge by its vertices' positions, and its number in the mesh. Never on two cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct EdgeEnds {
    ends: [u32; 2],
    edge: u32,
}

/// No position.
const NOWHERE: u32 = u32::MAX;

/// Pairs of blocks of this level are what a share is made of: of 256 primitives each.
pub(super) const TASK_LEVEL: usize = 1;

/// Parts of the traversal for each thread and kind.
const SHARES: usize = 16;

/// Vertices that one thread refits in one go.
const VERTICES: usize = 1024;

/// Boxes of these motions that hold what is within `separation`, as a detector has them that has seen no step before.
pub(crate) fn mapping_within(motions: &dyn Motions, separation: f64) -> Mapping {
    let fit = Fit {
        separation,
        ..Fit::default()
    };
    fit.mapping(motions, &extent(motions))
}

/// The box of all positions of both frames.
fn extent(motions: &dyn Motions) -> Aabb<f64> {
    let mut extent = Aabb::<f64>::empty();
    for vertex in 0..motions.len() {
        let motion = motions.of(vertex);
        for position in [motion.start, motion.end] {
            for (axis, x) in position.to_array().into_iter().enumerate() {
                extent.lower[axis] = extent.lower[axis].min(x);
                extent.upper[axis] = extent.upper[axis].max(x);
            }
        }
    }
    extent
}

fn mean<const N: usize>(positions: [[f32; 3]; N]) -> [f32; 3] {
    [0, 1, 2].map(|axis| {
        let sum: f32 = positions.iter().map(|position| position[axis] / N as f32).sum();
        sum
    })
}
