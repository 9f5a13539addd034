//! A hierarchy of moving boxes over the vertices, the edges or the faces of a mesh.
//!
//! The primitives have an [order](super::order) in which 16 (256, 4096, …) consecutive ones lie close together, counted from a
//! multiple of that number. A *block* holds the moving boxes of sixteen of them side by side. A block of the next level holds the
//! boxes of sixteen blocks, and so on up to one block that holds all. So the tree is only arrays: the children of block b are the
//! blocks, or primitives, from 16b on. No block but the last of a level has an empty lane.

use super::bounds::Bounds;
use super::hubs::{NO_HUB, order_by_hub};
use super::neighbours::AtRest;
use super::order::{Centre, LEAF, order};
use crate::parallel;
use crate::step::Members;
use selvedge_core::batch::{LANES, Mask};
use selvedge_core::boxes::Aabb;
use selvedge_core::boxes::block::BoxBlock;
use selvedge_core::boxes::moving::{MovingBlock, MovingBox};

const _: () = assert!(LEAF == LANES, "a group of the order is a block");

#[derive(Debug, Default)]
pub(super) struct TreeLevel {
    pub(super) blocks: Vec<MovingBlock>,
    pub(super) nodes: Vec<Node>,
    /// The groups and patches in each block, if there is a collision filter.
    pub(super) members: Vec<Members>,
}

/// A block as a whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: MovingBox<f32>,
    /// The lanes that hold a box.
    pub(super) present: Mask,
    /// The lanes that hold a moving primitive. Others are paired with moving partners only.
    pub(super) moving: Mask,
    /// The hub of all primitives in the block, or [`NO_HUB`].
    pub(super) hub: u32,
}

#[derive(Debug, Default)]
pub(super) struct Tree<const N: usize> {
    /// The primitive at each position.
    pub(super) primitives: Vec<u32>,
    /// The positions of the primitive's vertices in the tree of vertices.
    pub(super) vertices: Vec<[u32; N]>,
    /// For each block of primitives, the [areas](area) of its vertices.
    areas: Vec<u64>,
    /// The positions in `vertices`, side by side for each block of primitives, with [`NONE`] in empty lanes.
    pub(super) corners: Vec<[[u32; LANES]; N]>,
    /// The shape at rest of each block of primitives, if there are [neighbours](super::Neighbours).
    pub(super) rest: Vec<RestBlock>,
    /// The levels, from the lowest, whose blocks hold primitives.
    pub(super) levels: Vec<TreeLevel>,
    /// True if nodes may have a hub.
    pub(super) has_hubs: bool,
}

/// The shapes at rest of sixteen primitives, which decide about neighbours.
#[derive(Clone, Copy, Debug)]
pub(super) struct RestBlock {
    pub(super) boxes: BoxBlock,
    pub(super) parts: [u32; LANES],
    /// The largest distance of the boxes of neighbours.
    pub(super) within: [f32; LANES],
}

/// Returns the area of a vertex at a position, as one bit of 64: vertices that lie close together mostly have one area.
#[inline(always)]
fn area(position: u32) -> u64 {
    1 << (position / LANES as u32 % u64::BITS)
}

/// Marks a lane without a vertex.
const NONE: u32 = u32::MAX;

impl<const N: usize> Tree<N> {
    pub(super) fn len(&self) -> usize {
        self.primitives.len()
    }

    /// Returns the highest level, whose one block holds all, or `None` if the tree is empty.
    pub(super) fn top(&self) -> Option<usize> {
        self.levels.len().checked_sub(1)
    }

    /// Puts primitives in order by their centres, and by their hubs if there are any. [`connect`](Self::connect) and
    /// [`refit`](Self::refit) must follow. `centres` is scratch memory.
    pub(super) fn build(
        &mut self,
        primitives: impl Iterator<Item = u32>,
        centre: impl Fn(u32) -> [f32; 3],
        hub: Option<&dyn Fn(u32) -> u32>,
        centres: &mut Vec<Centre>,
    ) {
        centres.clear();
        centres.extend(primitives.map(|item| Centre {
            position: centre(item),
            item,
        }));
        match hub {
            Some(hub) => order_by_hub(centres, hub),
            None => order(centres),
        }
        self.primitives.clear();
        self.primitives.extend(centres.iter().map(|centre| centre.item));

        let mut size = self.primitives.len();
        let mut height = 0;
        while size > 0 {
            if self.levels.len() == height {
                self.levels.push(TreeLevel::default());
            }
            let level = &mut self.levels[height];
            let blocks = size.div_ceil(LANES);
            level.blocks.clear();
            level.blocks.resize(blocks, MovingBlock::empty());
            level.nodes.clear();
            level.nodes.extend((0..blocks).map(|block| {
                let present = Mask::MAX >> (LANES - LANES.min(size - block * LANES));
                Node {
                    bounds: MovingBox::empty(),
                    present,
                    moving: present,
                    hub: NO_HUB,
                }
            }));
            height += 1;
            size = if blocks > 1 { blocks } else { 0 };
        }
        self.levels.truncate(height);
        self.has_hubs = hub.is_some();
        if let Some(hub) = hub {
            let mut below: Vec<u32> = self.primitives.iter().map(|&primitive| hub(primitive)).collect();
            for level in &mut self.levels {
                for (node, hubs) in level.nodes.iter_mut().zip(below.chunks(LANES)) {
                    node.hub = if hubs.iter().all(|hub| hub == &hubs[0]) {
                        hubs[0]
                    } else {
                        NO_HUB
                    };
                }
                below = level.nodes.iter().map(|node| node.hub).collect();
            }
        }
    }

