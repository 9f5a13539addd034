//! Constraints on a few vertices each, coloured so that those of one colour share none.
//!
//! Constraints of one colour may run in any order or at once: the result is the same bits, for any number of threads. The
//! colouring is greedy, in the order of the constraints, once per mesh.

use super::plan::{Constraint, StepInput, Touches};
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;
use std::ops::Range;

/// A constraint on `N` vertices.
pub(crate) trait Local<const N: usize>: Debug + Send + Sync {
    fn vertices(&self) -> [u32; N];

    /// Whether all corrections are certainly zero there: a quick test, where there is one.
    fn moves_nothing(&self, _positions: [DVec3; N]) -> bool {
        false
    }

    /// By how much each vertex has to move. `stiffening` is 1/h²: what a compliance is multiplied by.
    fn corrections(&self, positions: [DVec3; N], inverse_masses: [f64; N], stiffening: f64) -> [DVec3; N];
}

/// Constraints by colour.
#[derive(Debug)]
pub(crate) struct Coloured<C, const N: usize> {
    constraints: Vec<C>,
    colours: Vec<Range<usize>>,
    /// From here on constraints found no colour: vertices with more neighbours than colours. They run one after another.
    coloured: usize,
    buffer: Vec<[DVec3; N]>,
}

/// A bit for each colour.
type Taken = u128;

/// Fewer constraints than this are done before another thread has begun.
const WORTH_A_THREAD: usize = 1024;

impl<C: Local<N>, const N: usize> Coloured<C, N> {
    /// For a mesh of so many vertices.
    pub(crate) fn new(constraints: Vec<C>, vertex_count: usize) -> Self {
        let mut taken: Vec<Taken> = vec![0; vertex_count];
        let mut by_colour: Vec<(u32, C)> = constraints
            .into_iter()
            .map(|constraint| {
                let vertices = constraint.vertices().map(|v| v as usize);
                let around = vertices.iter().fold(0, |all, &v| all | taken[v]);
                let colour = Taken::trailing_ones(around);
                if colour < Taken::BITS {
                    vertices.iter().for_each(|&v| taken[v] |= 1 << colour);
                }
                (colour, constraint)
            })
            .collect();
        by_colour.sort_by_key(|(colour, _)| *colour);
        let coloured = by_colour.partition_point(|(colour, _)| *colour < Taken::BITS);
        let mut colours = Vec::new();
        let mut begin = 0;
        for group in by_colour[..coloured].chunk_by(|a, b| a.0 == b.0) {
            colours.push(begin..begin + group.len());
            begin += group.len();
        }
        Self {
            constraints: by_colour.into_iter().map(|(_, c)| c).collect(),
            colours,
            coloured,
            buffer: Vec::new(),
        }
    }

    /// Whether the constraints of one colour should be done [at once](Self::at_once).
    fn is_worth_threads(colour: &Range<usize>) -> bool {
        parallel::has_many_threads() && colour.len() >= WORTH_A_THREAD
    }

    fn in_turn(&self, range: Range<usize>, step: &StepInput<'_>, positions: &mut [DVec3]) {
        let stiffening = stiffening(step);
        for constraint in &self.constraints[range] {
            let vertices = constraint.vertices();
            let moves = corrections(constraint, step, positions, stiffening);
            add(positions, vertices, moves);
        }
    }

    /// The constraints of a colour, found on all threads.
    fn at_once(&mut self, range: Range<usize>, step: &StepInput<'_>, positions: &mut [DVec3]) {
        let stiffening = stiffening(step);
        let constraints = &self.constraints[range];
        let read = &*positions;
        parallel::fill(&mut self.buffer, constraints, |constraint| {
            corrections(constraint, step, read, stiffening)
        });
        for (constraint, &moves) in constraints.iter().zip(&self.buffer) {
            add(positions, constraint.vertices(), moves);
        }
    }
}

