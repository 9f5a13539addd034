//! The order in which local constraints are projected: the same for any number of threads.
//!
//! Constraints are coloured greedily, once per mesh. Those of one colour share no vertex, so they may run in any order or at
//! once, with the same bits. One colour after another is a Gauss–Seidel sweep.
//!
//! A block runs on its own copy of positions. All constraints of a mesh are one block, or, for several sweeps in a row, blocks of
//! a few hundred neighbouring constraints, whose vertices stay in the nearest cache. Then blocks are coloured as well. Inside a
//! block colours also serve speed: a constraint that waited for the vertices of the one before would take three times as long.
//!
//! **Compliant constraints keep their multipliers** from sweep to sweep of a step (Macklin et al. 2016, algorithm 1). A
//! constraint C of compliance α̃ = α/h² with the accumulated multiplier λ gets Δλ = −(C + α̃λ)/(∇C·W∇C + α̃) from the next sweep,
//! so that sweeps converge to C = −α̃λ, the implicit step. Without λ each sweep would start again from the last result, and more
//! sweeps would be stiffer.
//!
//! A block in which nothing moved sleeps until a block that shares a vertex with it moves something, since its result would be
//! the same.

use super::energy::{Configuration, StoredEnergy};
use super::step::{Constraint, TimeStep, Touches};
use selvedge::parallel;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;
use std::iter::repeat;
use std::ops::Range;

/// A constraint on `N` vertices.
pub(crate) trait Local<const N: usize>: Debug + Send + Sync {
    /// The multipliers of compliant constraints, kept from sweep to sweep of a step and zero before the first; `()` without
    /// compliance.
    type Multipliers: Copy + Debug + Default + Send + Sync;

    /// A quick test: returns true only if all corrections are zero.
    fn moves_nothing(&self, _positions: [DVec3; N]) -> bool {
        false
    }

    /// Returns the correction of each vertex. `stiffening` is 1/h², the factor of compliances.
    ///
    /// `so_far` has the multipliers of earlier sweeps of the step, to which this one adds.
    fn corrections(
        &self,
        positions: [DVec3; N],
        inverse_masses: [f64; N],
        stiffening: f64,
        so_far: &mut Self::Multipliers,
    ) -> [DVec3; N];

    /// Returns the elastic energy in J; `None` if the constraint never stores any.
    fn energy(&self, _positions: [DVec3; N]) -> Option<f64> {
        None
    }
}

/// The vertices of a constraint, and the constraint.
pub(crate) type On<C, const N: usize> = ([u32; N], C);

/// Constraints that are projected in a fixed order, a number of times.
#[derive(Debug)]
pub(crate) struct Schedule<C: Local<N>, const N: usize> {
    /// By colour.
    blocks: Vec<Block<C, N>>,
    /// The blocks of each colour.
    colours: Vec<Range<usize>>,
    sweeps: u64,
    /// Whether each block may have something to move.
    is_awake: Vec<bool>,
}

#[derive(Debug)]
struct Block<C: Local<N>, const N: usize> {
    /// By colour; each on places among the block's vertices.
    constraints: Vec<On<C, N>>,
    /// By constraint, for several sweeps in a row; otherwise empty.
    multipliers: Vec<C::Multipliers>,
    /// The constraints of each colour with enough of them to share among threads.
    shared: Vec<Range<usize>>,
    vertices: Vec<u32>,
    /// Blocks that share a vertex with it.
    neighbours: Vec<u32>,
    /// The vertices' positions while the block runs, and whether any moved.
    positions: Vec<DVec3>,
    has_moved: bool,
    /// By vertex.
    inverse_masses: Vec<f64>,
    /// The results of constraints that threads share.
    corrections: Vec<([DVec3; N], C::Multipliers)>,
}

