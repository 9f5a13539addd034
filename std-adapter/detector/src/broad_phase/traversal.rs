//! Finds the primitives of two trees that are near each other.
//!
//! A traversal splits pairs of blocks from the top. For two blocks of one level, it compares each box of the first with all
//! sixteen of the second at once. For two blocks of different levels, it compares the boxes of the higher one with the bounds of
//! the other. Near blocks go on a stack; near primitives go to the caller, each pair once. A tree against itself takes a pair of
//! blocks in one order only, and inside one block the lanes after each lane.
//!
//! Neighbours may have a smaller separation. A box that is [drawn in](selvedge_core::boxes::mapping::Inset) is then compared with
//! the same sixteen. Pairs that are apart in this test are left out if they are neighbours. The boxes at rest decide that in the
//! same way.

use super::hubs::NO_HUB;
use super::pairs::{PairBuffer, Sink};
use super::tree::{Node, Tree};
use selvedge_core::batch::{Compares, LANES, Level, Loop, Mask, in_lanes};
use selvedge_core::boxes::mapping::Inset;
use selvedge_core::boxes::moving::MovingBlock;
use std::array;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BlockPair {
    levels: [u8; 2],
    blocks: [u32; 2],
}

/// The primitives that two trees share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Common {
    Tree,
    Mesh,
    Nothing,
}

/// Two trees, or one against itself.
#[derive(Clone, Copy)]
pub(super) struct Trees<'a, const N: usize, const M: usize> {
    pub(super) first: &'a Tree<N>,
    pub(super) second: &'a Tree<M>,
    pub(super) common: Common,
    pub(super) are_filtered: bool,
    /// The inset of boxes for the separation of neighbours, if they have a smaller one.
    pub(super) of_neighbours: Option<Inset>,
}

#[derive(Debug)]
pub(crate) struct Scratch {
    stack: Vec<BlockPair>,
    found: PairBuffer,
    /// The pairs that a collision filter allows.
    pub(super) allowed: Vec<[u32; 2]>,
    /// The number of neighbours that the last traversal left out.
    pub(super) left_out: u64,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            stack: Vec::with_capacity(1024),
            found: PairBuffer::new(),
            allowed: Vec::new(),
            left_out: 0,
        }
    }
}

