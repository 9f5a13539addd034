//! The three hierarchies of a mesh, over its vertices, edges and faces.

mod build;
mod numbers;
mod refit;

pub(crate) use refit::mapping_within;

use super::degradation::{Degradation, Prices};
use super::neighbours::Neighbours;
use super::rows::Rows;
use super::statistics::MovingStatistics;
use super::tree::Tree;
use crate::mesh::Topology;
use crate::simd::{Level, best_level};
use crate::step::{CollisionFilter, Motions};
use numbers::EdgeEnds;
use selvedge_core::boxes::mapping::{Inset, Mapping};
use selvedge_core::boxes::{Aabb, moving::MovingBox};
use std::sync::Arc;

/// The prices of a mesh, for each edge. There are about as many vertices and faces together.
///
/// Build: the time of building all three hierarchies is 0.6 to 0.7 of that of a box test for each edge and halving.
///
/// Item: just after a build 9.5 tests for each edge find 12.8 candidates on one mesh, and 5.6 tests find 0.8 on another. So a
/// candidate costs a third of a test, and an edge 5.3 tests.
pub(super) const PRICES: Prices = Prices { build: 0.65, item: 16.0 };

/// The quantities that boxes hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BoxFit {
    /// The distance beyond which a pair is no candidate; finite and not negative.
    pub(crate) separation: f64,
    /// The distance beyond which neighbours are no candidates, if it is smaller.
    pub(crate) of_neighbours: f64,
    /// The time of the step at which the boxes of the end are taken, in (0, 1].
    pub(crate) until: f64,
    /// Makes boxes for the whole step instead of two for its ends.
    pub(crate) is_swept: bool,
}

impl Default for BoxFit {
    fn default() -> Self {
        Self {
            separation: 0.0,
            of_neighbours: f64::INFINITY,
            until: 1.0,
            is_swept: false,
        }
    }
}

impl BoxFit {
    fn mapping(&self, motions: &dyn Motions, extent: &Aabb<f64>) -> Mapping {
        motions.mapping(extent, self.separation, self.until, self.is_swept)
    }
}

/// The vertices that an update reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scope {
    Moving,
    All,
    /// Vertices that move, the only ones that changed since the last update. The candidates complement those found then.
    Narrowed,
}

/// The age of the hierarchies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Empty,
    /// Built, but not yet fitted as a whole.
    Built,
    /// Fitted as a whole for the first time. A search then measures the cost of new hierarchies.
    New,
    /// Fitted again since.
    Refitted,
}

/// Trees over vertices, edges and faces. Each primitive is numbered by its position in its tree, so that neighbours in space are
/// neighbours in memory, whatever the mesh's own order.
#[derive(Debug)]
pub(crate) struct Hierarchies {
    topology: Arc<Topology>,
    level: Level,
    pub(super) vertices: Tree<1>,
    pub(super) edges: Tree<2>,
    pub(super) faces: Tree<3>,
    edge_ends: Vec<EdgeEnds>,
    /// The position of each of the mesh's vertices. Isolated vertices have none.
    positions: Vec<u32>,
    rows: Rows,
    boxes: Vec<MovingBox<f32>>,
    /// For each vertex, whether it moves; `None` if all do.
    moving: Option<Vec<bool>>,
    pub(super) filter: Option<Arc<CollisionFilter>>,
    /// Pairs with a separation of their own.
    neighbours: Option<Arc<Neighbours>>,
    scope: Scope,
    state: State,
    resting: Option<Mapping>,
    /// The contents of the boxes.
    fit: BoxFit,
    extent: Aabb<f64>,
    degradation: Degradation,
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
            scope: Scope::Moving,
            state: State::Empty,
            resting: None,
            fit: BoxFit::default(),
            extent: Aabb::empty(),
            degradation: Degradation::default(),
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

    /// Returns the motion of each vertex, by position.
    pub(crate) const fn rows(&self) -> &Rows {
        &self.rows
    }

    /// Makes the rows in `f32` too, if they are exact.
    pub(crate) fn narrow(&mut self) {
        self.rows.narrow();
    }

    /// Finds only pairs with a vertex that moves from the next update on; `None` finds all. The positions of the others are read
    /// in the next update and not after it.
    pub(crate) fn set_moving(&mut self, moving: Option<Vec<bool>>) {
        self.moving = moving;
        self.resting = None;
        self.mark();
    }

    pub(crate) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.filter = filter;
        self.note_members();
    }

    /// Gives these pairs a separation of their own from the next update on.
    pub(crate) fn set_neighbours(&mut self, neighbours: Option<Arc<Neighbours>>) {
        self.neighbours = neighbours;
        self.note_rest();
    }

    /// Finds only pairs with a wanted vertex from the next update on. All vertices may move.
    pub(crate) fn set_wanted(&mut self, wanted: Vec<bool>) {
        self.scope = Scope::All;
        let are_all = wanted.iter().all(|&wanted| wanted);
        self.set_moving((!are_all).then_some(wanted));
    }

    /// Finds only pairs with a wanted vertex from the next update on, and reads only these vertices. The boxes of the others stay
    /// unchanged.
    pub(crate) fn narrow_to(&mut self, wanted: Vec<bool>) {
        self.scope = Scope::Narrowed;
        self.moving = Some(wanted);
        self.mark();
    }

    /// Builds the hierarchies from these positions if that pays. With wanted vertices only the order of what updates find
    /// changes.
    pub(crate) fn build_if_degraded(&mut self, motions: &dyn Motions) {
        if self.state != State::Empty && self.are_degraded() {
            self.build(motions);
        }
    }

    fn are_degraded(&self) -> bool {
        self.degradation.is_worth_a_build(PRICES, self.edges.len())
    }

    /// Returns the box that holds the whole mesh, as the last update left it.
    pub(crate) fn bounds(&self) -> MovingBox<f32> {
        let top = self.vertices.top().map(|top| self.vertices.levels[top].nodes[0].bounds);
        top.unwrap_or_else(MovingBox::empty)
    }

    /// Returns the inset by which neighbours are left out, if they have a separation of their own.
    pub(super) fn of_neighbours(&self) -> Option<Inset> {
        let is_less = self.neighbours.is_some() && self.fit.of_neighbours < self.fit.separation;
        is_less.then(|| Inset::new(self.fit.separation, self.fit.of_neighbours))
    }

    /// Returns whether a vertex of the mesh takes part in every pair, not only in pairs with a moving partner.
    pub(crate) fn moves(&self, vertex: u32) -> bool {
        self.moving.as_ref().is_none_or(|moving| moving[vertex as usize])
    }

    /// Notes the number of box tests in which the candidates of the last update were found.
    pub(crate) fn observe(&mut self, tests: u64, candidates: usize) {
        let (items, is_new) = (self.edges.len(), self.state == State::New);
        // Boxes of another kind have other costs.
        if self.fit.until == 1.0 && !self.fit.is_swept {
            self.degradation.observe(PRICES, tests, items, candidates, is_new);
        } else {
            self.degradation.observe_another(PRICES, tests, items, candidates, is_new);
        }
        self.statistics.box_tests = tests;
        self.statistics.candidates = candidates;
    }

    /// Notes the same for pairs of a face and an edge.
    pub(crate) fn observe_face_edge(&mut self, tests: u64, candidates: usize) {
        let (items, is_new) = (self.edges.len(), self.state == State::New);
        self.degradation.observe_another(PRICES, tests, items, candidates, is_new);
    }
}
