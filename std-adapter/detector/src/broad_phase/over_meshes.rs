//! The hierarchy over the meshes of a world: finds the meshes that are near each other.

use super::degradation::Degradation;
use super::hierarchies::PRICES;
use super::pairs::Sink;
use super::traversal::{BlockPair, Common, Scratch, Trees};
use super::tree::Tree;
use crate::simd::best_level;
use crate::step::{Groups, Members};
use selvedge_core::boxes::moving::MovingBox;

#[derive(Debug)]
pub(crate) struct MeshHierarchy {
    tree: Tree<1>,
    /// The box of each mesh, by its index.
    boxes: Vec<MovingBox<f32>>,
    groups: Vec<Groups>,
    moves: Vec<bool>,
    /// True for meshes with another box than in the tree.
    are_changed: Vec<bool>,
    stack: Vec<BlockPair>,
    tasks: Vec<BlockPair>,
    scratch: Scratch,
    degradation: Degradation,
    must_build: bool,
}

impl MeshHierarchy {
    pub(crate) fn new() -> Self {
        Self {
            tree: Tree::default(),
            boxes: Vec::new(),
            groups: Vec::new(),
            moves: Vec::new(),
            are_changed: Vec::new(),
            stack: Vec::new(),
            tasks: Vec::new(),
            scratch: Scratch::new(),
            degradation: Degradation::default(),
            must_build: true,
        }
    }

    /// Replaces all meshes: bounds, whether they move, and groups.
    pub(crate) fn replace(&mut self, meshes: impl Iterator<Item = (MovingBox<f32>, bool, Groups)>) {
        self.boxes.clear();
        self.moves.clear();
        self.groups.clear();
        for (bounds, moves, groups) in meshes {
            self.boxes.push(bounds);
            self.moves.push(moves);
            self.groups.push(groups);
        }
        self.must_build = true;
    }

    pub(crate) fn set(&mut self, index: usize, bounds: MovingBox<f32>, moves: bool) {
        self.boxes[index] = bounds;
        self.moves[index] = moves;
        if let Some(is_changed) = self.are_changed.get_mut(index) {
            *is_changed = true;
        }
    }

    /// Replaces `pairs` by the near pairs of meshes whose groups collide and of which at least one moves. The smaller index comes
    /// first, and pairs ascend.
    pub(crate) fn find(&mut self, pairs: &mut Vec<[u32; 2]>) {
        pairs.clear();
        if self.must_build || self.degradation.is_worth_a_build(PRICES, self.boxes.len()) {
            self.build();
        }
        self.tree.mark(&self.are_changed);
        self.tree.refit(&self.boxes, true);
        self.are_changed.fill(false);
        self.tree.mark(&self.moves);
        let trees = Trees {
            first: &self.tree,
            second: &self.tree,
            common: Common::Tree,
            are_filtered: true,
            of_neighbours: None,
        };
        self.tasks.clear();
        let level = best_level();
        let above = trees.tasks(level, 0, &mut self.stack, &mut self.tasks);
        let mut near = Near {
            tree: &self.tree,
            groups: &self.groups,
            pairs,
        };
        let tests = trees.pairs(level, &self.tasks, &mut self.scratch, &mut near).unwrap_or(0);
        // Only the first search after a build sets the reference.
        self.degradation
            .observe(PRICES, above + tests, self.boxes.len(), pairs.len(), true);
        pairs.sort_unstable();
    }

    fn build(&mut self) {
        let centre = |mesh: u32| {
            let bounds = &self.boxes[mesh as usize].start;
            [0, 1, 2].map(|axis| {
                let centre = 0.5 * bounds.lower[axis] + 0.5 * bounds.upper[axis];
                if centre.is_finite() { centre } else { 0.0 }
            })
        };
        self.tree.build(0..self.boxes.len() as u32, centre, None, &mut Vec::new());
        // Each mesh is its own only vertex.
        self.tree.connect(|mesh| [mesh]);
        let members: Vec<_> = self.groups.iter().map(|&groups| Members::of_mesh(groups)).collect();
        self.tree.note_members(&members);
        self.are_changed.clear();
        self.are_changed.resize(self.boxes.len(), true);
        self.degradation = Degradation::default();
        self.must_build = false;
    }
}

/// Collects pairs of meshes.
struct Near<'a> {
    tree: &'a Tree<1>,
    groups: &'a [Groups],
    pairs: &'a mut Vec<[u32; 2]>,
}

impl Sink for Near<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        for pair in pairs {
            let [a, b] = pair.map(|position| self.tree.primitives[position as usize]);
            // The groups of a block are those of all its meshes, so each pair needs the test.
            if self.groups[a as usize].collide(self.groups[b as usize]) {
                self.pairs.push([a.min(b), a.max(b)]);
            }
        }
        true
    }
}