/// The most constraints of one of many blocks: its vertices, positions and constraints take some 30 kB.
const MOST: usize = 256;
/// Fewer constraints than this are done before another thread has started.
const WORTH_A_THREAD: usize = 1024;

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
        split(&mut order, &centres, &mut groups);

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
            block.inverse_masses.clear();
            block.inverse_masses.extend(at(&block.vertices, step.inverse_masses));
            if self.sweeps > 1 {
                block.multipliers.clear();
                block.multipliers.resize(block.constraints.len(), C::Multipliers::default());
            }
        }
        for _ in 0..self.sweeps {
            for colour in 0..self.colours.len() {
                self.run(self.colours[colour].clone(), step, positions);
            }
        }
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let of_block = |block: &Block<C, N>| {
            let own: Vec<DVec3> = at(&block.vertices, now.positions).collect();
            let constraints = block.constraints.iter();
            constraints
                .map(|(places, constraint)| constraint.energy(of(places, &own)))
                .sum::<Option<f64>>()
        };
        let joules = self.blocks.iter().map(of_block).sum::<Option<f64>>()?;
        Some(StoredEnergy::Elastic(joules))
    }
}

impl<C: Local<N>, const N: usize> Block<C, N> {
    /// Makes a block. `place_of` has an unset entry for each vertex of the mesh, before and afterwards.
    fn new(mut constraints: Vec<On<C, N>>, place_of: &mut [u32]) -> Self {
        let mut vertices = Vec::new();
        for vertex in constraints.iter_mut().flat_map(|(own, _)| own) {
            let place = &mut place_of[*vertex as usize];
            if *place == u32::MAX {
                *place = vertices.len() as u32;
                vertices.push(*vertex);
            }
            *vertex = *place;
        }
        vertices.iter().for_each(|&vertex| place_of[vertex as usize] = u32::MAX);
        let colours = sort_by_colour(&mut constraints, |(places, _)| places, vertices.len());
        Self {
            constraints,
            multipliers: Vec::new(),
            shared: colours.into_iter().filter(|colour| colour.len() >= WORTH_A_THREAD).collect(),
            vertices,
            neighbours: Vec::new(),
            positions: Vec::new(),
            has_moved: false,
            inverse_masses: Vec::new(),
            corrections: Vec::new(),
        }
    }

    /// Runs the constraints on the block's own positions. Returns whether anything moved.
    fn run(&mut self, step: &TimeStep<'_>, positions: &[DVec3]) -> bool {
        self.positions.clear();
        self.positions.extend(at(&self.vertices, positions));
        let mut done = 0;
        if parallel::has_many_threads() {
            for index in 0..self.shared.len() {
                let colour = self.shared[index].clone();
                self.in_turn(done..colour.start, step);
                self.at_once(colour.clone(), step);
                done = colour.end;
            }
        }
        self.in_turn(done..self.constraints.len(), step);
        !at(&self.vertices, positions).eq(self.positions.iter().copied())
    }

    fn in_turn(&mut self, range: Range<usize>, step: &TimeStep<'_>) {
        let stiffening = stiffening(step);
        let (own, inverse_masses) = (&mut self.positions[..], &self.inverse_masses[..]);
        let mut project = |(places, constraint): &On<C, N>, so_far: &mut C::Multipliers| {
            let at = of(places, own);
            if !constraint.moves_nothing(at) {
                let moves = constraint.corrections(at, of(places, inverse_masses), stiffening, so_far);
                add(own, places, moves);
            }
        };
        let constraints = &self.constraints[range.clone()];
        match self.multipliers.get_mut(range) {
            Some(multipliers) => constraints
                .iter()
                .zip(multipliers)
                .for_each(|(on, so_far)| project(on, so_far)),
            None => constraints.iter().for_each(|on| project(on, &mut C::Multipliers::default())),
        }
    }

    /// Runs the constraints of a colour on all threads.
    fn at_once(&mut self, colour: Range<usize>, step: &TimeStep<'_>) {
        let stiffening = stiffening(step);
        let Self {
            constraints,
            multipliers,
            positions,
            inverse_masses,
            corrections,
            ..
        } = self;
        let constraints = &constraints[colour.clone()];
        let multipliers = multipliers.get_mut(colour).unwrap_or_default();
        let so_far = multipliers.iter().copied().chain(repeat(C::Multipliers::default()));
        corrections.clear();
        corrections.extend(so_far.take(constraints.len()).map(|so_far| ([DVec3::ZERO; N], so_far)));
        parallel::for_each(corrections, |index, (moves, so_far)| {
            let (places, constraint) = &constraints[index];
            *moves = constraint.corrections(of(places, positions), of(places, inverse_masses), stiffening, so_far);
        });
        for ((places, _), &(moves, _)) in constraints.iter().zip(&*corrections) {
            add(positions, places, moves);
        }
        for (multipliers, &(_, so_far)) in multipliers.iter_mut().zip(&*corrections) {
            *multipliers = so_far;
        }
    }
}