/// What a compliance is multiplied by.
fn stiffening(step: &StepInput<'_>) -> f64 {
    1.0 / (step.h * step.h)
}

#[inline(always)]
fn corrections<C: Local<N>, const N: usize>(
    constraint: &C,
    step: &StepInput<'_>,
    positions: &[DVec3],
    stiffening: f64,
) -> [DVec3; N] {
    let vertices = constraint.vertices().map(|v| v as usize);
    let at = vertices.map(|v| positions[v]);
    let inverse_masses = vertices.map(|v| step.inverse_masses[v]);
    constraint.corrections(at, inverse_masses, stiffening)
}

#[inline(always)]
fn add<const N: usize>(positions: &mut [DVec3], vertices: [u32; N], moves: [DVec3; N]) {
    // By index: with an iterator the moves go through memory, and wait there.
    for k in 0..N {
        positions[vertices[k] as usize] += moves[k];
    }
}

impl<C: Local<N>, const N: usize> Constraint for Coloured<C, N> {
    fn project(&mut self, step: &StepInput<'_>, positions: &mut [DVec3], _: &mut Touches) {
        for colour in 0..self.colours.len() {
            let range = self.colours[colour].clone();
            if Self::is_worth_threads(&range) {
                self.at_once(range, step, positions);
            } else {
                self.in_turn(range, step, positions);
            }
        }
        self.in_turn(self.coloured..self.constraints.len(), step, positions);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug)]
    struct Pull([u32; 2]);

    impl Local<2> for Pull {
        fn vertices(&self) -> [u32; 2] {
            self.0
        }

        fn corrections(&self, [a, b]: [DVec3; 2], _: [f64; 2], _: f64) -> [DVec3; 2] {
            let half = 0.25 * (b - a);
            [half, -half]
        }
    }

    fn project(constraints: &[Pull], vertices: usize, threads: usize) -> Vec<DVec3> {
        let mut coloured = Coloured::new(constraints.to_vec(), vertices);
        let mut positions: Vec<_> = (0..vertices)
            .map(|k| DVec3::new((k as f64).sin(), (k as f64 * 0.7).cos(), k as f64))
            .collect();
        let start = positions.clone();
        let step = StepInput {
            time: 0.0,
            h: 1.0,
            start: &start,
            inverse_masses: &vec![1.0; vertices],
            poses: &[],
        };
        let mut run = || coloured.project(&step, &mut positions, &mut Touches::default());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(&mut run);
        positions
    }

    #[test]
    fn constraints_of_one_colour_share_no_vertex_and_all_are_there() {
        let constraints: Vec<_> = (0..300_u32).map(|k| Pull([k % 40, 40 + (k * 7) % 31])).collect();
        let coloured = Coloured::new(constraints, 71);
        assert_eq!(coloured.coloured, 300);
        for colour in &coloured.colours {
            let mut seen = std::collections::HashSet::new();
            for constraint in &coloured.constraints[colour.clone()] {
                assert!(constraint.0.iter().all(|&v| seen.insert(v)), "{colour:?}");
            }
        }
    }

    #[test]
    fn a_vertex_with_more_constraints_than_colours_is_dealt_with() {
        let star: Vec<_> = (1..=200).map(|k| Pull([0, k])).collect();
        let coloured = Coloured::new(star.clone(), 201);
        assert_eq!((coloured.coloured, coloured.constraints.len()), (128, 200));
        assert_ne!(project(&star, 201, 1)[200], project(&star[..199], 201, 1)[200]);
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        let vertices = 8 * WORTH_A_THREAD;
        let grid: Vec<_> = (0..vertices as u32 - 3)
            .flat_map(|k| [Pull([k, k + 1]), Pull([k, k + 3])])
            .collect();
        let one = project(&grid, vertices, 1);
        assert_eq!(one, project(&grid, vertices, 2));
        assert_eq!(one, project(&grid, vertices, 3));
    }
}
