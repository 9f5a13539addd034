//! Which primitives of two trees are near each other.
//!
//! Pairs of blocks are taken apart from the top: of two blocks of the same level, each box of the first is compared with all
//! sixteen of the second at once; of two of different levels, the higher one's boxes with the bounds of the other. What is
//! near goes on a stack, or, at the lowest level, to the caller, each pair once: a tree against itself looks at a pair of
//! blocks in one order only, and inside one block at the lanes after each lane.

use super::pairs::{PairBuffer, Sink};
use super::tree::{Node, Tree};
use fearless_simd::{Simd, SimdBase, SimdMask, u32x16};
use selvedge_core::batch::{LANES, Level, Mask};
use selvedge_core::boxes::moving::MovingBlock;

/// Two blocks that are near each other: the level and the number of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct BlockPair {
    levels: [u8; 2],
    blocks: [u32; 2],
}

/// Two trees, or one against itself.
#[derive(Clone, Copy)]
pub(super) struct Trees<'a, const N: usize, const M: usize> {
    pub(super) first: &'a Tree<N>,
    pub(super) second: &'a Tree<M>,
    pub(super) are_same: bool,
}

/// What a traversal keeps from step to step.
#[derive(Debug)]
pub(crate) struct Scratch {
    stack: Vec<BlockPair>,
    found: PairBuffer,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            stack: Vec::with_capacity(1024),
            found: PairBuffer::new(),
        }
    }
}

