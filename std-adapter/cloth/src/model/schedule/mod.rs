//! The order in which local constraints are projected: the same for any number of threads.
//!
//! Constraints are coloured greedily, once per mesh. Those of one colour share no vertex, so they may run in any order or at
//! once, with the same bits. One colour after another is a Gauss–Seidel sweep.
//!
//! A block runs on its own copy of positions. One block has all constraints of a mesh. For several sweeps in a row there are
//! blocks of a few hundred neighbouring constraints instead, whose vertices stay in the nearest cache. These blocks are coloured
//! as well. Inside a block colours also serve speed: a constraint that waited for the vertices of the one before would take three
//! times as long.
//!
//! **Compliant constraints keep their multipliers** from sweep to sweep of a step (Macklin et al. 2016, algorithm 1). A
//! constraint C of compliance α̃ = α/h² with the accumulated multiplier λ gets Δλ = −(C + α̃λ)/(∇C·W∇C + α̃) from the next sweep.
//! So sweeps converge to C = −α̃λ, the implicit step. Without λ each sweep would start again from the last result, and more
//! sweeps would be stiffer.
//!
//! A block in which nothing moved sleeps until a block that shares a vertex with it moves something, since its result would be
//! the same.

mod block;
mod colouring;
mod local;
mod rooms;

pub(crate) use local::{Local, On};
pub(crate) use rooms::Rooms;

use super::energy::{Configuration, StoredEnergy};
use super::step::{Constraint, TimeStep, Touches};
use block::Block;
use colouring::{in_groups, sort_by_colour};
use selvedge::parallel;
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// Constraints that are projected in a fixed order, once or several times.
#[derive(Debug)]
pub(crate) struct Schedule<C: Local<N>, const N: usize> {
    /// The blocks, sorted by colour.
    blocks: Vec<Block<C, N>>,
    colours: Vec<Range<usize>>,
    sweeps: u64,
    /// True for blocks that may move vertices.
    is_awake: Vec<bool>,
}

impl<C: Local<N>, const N: usize> Schedule<C, N> {
    /// Makes one block that runs once, on a mesh of `vertex_count` vertices.
    pub(crate) fn once(constraints: Vec<On<C, N>>, vertex_count: usize) -> Self {
        Self::of(vec![constraints], vertex_count, 1)
    }

    /// Makes blocks that run `sweeps` times, on vertices with these rest positions.
    pub(crate) fn times(constraints: Vec<On<C, N>>, rest: &[DVec3], sweeps: u32) -> Self {
        match sweeps {
            1 => Self::once(constraints, rest.len()),
            _ => Self::in_blocks(constraints, rest, sweeps.into()),
        }
    }

    /// Makes blocks of neighbouring constraints that run several times, on vertices with these rest positions.
    pub(crate) fn in_blocks(constraints: Vec<On<C, N>>, rest: &[DVec3], sweeps: u64) -> Self {
        let centre = |(vertices, _): &On<C, N>| vertices.iter().map(|&v| rest[v as usize]).sum();
        let centres: Vec<DVec3> = constraints.iter().map(centre).collect();
        let mut order: Vec<u32> = (0..constraints.len() as u32).collect();
        let mut groups = Vec::new();
        in_groups(&mut order, &centres, &mut groups);

        let mut constraints: Vec<_> = constraints.into_iter().map(Some).collect();
        let mut take = |mut group: Vec<u32>| {
            group.sort_unstable();
            let own = group.into_iter().filter_map(|k| constraints[k as usize].take());
            own.collect()
        };
        let groups = groups.into_iter().map(&mut take).collect();
        Self::of(groups, rest.len(), sweeps)
    }

    fn of(groups: Vec<Vec<On<C, N>>>, vertex_count: usize, sweeps: u64) -> Self {
        let mut place_of = vec![u32::MAX; vertex_count];
        let mut blocks: Vec<_> = groups.into_iter().map(|group| Block::new(group, &mut place_of)).collect();
        let colours = sort_by_colour(&mut blocks, |block| &block.vertices, vertex_count);
        let mut blocks_of = vec![Vec::new(); vertex_count];
        for (index, block) in blocks.iter().enumerate() {
            block.vertices.iter().for_each(|&v| blocks_of[v as usize].push(index as u32));
        }
        for (index, block) in blocks.iter_mut().enumerate() {
            let around = block.vertices.iter().flat_map(|&v| &blocks_of[v as usize]);
            block.neighbours = around.copied().filter(|&k| k as usize != index).collect();
            block.neighbours.sort_unstable();
            block.neighbours.dedup();
        }
        Self {
            is_awake: vec![true; blocks.len()],
            blocks,
            colours,
            sweeps,
        }
    }

