//! Several sweeps over constraints, block by block.
//!
//! A block is a few hundred constraints that are near each other. Its vertices are copied to where they stay in the nearest cache, its
//! constraints run there one after another, and what moved is copied back. Blocks are coloured so that those of one colour share no
//! vertex: they may run in any order or at once, with the same bits, for any number of threads. The constraints of a block are sorted by
//! colour as well: one that had to wait for the vertices of the one before would take three times as long.
//!
//! A block in which nothing moved sleeps until a block that shares a vertex with it moves something: what it would do is nothing.

use super::colour::Local;
use super::plan::{Constraint, StepInput, Touches};
use rustc_hash::FxHashMap;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// Constraints that are projected a number of times.
#[derive(Debug)]
pub(crate) struct Sweeps<C, const N: usize> {
    /// By colour.
    blocks: Vec<Block<C, N>>,
    /// The blocks of each colour.
    colours: Vec<Range<usize>>,
    sweeps: u64,
    /// Of each block, whether it may have something to move.
    is_awake: Vec<bool>,
}

#[derive(Debug)]
struct Block<C, const N: usize> {
    constraints: Vec<C>,
    /// Of each constraint, where its vertices are among the block's.
    places: Vec<[u16; N]>,
    vertices: Vec<u32>,
    /// Blocks that share a vertex with it.
    neighbours: Vec<u32>,
    /// The vertices' positions while it runs, and whether it moved any.
    positions: Vec<DVec3>,
    has_moved: bool,
}

/// Most constraints of a block: its vertices, positions and constraints take some 30 kB. At most 2¹⁶ / N.
const MOST: usize = 256;

impl<C: Local<N>, const N: usize> Sweeps<C, N> {
    /// Of constraints on vertices that are at `rest` at rest.
    pub(crate) fn new(constraints: Vec<C>, rest: &[DVec3], sweeps: u64) -> Self {
        let centre = |constraint: &C| {
            let vertices = constraint.vertices().into_iter();
            vertices.map(|v| rest[v as usize]).sum()
        };
        let centres: Vec<DVec3> = constraints.iter().map(centre).collect();
        let mut order: Vec<u32> = (0..constraints.len() as u32).collect();
        let mut groups = Vec::new();
        split(&mut order, &centres, &mut groups);

        let mut constraints: Vec<Option<C>> = constraints.into_iter().map(Some).collect();
        let mut place_of = vec![u32::MAX; rest.len()];
        let mut blocks: Vec<_> = groups
            .into_iter()
            .map(|mut group| {
                group.sort_unstable();
                let own = group.iter().filter_map(|&k| constraints[k as usize].take());
                Block::new(own.collect(), &mut place_of)
            })
            .collect();
        let colours = colour(&mut blocks, rest.len());
        Self {
            is_awake: vec![true; blocks.len()],
            blocks,
            colours,
            sweeps,
        }
    }
}

impl<C: Local<N>, const N: usize> Block<C, N> {
    /// `place_of` holds nothing before, and afterwards, of all vertices of a mesh.
    fn new(mut constraints: Vec<C>, place_of: &mut [u32]) -> Self {
        let mut taken = FxHashMap::<u32, u128>::default();
        constraints.sort_by_cached_key(|constraint| {
            let vertices = constraint.vertices();
            let all = vertices.iter().filter_map(|v| taken.get(v));
            let colour = all.fold(0, |all, own| all | own).trailing_ones();
            for vertex in vertices {
                *taken.entry(vertex).or_default() |= 1_u128.checked_shl(colour).unwrap_or(0);
            }
            colour
        });
        let mut vertices = Vec::new();
        let mut place = |vertex: u32| {
            let place = &mut place_of[vertex as usize];
            if *place == u32::MAX {
                *place = vertices.len() as u32;
                vertices.push(vertex);
            }
            *place as u16
        };
        let places = constraints
            .iter()
            .map(|constraint| constraint.vertices().map(&mut place))
            .collect();
        vertices.iter().for_each(|&vertex| place_of[vertex as usize] = u32::MAX);
        Self {
            constraints,
            places,
            vertices,
            neighbours: Vec::new(),
            positions: Vec::new(),
            has_moved: false,
        }
    }