impl<const N: usize, const M: usize> Trees<'_, N, M> {
    /// Replaces `tasks` by the pairs of blocks of a level, or below, that are near each other, in the order in which a
    /// traversal of the whole comes to them. Returns the number of tests, each of one box against sixteen.
    pub(super) fn tasks(&self, level: Level, floor: usize, scratch: &mut Scratch, tasks: &mut Vec<BlockPair>) -> u64 {
        tasks.clear();
        let (Some(top), Some(other_top)) = (self.first.top(), self.second.top()) else {
            return 0;
        };
        scratch.stack.clear();
        scratch.stack.push(BlockPair {
            levels: [top as u8, other_top as u8],
            blocks: [0, 0],
        });
        let stack = &mut scratch.stack;
        fearless_simd::dispatch!(level, simd => {
            let mut tests = 0;
            while let Some(pair) = stack.pop() {
                if pair.levels.iter().all(|&level| usize::from(level) <= floor) {
                    tasks.push(pair);
                } else {
                    tests += self.take_apart(simd, pair, stack);
                }
            }
            tests
        })
    }

    /// Gives `sink` the pairs of primitives of `tasks` that are near each other and have no vertex in common. Returns the
    /// number of tests, or `None` if the sink has had enough.
    pub(super) fn pairs(&self, level: Level, tasks: &[BlockPair], scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        let Scratch { stack, found } = scratch;
        found.clear();
        fearless_simd::dispatch!(level, simd => {
            let mut tests = 0;
            for &task in tasks {
                stack.clear();
                stack.push(task);
                while let Some(pair) = stack.pop() {
                    if pair.levels == [0, 0] {
                        tests += self.compare_primitives(simd, pair.blocks, found);
                        if found.is_full() {
                            if !sink.take(found.pairs()) {
                                return None;
                            }
                            found.clear();
                        }
                    } else {
                        tests += self.take_apart(simd, pair, stack);
                    }
                }
            }
            (found.pairs().is_empty() || sink.take(found.pairs())).then_some(tests)
        })
    }

    /// Puts the pairs of blocks that two blocks hold on the stack.
    #[inline(always)]
    fn take_apart<V: Simd>(&self, simd: V, pair: BlockPair, stack: &mut Vec<BlockPair>) -> u64 {
        let [a, b] = pair.blocks;
        let [level_a, level_b] = pair.levels;
        let (block_a, node_a) = part(self.first, level_a, a);
        let (block_b, node_b) = part(self.second, level_b, b);
        let is_same = self.are_same && level_a == level_b && a == b;
        if level_a > level_b {
            let mut near = block_a.near_in_lanes(simd, &node_b.bounds) & node_a.present;
            near &= partners(node_b.moving != 0, node_a.moving);
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
            let mut near = block_b.near_in_lanes(simd, &node_a.bounds) & node_b.present;
            near &= partners(node_a.moving != 0, node_b.moving);
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
        let mut lanes = node_a.present;
        if !is_same {
            lanes &= block_a.near_in_lanes(simd, &node_b.bounds);
            tests += 1;
        }
        tests += u64::from((lanes & !with_partners(node_a, node_b.moving)).count_ones());
        lanes &= with_partners(node_a, node_b.moving);
        while lanes != 0 {
            let lane = next_lane(&mut lanes);
            let mut near = node_b.present & partners(node_a.moving >> lane & 1 != 0, node_b.moving);
            if is_same {
                // A block against itself: each lane with itself and those after it.
                near &= Mask::MAX << lane;
            }
            near &= block_b.near_in_lanes(simd, &block_a.get(lane as usize % LANES));
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

    /// Puts the pairs of primitives that two blocks hold with those that are found.
    #[inline(always)]
    fn compare_primitives<V: Simd>(&self, simd: V, [a, b]: [u32; 2], found: &mut PairBuffer) -> u64 {
        let (block_a, node_a) = part(self.first, 0, a);
        let (block_b, node_b) = part(self.second, 0, b);
        let is_same = self.are_same && a == b;
        let (mut lanes, mut others) = (node_a.present, node_b.present);
        let mut tests = 0;
        if !is_same {
            others &= block_b.near_in_lanes(simd, &node_a.bounds);
            tests += 1;
            if others == 0 {
                return tests;
            }
            lanes &= block_a.near_in_lanes(simd, &node_b.bounds);
            tests += 1;
        }
        // Counted all the same: how good the hierarchies are does not depend on who takes part.
        tests += u64::from((lanes & !with_partners(node_a, others & node_b.moving)).count_ones());
        lanes &= with_partners(node_a, others & node_b.moving);
        let corners = &self.second.corners[b as usize];
        let (first, second) = (a * LANES as u32, b * LANES as u32);
        while lanes != 0 {
            let lane = next_lane(&mut lanes);
            let mut near = others & partners(node_a.moving >> lane & 1 != 0, node_b.moving);
            if is_same {
                near &= (Mask::MAX << lane) << 1;
            }
            near &= block_b.near_in_lanes(simd, &block_a.get(lane as usize % LANES));
            tests += 1;
            if near != 0 {
                let vertices = &self.first.vertices[(first + lane) as usize];
                near &= !sharing(simd, corners, vertices);
                found.push(first + lane, second, near);
            }
        }
        tests
    }
}

#[inline(always)]
fn part<const N: usize>(tree: &Tree<N>, level: u8, block: u32) -> (&MovingBlock, &Node) {
    let level = &tree.levels[usize::from(level)];
    (&level.blocks[block as usize], &level.nodes[block as usize])
}

/// The lanes that take part in pairs with something that moves, or does not.
#[inline(always)]
fn partners(is_moving: bool, moving: Mask) -> Mask {
    if is_moving { Mask::MAX } else { moving }
}

/// The lanes of a block that have any partner there, of which these move.
#[inline(always)]
fn with_partners(node: &Node, moving: Mask) -> Mask {
    if moving == 0 { node.moving } else { Mask::MAX }
}

/// The lowest set lane, which is then cleared.
#[inline(always)]
fn next_lane(lanes: &mut Mask) -> u32 {
    let lane = lanes.trailing_zeros();
    *lanes &= *lanes - 1;
    lane
}

/// The lanes that have one of `vertices` for a corner.
#[inline(always)]
fn sharing<V: Simd, const N: usize, const M: usize>(simd: V, corners: &[[u32; LANES]; M], vertices: &[u32; N]) -> Mask {
    let mut shared = 0;
    for row in corners {
        let row = u32x16::load_array_ref(simd, row);
        for &vertex in vertices {
            shared |= row.simd_eq(u32x16::splat(simd, vertex)).to_bitmask() as Mask;
        }
    }
    shared
}