    /// Runs the blocks of one colour that are awake.
    fn run(&mut self, colour: Range<usize>, step: &TimeStep<'_>, positions: &mut [DVec3]) {
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

impl<C: Local<N>, const N: usize> Constraint for Schedule<C, N> {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        self.is_awake.fill(true);
        for block in &mut self.blocks {
            block.begin(step, self.sweeps > 1);
        }
        for _ in 0..self.sweeps {
            for colour in 0..self.colours.len() {
                self.run(self.colours[colour].clone(), step, positions);
            }
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let joules = { self.blocks.iter() }.map(|block| block.energy(now.positions));
        let joules = joules.sum::<Option<f64>>()?;
        Some(StoredEnergy::Elastic(joules))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use selvedge::Threads;
    use selvedge::parallel::Workers;

    #[derive(Clone, Debug)]
    struct Rope;

    impl Local<2> for Rope {
        type Multipliers = ();

        fn corrections(&self, [a, b]: [DVec3; 2], _: [f64; 2], _: f64, _: &mut ()) -> [DVec3; 2] {
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

    /// A constraint that pulls two vertices back to their vector at rest, with a compliance.
    #[derive(Clone, Debug)]
    struct Spring {
        rest: DVec3,
        compliance: f64,
    }

    impl Local<2> for Spring {
        type Multipliers = DVec3;

        fn corrections(&self, [a, b]: [DVec3; 2], [v, w]: [f64; 2], stiffening: f64, so_far: &mut DVec3) -> [DVec3; 2] {
            let compliance = self.compliance * stiffening;
            let multiplier = -(b - a - self.rest + *so_far * compliance) / (v + w + compliance);
            *so_far += multiplier;
            [multiplier * -v, multiplier * w]
        }
    }

    fn springs(rest: &[DVec3], compliance: f64) -> Vec<On<Spring, 2>> {
        let spring = |[a, b]: [u32; 2]| {
            let rest = rest[b as usize] - rest[a as usize];
            ([a, b], Spring { rest, compliance })
        };
        (0..rest.len() as u32 - 2)
            .flat_map(|k| [[k, k + 1], [k, k + 2]])
            .map(spring)
            .collect()
    }

    fn run<C: Constraint>(start: &[DVec3], project: &mut C, threads: usize) -> Vec<DVec3> {
        let mut positions = start.to_vec();
        let inverse_masses = vec![1.0; start.len()];
        let step = TimeStep::first(1.0, start, &inverse_masses);
        let threads = Workers::new(Threads::from_count(threads)).unwrap();
        threads.run(|| project.project(&step, &mut positions, &mut Touches::default()));
        positions
    }

    /// Returns points on a wave, and ropes from each to the next and to the one after that.
    fn wave(count: u32, spread: f64) -> (Vec<DVec3>, Vec<On<Rope, 2>>) {
        let at = |k: f64| DVec3::new(k, (k * 0.7).cos(), 0.3 * (k * 1.3).sin()) * spread;
        let ropes = (0..count - 2).flat_map(|k| [([k, k + 1], Rope), ([k, k + 2], Rope)]);
        ((0..count).map(|k| at(f64::from(k))).collect(), ropes.collect())
    }

    fn share_no_vertex<'a>(mut vertices: impl Iterator<Item = &'a u32>) -> bool {
        let mut seen = std::collections::HashSet::new();
        vertices.all(|&v| seen.insert(v))
    }

    #[test]
    fn constraints_of_one_colour_share_no_vertex_and_all_are_there() {
        let mut constraints: Vec<[u32; 2]> = (0..300).map(|k| [k % 40, 40 + (k * 7) % 31]).collect();
        let colours = sort_by_colour(&mut constraints, |own| own, 71);
        assert_eq!((constraints.len(), colours.last().unwrap().end), (300, 300));
        assert!(
            colours
                .into_iter()
                .all(|colour| share_no_vertex(constraints[colour].as_flattened().iter()))
        );
    }

    #[test]
    fn blocks_hold_every_constraint_once_and_those_of_a_colour_share_no_vertex() {
        let (rest, ropes) = wave(3000, 0.6);
        let schedule = Schedule::in_blocks(ropes.clone(), &rest, 1);
        let Schedule { blocks, colours, .. } = &schedule;
        assert!(blocks.len() > 16 && colours.len() < 5);
        let vertices = |block: &Block<Rope, 2>| -> Vec<_> {
            let all = block.constraints.iter();
            all.map(|(places, _)| places.map(|place| block.vertices[place as usize]))
                .collect()
        };
        let mut all: Vec<_> = blocks.iter().flat_map(vertices).collect();
        all.sort_unstable();
        assert_eq!(all, ropes.into_iter().map(|(own, _)| own).collect::<Vec<_>>());
        let of_colour = |colour: &Range<usize>| &blocks[colour.clone()];
        let share_none = |colour| share_no_vertex(of_colour(colour).iter().flat_map(|block| &block.vertices));
        assert!(colours.iter().all(share_none));
        assert_eq!(colours.last().unwrap().end, blocks.len());
    }

    #[test]
    fn a_vertex_with_more_constraints_than_colours_is_dealt_with() {
        let star = |count: u32| (1..=count).map(|k| ([0, k], Rope)).collect();
        let start: Vec<_> = (0..=200).map(|k| DVec3::new((k as f64).sin(), 0.0, k as f64)).collect();
        let pulled = |count| run(&start, &mut Schedule::once(star(count), 201), 1)[200];
        assert_ne!(pulled(200), pulled(199));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn letting_blocks_sleep_changes_no_bit(
            count in 3..4000_u32, spread in 0.3..0.9_f64, pulled in any::<prop::sample::Index>(),
            far in 0.0..3.0_f64, sweeps in 1..6_u64,
        ) {
            let (mut start, ropes) = wave(count, spread);
            let mut once = Schedule::in_blocks(ropes.clone(), &start, 1);
            let mut many = Schedule::in_blocks(ropes, &start, sweeps);
            start[pulled.index(count as usize)] += DVec3::Y * far;
            let all = (0..sweeps).fold(start.clone(), |at, _| run(&at, &mut once, 1));
            prop_assert_eq!(run(&start, &mut many, 1), all);
        }

        /// One sweep is exact for constraints that share no vertex.
        #[test]
        fn more_sweeps_make_nothing_stiffer_by_itself(
            pulled in -3.0..3.0_f64, compliance in 1e-3..1e3_f64, sweeps in 2..9_u64,
        ) {
            let mut start = wave(3, 1.0).0;
            let spring = springs(&start, compliance)[..1].to_vec();
            let rest = start.clone();
            start[1] += DVec3::Y * pulled;
            let once = run(&start, &mut Schedule::once(spring.clone(), 3), 1);
            let many = run(&start, &mut Schedule::in_blocks(spring, &rest, sweeps), 1);
            prop_assert!(once[1].distance(many[1]) < 1e-12, "{} and {}", once[1], many[1]);
        }

        /// In an implicit step of length one and masses of one, the move of a vertex is the sum of the springs' forces there.
        #[test]
        fn many_sweeps_come_to_the_implicit_step(
            count in 3..30_u32, pulled in any::<prop::sample::Index>(), compliance in 0.5..10.0_f64,
        ) {
            let mut start = wave(count, 0.5).0;
            let all = springs(&start, compliance);
            let rest = start.clone();
            start[pulled.index(count as usize)] += DVec3::Y;
            let end = run(&start, &mut Schedule::in_blocks(all.clone(), &rest, 400), 1);
            let mut left: Vec<DVec3> = end.iter().zip(&start).map(|(end, start)| *end - *start).collect();
            for ([a, b], Spring { rest, compliance }) in all {
                let force = (end[b as usize] - end[a as usize] - rest) / compliance;
                left[a as usize] -= force;
                left[b as usize] += force;
            }
            prop_assert!(left.iter().all(|left| left.length() < 1e-9), "{left:?}");
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        let (start, ropes) = wave(8 * block::WORTH_A_THREAD as u32, 0.9);
        let give = springs(&wave(start.len() as u32, 0.4).0, 0.5);
        are_the_same_for_any_number_of_threads(&start, Schedule::once(ropes.clone(), start.len()));
        are_the_same_for_any_number_of_threads(&start, Schedule::in_blocks(ropes, &start, 4));
        are_the_same_for_any_number_of_threads(&start, Schedule::in_blocks(give.clone(), &start, 4));
        // All constraints are in one block, whose colours threads share.
        let in_one = Schedule {
            sweeps: 3,
            ..Schedule::once(give, start.len())
        };
        are_the_same_for_any_number_of_threads(&start, in_one);
    }

    fn are_the_same_for_any_number_of_threads<C: Local<2>>(start: &[DVec3], mut schedule: Schedule<C, 2>) {
        let one = run(start, &mut schedule, 1);
        assert_ne!(one, start);
        assert_eq!(one, run(start, &mut schedule, 2));
        assert_eq!(one, run(start, &mut schedule, 3));
    }
}