impl<const N: usize, const M: usize> Trees<'_, N, M> {
    /// Appends to `tasks` the near pairs of blocks of a level or below, in the order of a whole traversal. Returns the number of
    /// tests, each of one box against sixteen.
    pub(super) fn tasks(&self, level: Level, floor: usize, stack: &mut Vec<BlockPair>, tasks: &mut Vec<BlockPair>) -> u64 {
        let (Some(top), Some(other_top)) = (self.first.top(), self.second.top()) else {
            return 0;
        };
        stack.clear();
        stack.push(BlockPair {
            levels: [top as u8, other_top as u8],
            blocks: [0, 0],
        });
        let down_to = DownTo {
            trees: self,
            floor,
            stack,
            tasks,
        };
        in_lanes(level, down_to)
    }

    /// Gives `sink` the near pairs of primitives of `tasks` that have no vertex in common. Returns the number of tests, or `None`
    /// if the sink stops the traversal.
    pub(super) fn pairs(&self, level: Level, tasks: &[BlockPair], scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        let Scratch {
            stack, found, left_out, ..
        } = scratch;
        found.clear();
        *left_out = 0;
        let all_pairs = AllPairs {
            trees: self,
            tasks,
            stack,
            found,
            left_out,
            sink,
        };
        in_lanes(level, all_pairs)
    }

    /// Returns whether no primitive of one block is a pair with one of the other: all have one hub, or their groups do not
    /// collide.
    #[inline(always)]
    fn are_excluded(&self, [level_a, level_b]: [u8; 2], [a, b]: [u32; 2]) -> bool {
        if !self.are_filtered && !self.first.has_hubs {
            return false;
        }
        let first = &self.first.levels[usize::from(level_a)];
        let second = &self.second.levels[usize::from(level_b)];
        let (a, b) = (a as usize, b as usize);
        let hub = first.nodes[a].hub;
        let have_one_hub = self.common != Common::Nothing && hub != NO_HUB && hub == second.nodes[b].hub;
        have_one_hub || self.are_filtered && !first.members[a].may_collide(second.members[b])
    }

    /// Puts the near pairs of the blocks in two blocks on the stack.
    #[inline(always)]
    fn split(&self, lanes: impl Compares, pair: BlockPair, stack: &mut Vec<BlockPair>) -> u64 {
        if self.are_excluded(pair.levels, pair.blocks) {
            return 0;
        }
        let [a, b] = pair.blocks;
        let [level_a, level_b] = pair.levels;
        let (block_a, node_a) = part(self.first, level_a, a);
        let (block_b, node_b) = part(self.second, level_b, b);
        let is_same = self.common == Common::Tree && level_a == level_b && a == b;
        if level_a > level_b {
            let among = node_a.present & partners(node_b.moving != 0, node_a.moving);
            let mut near = lanes.near(block_a, &node_b.bounds, among);
            while near != 0 {
                let child = next_lane(&mut near);
                stack.push(BlockPair {
                    levels: [level_a - 1, level_b],
                    blocks: [a * LANES as u32 + child, b],
                });
            }
            return 1;
        }
        if level_b > level_a {
            let among = node_b.present & partners(node_a.moving != 0, node_b.moving);
            let mut near = lanes.near(block_b, &node_a.bounds, among);
            while near != 0 {
                let child = next_lane(&mut near);
                stack.push(BlockPair {
                    levels: [level_a, level_b - 1],
                    blocks: [a, b * LANES as u32 + child],
                });
            }
            return 1;
        }
        let mut tests = 0;
        let mut own = node_a.present;
        if !is_same {
            own = lanes.near(block_a, &node_b.bounds, own);
            tests += 1;
        }
        tests += u64::from((own & !with_partners(node_a, node_b.moving)).count_ones());
        own &= with_partners(node_a, node_b.moving);
        while own != 0 {
            let lane = next_lane(&mut own);
            let mut among = node_b.present & partners(node_a.moving >> lane & 1 != 0, node_b.moving);
            if is_same {
                // In a block against itself each lane meets itself and later lanes.
                among &= Mask::MAX << lane;
            }
            let mut near = lanes.near(block_b, &block_a.get(lane as usize % LANES), among);
            tests += 1;
            while near != 0 {
                let other = next_lane(&mut near);
                stack.push(BlockPair {
                    levels: [level_a - 1, level_b - 1],
                    blocks: [a * LANES as u32 + lane, b * LANES as u32 + other],
                });
            }
        }
        tests
    }

    /// Appends the near pairs of the primitives in two blocks to those found.
    #[inline(always)]
    fn compare_primitives(&self, lanes: impl Compares, [a, b]: [u32; 2], found: &mut PairBuffer, left_out: &mut u64) -> u64 {
        if self.are_excluded([0, 0], [a, b]) {
            return 0;
        }
        let (block_a, node_a) = part(self.first, 0, a);
        let (block_b, node_b) = part(self.second, 0, b);
        let is_same = self.common == Common::Tree && a == b;
        let (mut own, mut others) = (node_a.present, node_b.present);
        let mut tests = 0;
        if !is_same {
            others = lanes.near(block_b, &node_a.bounds, others);
            tests += 1;
            if others == 0 {
                return tests;
            }
            own = lanes.near(block_a, &node_b.bounds, own);
            tests += 1;
        }
        // Lanes without a partner count too: the quality of the hierarchies does not depend on what moves.
        tests += u64::from((own & !with_partners(node_a, others & node_b.moving)).count_ones());
        own &= with_partners(node_a, others & node_b.moving);
        tests += u64::from(own.count_ones());
        // There are two loops. In a single one the compiler stores the whole block on the stack in each round, for the second
        // comparison.
        match self.of_neighbours {
            None => self.compare_lanes(lanes, [a, b], [own, others], None, found, left_out),
            Some(inset) => {
                let inset = Some(inset.for_bounds(&node_a.bounds));
                self.compare_lanes(lanes, [a, b], [own, others], inset, found, left_out);
            }
        }
        tests
    }

    /// Appends the near pairs of some lanes of two blocks to those found. With an `inset`, leaves out neighbours whose boxes are
    /// apart when drawn in by it.
    #[inline(always)]
    fn compare_lanes(
        &self,
        lanes: impl Compares,
        [a, b]: [u32; 2],
        [mut own, others]: [Mask; 2],
        inset: Option<f32>,
        found: &mut PairBuffer,
        left_out: &mut u64,
    ) {
        let (block_a, node_a) = part(self.first, 0, a);
        let (block_b, node_b) = part(self.second, 0, b);
        let is_same = self.common == Common::Tree && a == b;
        let corners = &self.second.corners[b as usize];
        let (first, second) = (a * LANES as u32, b * LANES as u32);
        while own != 0 {
            let lane = next_lane(&mut own);
            let mut among = others & partners(node_a.moving >> lane & 1 != 0, node_b.moving);
            if is_same {
                among &= (Mask::MAX << lane) << 1;
            }
            let moving = block_a.get(lane as usize % LANES);
            let mut near = lanes.near(block_b, &moving, among);
            if near != 0 {
                if let Some(inset) = inset {
                    let far = near & !lanes.near(block_b, &moving.drawn_in(inset), near);
                    let far_neighbours = self.neighbours_among(lanes, [a, b], lane, far);
                    *left_out += u64::from(far_neighbours.count_ones());
                    near &= !far_neighbours;
                }
                if self.common != Common::Nothing {
                    let vertices = &self.first.vertices[(first + lane) as usize];
                    near &= !lanes.equal(corners, vertices, near);
                }
                found.push(first + lane, second, near);
            }
        }
    }

    /// Returns the lanes `among` these of the second of two blocks that are neighbours of a lane of the first.
    #[inline(always)]
    fn neighbours_among(&self, lanes: impl Compares, [a, b]: [u32; 2], lane: u32, among: Mask) -> Mask {
        let (own, others) = (&self.first.rest[a as usize], &self.second.rest[b as usize]);
        let lane = lane as usize % LANES;
        let within = lanes.within(&others.boxes, &own.boxes.get(lane), own.within[lane], among);
        lanes.equal(array::from_ref(&others.parts), &[own.parts[lane]], within)
    }
}