/// Returns the factor of compliances.
fn stiffening(step: &TimeStep<'_>) -> f64 {
    1.0 / (step.h * step.h)
}

/// Returns the items of these vertices.
fn at<T: Copy>(vertices: &[u32], all: &[T]) -> impl Iterator<Item = T> {
    vertices.iter().map(|&vertex| all[vertex as usize])
}

/// Returns the items at these places. By index, like the next function: `map` would not be inlined, and an iterator would pass
/// moves through memory.
#[inline(always)]
fn of<T: Copy + Default, const N: usize>(places: &[u32; N], all: &[T]) -> [T; N] {
    let mut own = [T::default(); N];
    for k in 0..N {
        own[k] = all[places[k] as usize];
    }
    own
}

#[inline(always)]
fn add<const N: usize>(positions: &mut [DVec3], places: &[u32; N], moves: [DVec3; N]) {
    for k in 0..N {
        positions[places[k] as usize] += moves[k];
    }
}

/// Splits constraints in two by position, repeatedly, until each group fits into a block.
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

/// Sorts items so that those of one colour, which share no vertex, are contiguous. Returns the range of each colour.
///
/// Greedily, each item takes the first colour that no earlier item has at any of its vertices. An item that finds none, since a
/// vertex has more neighbours than there are colours, gets a colour of its own.
fn sort_by_colour<T>(items: &mut Vec<T>, vertices: impl Fn(&T) -> &[u32], vertex_count: usize) -> Vec<Range<usize>> {
    let mut taken = vec![0_u128; vertex_count];
    let colour_of = |item: T| {
        let all = vertices(&item).iter().map(|&v| taken[v as usize]);
        let colour = all.fold(0, |all, own| all | own).trailing_ones();
        let bit = 1_u128.checked_shl(colour).unwrap_or(0);
        vertices(&item).iter().for_each(|&v| taken[v as usize] |= bit);
        (colour, item)
    };
    let mut by_colour: Vec<_> = items.drain(..).map(colour_of).collect();
    by_colour.sort_by_key(|(colour, _)| *colour);
    let mut end = 0;
    let colours = by_colour.chunk_by(|a, b| a.0 == b.0 && a.0 < u128::BITS).map(|group| {
        let begin = end;
        end += group.len();
        begin..end
    });
    let colours = colours.collect();
    items.extend(by_colour.into_iter().map(|(_, item)| item));
    colours
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use selvedge::Threads;
    use selvedge::parallel::Workers;

    /// Keeps two vertices no farther apart than one.
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

    /// Pulls two vertices back to their vector at rest, with a compliance.
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
        let step = TimeStep {
            time: 0.0,
            h: 1.0,
            start,
            inverse_masses: &vec![1.0; start.len()],
            held: &[],
            poses: &[],
        };
        let threads = Workers::new(Threads::from_count(threads)).unwrap();
        threads.run(|| project.project(&step, &mut positions, &mut Touches::default()));
        positions
    }

    /// Points on a wave, and ropes from each to the next and to the one after that.
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
        let (start, ropes) = wave(8 * WORTH_A_THREAD as u32, 0.9);
        let give = springs(&wave(start.len() as u32, 0.4).0, 0.5);
        are_the_same_for_any_number_of_threads(&start, Schedule::once(ropes.clone(), start.len()));
        are_the_same_for_any_number_of_threads(&start, Schedule::in_blocks(ropes, &start, 4));
        are_the_same_for_any_number_of_threads(&start, Schedule::in_blocks(give.clone(), &start, 4));
        // In one block, whose colours threads share.
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