    /// Runs the constraints on the block's own positions. Returns whether anything moved.
    fn run(&mut self, step: &StepInput<'_>, positions: &[DVec3]) -> bool {
        let own = &mut self.positions;
        own.clear();
        own.extend(self.vertices.iter().map(|&v| positions[v as usize]));
        let stiffening = 1.0 / (step.h * step.h);
        let mut has_moved = false;
        for (constraint, places) in self.constraints.iter().zip(&self.places) {
            let at = places.map(|place| own[usize::from(place)]);
            if constraint.moves_nothing(at) {
                continue;
            }
            let inverse_masses = constraint.vertices().map(|vertex| step.inverse_masses[vertex as usize]);
            let moves = constraint.corrections(at, inverse_masses, stiffening);
            for (place, by) in places.iter().zip(moves) {
                own[usize::from(*place)] += by;
                has_moved |= by != DVec3::ZERO;
            }
        }
        has_moved
    }
}

/// Splits constraints in two by where they are, again and again, until each group fits into a block.
fn split(order: &mut [u32], centres: &[DVec3], groups: &mut Vec<Vec<u32>>) {
    if order.len() <= MOST {
        groups.push(order.to_vec());
        return;
    }
    let points = || order.iter().map(|&k| centres[k as usize]);
    let lower = points().fold(DVec3::INFINITY, DVec3::min);
    let upper = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let axis = (upper - lower).max_position();
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |&a, &b| {
        let [x, y] = [a, b].map(|k| centres[k as usize][axis]);
        x.total_cmp(&y).then(a.cmp(&b))
    });
    let (first, second) = order.split_at_mut(middle);
    split(first, centres, groups);
    split(second, centres, groups);
}

/// Finds each block's neighbours, and sorts blocks so that those of one colour follow each other. Returns those of each.
fn colour<C: Local<N>, const N: usize>(blocks: &mut Vec<Block<C, N>>, vertex_count: usize) -> Vec<Range<usize>> {
    let neighbours = |blocks: &[Block<C, N>]| {
        let mut blocks_of = vec![Vec::new(); vertex_count];
        for (index, block) in blocks.iter().enumerate() {
            for &vertex in &block.vertices {
                blocks_of[vertex as usize].push(index as u32);
            }
        }
        let around = |(index, block): (usize, &Block<C, N>)| {
            let all = block.vertices.iter().flat_map(|&v| &blocks_of[v as usize]);
            let mut around: Vec<u32> = all.copied().filter(|&k| k as usize != index).collect();
            around.sort_unstable();
            around.dedup();
            around
        };
        blocks.iter().enumerate().map(around).collect::<Vec<_>>()
    };
    let mut colours: Vec<usize> = Vec::with_capacity(blocks.len());
    for (index, around) in neighbours(blocks).iter().enumerate() {
        let taken = |colour| {
            let mut earlier = around.iter().filter(|&&k| (k as usize) < index);
            earlier.any(|&k| colours[k as usize] == colour)
        };
        let free = (0..).find(|&colour| !taken(colour)).unwrap_or_default();
        colours.push(free);
    }
    let mut by_colour: Vec<_> = colours.into_iter().zip(blocks.drain(..)).collect();
    by_colour.sort_by_key(|(colour, _)| *colour);
    let mut end = 0;
    let groups = by_colour.chunk_by(|a, b| a.0 == b.0).map(|group| {
        let begin = end;
        end += group.len();
        begin..end
    });
    let groups = groups.collect();
    blocks.extend(by_colour.into_iter().map(|(_, block)| block));
    let neighbours = neighbours(blocks);
    for (block, around) in blocks.iter_mut().zip(neighbours) {
        block.neighbours = around;
    }
    groups
}

impl<C: Local<N>, const N: usize> Sweeps<C, N> {
    /// Runs the blocks of one colour that are awake.
    fn run(&mut self, colour: Range<usize>, step: &StepInput<'_>, positions: &mut [DVec3]) {
        let (read, is_awake, first) = (&*positions, &self.is_awake, colour.start);
        parallel::for_each(&mut self.blocks[colour.clone()], |index, block| {
            block.has_moved = is_awake[first + index] && block.run(step, read);
        });
        self.is_awake[colour.clone()].fill(false);
        for index in colour {
            let block = &self.blocks[index];
            if !block.has_moved {
                continue;
            }
            for (&vertex, &at) in block.vertices.iter().zip(&block.positions) {
                positions[vertex as usize] = at;
            }
            self.is_awake[index] = true;
            for &other in &block.neighbours {
                self.is_awake[other as usize] = true;
            }
        }
    }
}