/// Finds the pairs of blocks of a level or below.
struct DownTo<'a, const N: usize, const M: usize> {
    trees: &'a Trees<'a, N, M>,
    floor: usize,
    stack: &'a mut Vec<BlockPair>,
    tasks: &'a mut Vec<BlockPair>,
}

impl<const N: usize, const M: usize> Loop for DownTo<'_, N, M> {
    type Output = u64;

    #[inline(always)]
    fn run(self, lanes: impl Compares) -> u64 {
        let mut tests = 0;
        while let Some(pair) = self.stack.pop() {
            if pair.levels.iter().all(|&level| usize::from(level) <= self.floor) {
                self.tasks.push(pair);
            } else {
                tests += self.trees.split(lanes, pair, self.stack);
            }
        }
        tests
    }
}

struct AllPairs<'a, const N: usize, const M: usize> {
    trees: &'a Trees<'a, N, M>,
    tasks: &'a [BlockPair],
    stack: &'a mut Vec<BlockPair>,
    found: &'a mut PairBuffer,
    left_out: &'a mut u64,
    sink: &'a mut dyn Sink,
}

impl<const N: usize, const M: usize> Loop for AllPairs<'_, N, M> {
    type Output = Option<u64>;

    #[inline(always)]
    fn run(self, lanes: impl Compares) -> Option<u64> {
        let Self {
            trees,
            tasks,
            stack,
            found,
            left_out,
            sink,
        } = self;
        let mut tests = 0;
        for &task in tasks {
            stack.clear();
            stack.push(task);
            while let Some(pair) = stack.pop() {
                if pair.levels == [0, 0] {
                    tests += trees.compare_primitives(lanes, pair.blocks, found, left_out);
                    if found.is_full() {
                        if !sink.take(found.pairs()) {
                            return None;
                        }
                        found.clear();
                    }
                } else {
                    tests += trees.split(lanes, pair, stack);
                }
            }
        }
        (found.pairs().is_empty() || sink.take(found.pairs())).then_some(tests)
    }
}

#[inline(always)]
fn part<const N: usize>(tree: &Tree<N>, level: u8, block: u32) -> (&MovingBlock, &Node) {
    let level = &tree.levels[usize::from(level)];
    (&level.blocks[block as usize], &level.nodes[block as usize])
}

/// Returns the possible partners of a primitive that moves or rests, given the moving ones.
#[inline(always)]
fn partners(is_moving: bool, moving: Mask) -> Mask {
    if is_moving { Mask::MAX } else { moving }
}

/// Returns the lanes of a block that have a partner in another block, given the moving lanes of that block.
#[inline(always)]
fn with_partners(node: &Node, moving: Mask) -> Mask {
    if moving == 0 { node.moving } else { Mask::MAX }
}

/// Clears the lowest set lane and returns it.
#[inline(always)]
fn next_lane(lanes: &mut Mask) -> u32 {
    let lane = lanes.trailing_zeros();
    *lanes &= *lanes - 1;
    lane
}