    /// Sets the vertices of each primitive, by their positions.
    pub(super) fn connect(&mut self, vertices_of: impl Fn(u32) -> [u32; N]) {
        self.vertices.clear();
        let of_primitives = self.primitives.iter();
        self.vertices.extend(of_primitives.map(|&primitive| vertices_of(primitive)));
        self.areas.clear();
        let of_block = |block: &[[u32; N]]| block.iter().flatten().fold(0, |areas, &vertex| areas | area(vertex));
        self.areas.extend(self.vertices.chunks(LANES).map(of_block));
        self.corners.clear();
        self.corners.extend(self.vertices.chunks(LANES).map(|chunk| {
            let mut corners = [[NONE; LANES]; N];
            for (lane, vertices) in chunk.iter().enumerate() {
                for (row, &vertex) in corners.iter_mut().zip(vertices) {
                    row[lane] = vertex;
                }
            }
            corners
        }));
    }

    /// Marks the primitives with a vertex that moves, given whether each vertex does, by its position.
    pub(super) fn mark(&mut self, moves: &[bool]) {
        let moving = (0..).zip(moves).filter(|(_, moves)| **moves);
        let moving = moving.fold(0, |areas, (vertex, _)| areas | area(vertex));
        let mut below: &[Node] = &[];
        for (height, level) in self.levels.iter_mut().enumerate() {
            for (block, node) in level.nodes.iter_mut().enumerate() {
                let is_moving = |lane: usize| {
                    let child = block * LANES + lane;
                    match height {
                        // There is no branch, since each answer is unpredictable.
                        0 => {
                            let corners = self.vertices[child].iter();
                            corners.fold(false, |any, &vertex| any | moves[vertex as usize])
                        }
                        _ => below[child].moving != 0,
                    }
                };
                // Where few vertices move, most blocks have none of their areas.
                let may_move = height > 0 || self.areas[block] & moving != 0;
                let lanes = 0..if may_move { node.present.count_ones() as usize } else { 0 };
                node.moving = lanes.fold(0, |mask, lane| mask | Mask::from(is_moving(lane)) << lane);
            }
            below = &level.nodes;
        }
    }

    /// Sets the members of each block from those of each vertex, by its position. An empty slice removes them.
    pub(super) fn note_members(&mut self, of_vertices: &[Members]) {
        self.levels.iter_mut().for_each(|level| level.members.clear());
        if of_vertices.is_empty() {
            return;
        }
        let all = |members: &mut dyn Iterator<Item = Members>| members.reduce(Members::joined);
        let of_primitive = |vertices: &[u32; N]| all(&mut vertices.iter().map(|&vertex| of_vertices[vertex as usize]));
        let mut below: Vec<Members> = self.vertices.iter().filter_map(of_primitive).collect();
        for level in &mut self.levels {
            let blocks = below.chunks(LANES);
            level
                .members
                .extend(blocks.filter_map(|block| all(&mut block.iter().copied())));
            below.clone_from(&level.members);
        }
    }

    /// Sets the shapes at rest from that of each vertex, by its position. An empty slice removes them.
    pub(super) fn note_rest(&mut self, of_vertices: &[AtRest]) {
        self.rest.clear();
        if of_vertices.is_empty() {
            return;
        }
        self.rest.extend(self.vertices.chunks(LANES).map(|block| {
            let mut rest = RestBlock {
                boxes: BoxBlock::empty(),
                parts: [0; LANES],
                within: [f32::NEG_INFINITY; LANES],
            };
            for (lane, vertices) in block.iter().enumerate() {
                let rests = vertices.map(|vertex| of_vertices[vertex as usize]);
                let corners = rests.map(|vertex| Aabb {
                    lower: vertex.position,
                    upper: vertex.position,
                });
                let bounds = corners[1..].iter().fold(corners[0], |bounds, corner| bounds.merged(corner));
                rest.boxes.set(lane, &bounds);
                (rest.parts[lane], rest.within[lane]) = (rests[0].part, rests[0].within);
            }
            rest
        }));
    }