impl<C: Local<N>, const N: usize> Constraint for Sweeps<C, N> {
    fn project(&mut self, step: &StepInput<'_>, positions: &mut [DVec3], _: &mut Touches) {
        self.is_awake.fill(true);
        for _ in 0..self.sweeps {
            for colour in 0..self.colours.len() {
                self.run(self.colours[colour].clone(), step, positions);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use selvedge::Threads;
    use selvedge::verification::parallel::Workers;

    /// Keeps two vertices no farther apart than one.
    #[derive(Clone, Debug)]
    struct Rope([u32; 2]);

    impl Local<2> for Rope {
        fn vertices(&self) -> [u32; 2] {
            self.0
        }

        fn corrections(&self, [a, b]: [DVec3; 2], _: [f64; 2], _: f64) -> [DVec3; 2] {
            let way = b - a;
            let length = way.length();
            if length <= 1.0 {
                return [DVec3::ZERO; 2];
            }
            let half = way * (0.5 * (length - 1.0) / length);
            [half, -half]
        }

        fn moves_nothing(&self, [a, b]: [DVec3; 2]) -> bool {
            (b - a).length() <= 0.9
        }
    }

    fn run(start: &[DVec3], project: &mut dyn Constraint, threads: usize) -> Vec<DVec3> {
        let mut positions = start.to_vec();
        let step = StepInput {
            time: 0.0,
            h: 1.0,
            start,
            inverse_masses: &vec![1.0; start.len()],
            poses: &[],
        };
        let threads = Workers::new(Threads::from_count(threads)).unwrap();
        threads.run(|| project.project(&step, &mut positions, &mut Touches::default()));
        positions
    }

    /// Points on a wave, and ropes from each to the next and to the one after that.
    fn wave(count: u32, spread: f64) -> (Vec<DVec3>, Vec<Rope>) {
        let at = |k: f64| DVec3::new(k, (k * 0.7).cos(), 0.3 * (k * 1.3).sin()) * spread;
        let ropes = (0..count - 2).flat_map(|k| [Rope([k, k + 1]), Rope([k, k + 2])]);
        ((0..count).map(|k| at(f64::from(k))).collect(), ropes.collect())
    }

    #[test]
    fn blocks_hold_every_constraint_once_and_those_of_a_colour_share_no_vertex() {
        let (rest, ropes) = wave(3000, 0.6);
        let sweeps = Sweeps::new(ropes.clone(), &rest, 1);
        assert!(sweeps.blocks.len() > 16 && sweeps.colours.len() < 5);
        let mut all: Vec<_> = sweeps.blocks.iter().flat_map(|b| &b.constraints).map(|r| r.0).collect();
        all.sort_unstable();
        assert_eq!(all, ropes.iter().map(|rope| rope.0).collect::<Vec<_>>());
        for colour in &sweeps.colours {
            let mut seen = std::collections::HashSet::new();
            let blocks = &sweeps.blocks[colour.clone()];
            assert!(blocks.iter().flat_map(|b| &b.vertices).all(|&v| seen.insert(v)));
        }
        assert_eq!(sweeps.colours.last().unwrap().end, sweeps.blocks.len());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn letting_blocks_sleep_changes_no_bit(
            count in 3..4000_u32, spread in 0.3..0.9_f64, pulled in any::<prop::sample::Index>(),
            far in 0.0..3.0_f64, sweeps in 1..6_u64,
        ) {
            let (mut start, ropes) = wave(count, spread);
            let mut once = Sweeps::new(ropes.clone(), &start, 1);
            let mut many = Sweeps::new(ropes, &start, sweeps);
            start[pulled.index(count as usize)] += DVec3::Y * far;
            let all = (0..sweeps).fold(start.clone(), |at, _| run(&at, &mut once, 1));
            prop_assert_eq!(run(&start, &mut many, 1), all);
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        let (start, ropes) = wave(5000, 0.9);
        let mut sweeps = Sweeps::new(ropes, &start, 4);
        let one = run(&start, &mut sweeps, 1);
        assert_ne!(one, start);
        assert_eq!(one, run(&start, &mut sweeps, 2));
    }
}
