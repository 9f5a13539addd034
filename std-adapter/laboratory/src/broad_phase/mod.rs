//! The broad phase of the published methods: which triangles' swept boxes overlap.
//!
//! [`BroadPhase`] takes one box per triangle and gives every pair of overlapping boxes, each pair once
//! and in order. The overlap is closed: boxes that only touch overlap. Adjacent triangles are pairs like
//! any other, since they can hold vertex-face and edge-edge pairs that no other triangle pair holds.
//!
//! # How it works
//!
//! Triangles are put into an order in which any 16 (128, 1024, …) consecutive ones from a multiple of
//! that number lie close together (`hierarchy`). The boxes of these groups are refitted each step. The
//! pairs are then found by handing lists of candidates down the groups: the whole mesh, in order of
//! triangle, at the top; for each group inside, those on the list that overlap its box; and in the end
//! for each triangle those that overlap the triangle (`traversal`). A filtered list keeps its order, so
//! each triangle's partners come out sorted, and only the triangles' runs are left to be put in a row
//! (`output`).
//!
//! Nothing depends on the number of threads but the time. After the first step nothing is allocated,
//! unless some buffer needs half as much again as in any step before.
//!
//! # Why not a library's hierarchy
//!
//! Measured against parry3d 0.31 (`cargo bench -p selvedge-benches --bench broad_phase`), one thread, refit and all pairs of a cloth of 92,230
//! triangles with 4.5 million pairs: 41 to 46 ms here, in order; 62 to 66 ms there, in tree order, and 175 ms more to sort
//! them. On tubes of 1.3 thousand to 1.3 million triangles both are level before sorting. parry3d's traversal also makes a new
//! vector each time, where the pipeline keeps and reuses its own.
//!
//! # Why not the detector's
//!
//! What the detector's hierarchies find goes on in the order in which it is found. Here pairs come in the order of the triangles, and so do
//! the contacts and files that are made of them. To put 4.5 million made-up pairs of neighbours in order takes 65 ms by counting and 273 by
//! sorting (other work beside): more than all that is done here. So the two have in common in which order primitives lie, what a build is worth
//! and the threads, and not the traversal.
//!
//! ```
//! use selvedge_laboratory::broad_phase::{BroadPhase, SweptBox};
//!
//! let boxes = [
//!     SweptBox { lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 1.0] },
//!     SweptBox { lower: [5.0, 0.0, 0.0], upper: [6.0, 1.0, 1.0] },
//!     SweptBox { lower: [1.0, 1.0, 1.0], upper: [2.0, 2.0, 2.0] },
//! ];
//! let mut broad_phase = BroadPhase::new();
//! let mut pairs = Vec::new();
//! broad_phase.update(&boxes);
//! broad_phase.candidate_triangle_pairs(&mut pairs);
//! assert_eq!(pairs, [[0, 2]]);
//! ```

mod buffer;
mod candidates;
mod hierarchy;
mod output;
mod traversal;

use candidates::CandidateList;
use hierarchy::Hierarchy;
use selvedge::broad_phase::{Degradation, Prices};
use traversal::Traversal;

/// The box that a triangle sweeps during the step, in the caller's length unit.
///
/// Where positions have more digits than `f32` the caller rounds outwards, or maps all coordinates of an axis by one
/// function that never exchanges two of them: boxes that overlap must still do so.
///
/// Two boxes overlap unless, along some axis, the lower bound of one is greater than the upper bound of
/// the other. A bound that is not a number is greater than nothing, so it separates nothing; infinite
/// bounds compare as numbers do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweptBox {
    /// Least coordinate along each axis.
    pub lower: [f32; 3],
    /// Greatest coordinate along each axis.
    pub upper: [f32; 3],
}

/// What a [`BroadPhase`] has done so far. Counts do not depend on the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BroadPhaseStatistics {
    /// How often the hierarchy was built, the first time included.
    pub builds: usize,
    /// Box tests, in blocks of 16, of the last [`BroadPhase::candidate_triangle_pairs`].
    pub block_tests: u64,
    /// Pairs found by the last [`BroadPhase::candidate_triangle_pairs`].
    pub pairs: usize,
}

/// Build: measured as the time of a build over the time of each further block test that exchanging triangles at random
/// after the build causes: 0.15 to 0.3 from 1,352 to 134,162 triangles. On three motions of 92,450 triangles (a twisting
/// tube, a crumpling and a rolled-up sheet) a quarter or four times of this makes block tests and builds together no more than
/// 4 % dearer.
///
/// Item: measured just after a build, 15.1 block tests a triangle with 49.2 pairs a triangle (crumpled cloth), 4.8 with 8.1
/// (tube), hence 0.25 a pair and 2.7 a triangle besides.
const PRICES: Prices = Prices { build: 0.25, item: 11.0 };

/// Finds the pairs of triangles whose swept boxes overlap; see the [module](self).
#[derive(Debug, Default)]
pub struct BroadPhase {
    hierarchy: Hierarchy,
    /// All triangles, in order.
    everything: CandidateList,
    traversal: Traversal,
    /// Where each triangle's pairs begin in the result.
    offsets: Vec<usize>,
    degradation: Degradation,
    statistics: BroadPhaseStatistics,
}

impl BroadPhase {
    /// A broad phase without triangles.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the boxes of a step.
    ///
    /// Builds the hierarchy when the number of boxes differs from the last call's or when it has
    /// degraded, refits it otherwise. It has degraded when the pairs found since it was built have cost
    /// more, beyond what they cost just after, than building it anew.
    ///
    /// # Panics
    ///
    /// With more than `u32::MAX` boxes.
    pub fn update(&mut self, boxes: &[SweptBox]) {
        assert!(u32::try_from(boxes.len()).is_ok(), "more than u32::MAX boxes");
        self.everything.assign(boxes);
        if boxes.len() != self.hierarchy.len() || self.degradation.is_worth_a_build(PRICES, boxes.len()) {
            self.hierarchy.build(boxes);
            self.degradation = Degradation::default();
            self.statistics.builds += 1;
        }
        self.hierarchy.refit(boxes);
    }

    /// Replaces `pairs` by all pairs `[a, b]`, `a < b`, of triangles whose boxes overlap, each once, in
    /// lexicographic order.
    pub fn candidate_triangle_pairs(&mut self, pairs: &mut Vec<[u32; 2]>) {
        let block_tests = self.traversal.run(&self.hierarchy, &self.everything);
        output::concatenate(&self.hierarchy, &self.traversal, &mut self.offsets, pairs);
        self.degradation
            .observe(PRICES, block_tests, self.hierarchy.len(), pairs.len(), true);
        self.statistics.block_tests = block_tests;
        self.statistics.pairs = pairs.len();
    }

    /// How often the hierarchy was built again after the first time.
    #[must_use]
    pub fn rebuilds(&self) -> usize {
        self.statistics.builds.saturating_sub(1)
    }

    /// Counts of what was done.
    #[must_use]
    pub fn statistics(&self) -> BroadPhaseStatistics {
        self.statistics
    }
}

#[cfg(test)]
mod tests;