    pub(super) fn mark_all(&mut self) {
        let nodes = self.levels.iter_mut().flat_map(|level| &mut level.nodes);
        nodes.for_each(|node| node.moving = node.present);
    }

    /// Gives all blocks new boxes; with `only_moving`, only blocks in which a primitive moves.
    pub(super) fn refit(&mut self, boxes: &[MovingBox<f32>], only_moving: bool) {
        let Some((leaves, upper)) = self.levels.split_first_mut() else {
            return;
        };
        let vertices = &self.vertices;
        refit_level(leaves, only_moving, |position| {
            let corners = &vertices[position];
            let mut moving = Bounds::new(&boxes[corners[0] as usize]);
            for &vertex in &corners[1..] {
                moving.merge(&Bounds::new(&boxes[vertex as usize]));
            }
            moving
        });
        let mut below = &*leaves;
        for level in upper {
            refit_level(level, only_moving, |child| Bounds::new(&below.nodes[child].bounds));
            below = level;
        }
    }
}

/// The number of blocks that one thread refits at a time.
const BLOCKS: usize = 64;

fn refit_level(level: &mut TreeLevel, only_moving: bool, child: impl Fn(usize) -> Bounds + Sync) {
    let blocks = &mut level.blocks;
    parallel::for_each_chunk_with_chunk(&mut level.nodes, blocks, BLOCKS, |first, nodes, blocks| {
        for (index, (node, block)) in nodes.iter_mut().zip(blocks).enumerate() {
            if only_moving && node.moving == 0 {
                continue;
            }
            let mut bounds = Bounds::new(&MovingBox::empty());
            for lane in 0..node.present.count_ones() as usize {
                let moving = child((first + index) * LANES + lane);
                block.set(lane, &moving.moving_box());
                bounds.merge(&moving);
            }
            node.bounds = bounds.moving_box();
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use selvedge_core::Motion;

    /// The number of vertices: more than [areas](area) tell apart.
    const VERTICES: u32 = 3 * 1024;

    fn tree(edges: &[[u32; 2]]) -> Tree<2> {
        let mut tree = Tree::default();
        let centre = |edge: u32| [edges[edge as usize][0] as f32, 0.0, 0.0];
        tree.build(0..edges.len() as u32, centre, None, &mut Vec::new());
        tree.connect(|edge| edges[edge as usize]);
        tree
    }

    proptest! {
        #[test]
        fn marked_are_the_primitives_with_a_vertex_that_moves_and_the_blocks_with_such_a_primitive(
            edges in prop::collection::vec((0..VERTICES, 0..VERTICES).prop_map(|(a, b)| [a, b]), 1..600),
            moving in prop::collection::btree_set(0..VERTICES, 0..40),
        ) {
            let mut tree = tree(&edges);
            let moves: Vec<bool> = (0..VERTICES).map(|vertex| moving.contains(&vertex)).collect();
            tree.mark(&moves);
            let mut below: Vec<bool> = tree.vertices.iter().map(|ends| ends.iter().any(|end| moving.contains(end))).collect();
            for level in &tree.levels {
                let marked = level.nodes.iter().flat_map(|node| (0..LANES).map(|lane| node.moving >> lane & 1 == 1));
                let mut marked: Vec<bool> = marked.collect();
                prop_assert!(marked.split_off(below.len()).iter().all(|marked| !marked));
                prop_assert_eq!(marked, below);
                below = level.nodes.iter().map(|node| node.moving != 0).collect();
            }
        }

        #[test]
        fn boxes_hold_the_boxes_of_their_vertices_and_no_more(
            edges in prop::collection::vec((0..50_u32, 0..50_u32).prop_map(|(a, b)| [a, b]), 1..300),
            ends in prop::collection::vec(prop::array::uniform6(-1.0..1.0_f32), 50),
            infinite in 0..50_usize,
        ) {
            let point = |&[a, b, c, d, e, f]: &[f32; 6]| MovingBox::from_motion(&Motion::from(([a, b, c], [d, e, f])));
            let mut boxes: Vec<MovingBox<f32>> = ends.iter().map(point).collect();
            boxes[infinite].end = Aabb::everything();
            let mut tree = tree(&edges);
            tree.refit(&boxes, false);
            let of_ends = |&[a, b]: &[u32; 2]| boxes[a as usize].merged(&boxes[b as usize]);
            let mut below: Vec<MovingBox<f32>> = tree.vertices.iter().map(of_ends).collect();
            for level in &tree.levels {
                let held = (0..below.len()).map(|child| level.blocks[child / LANES].get(child % LANES));
                prop_assert!(held.eq(below.iter().copied()));
                let merged = |block: &[MovingBox<f32>]| block.iter().fold(MovingBox::empty(), |all, own| all.merged(own));
                below = below.chunks(LANES).map(merged).collect();
                prop_assert!(level.nodes.iter().map(|node| node.bounds).eq(below.iter().copied()));
            }
        }
    }
}
