//! Several sweeps over coloured constraints, at little more than the price of one.
//!
//! A constraint that would move nothing moves nothing until one of its vertices moves. So only those are visited that may have something
//! to move at the beginning, or around which something moved: the same bits as if all were.

use super::colour::{Coloured, Local};
use super::plan::{Constraint, StepInput, Touches};
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// Constraints that are projected a number of times.
#[derive(Debug)]
pub(crate) struct Sweeps<C, const N: usize> {
    constraints: Coloured<C, N>,
    sweeps: u64,
    /// Where each vertex's constraints begin in `around`.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// A bit for each constraint that is still to be visited.
    pending: Vec<u64>,
}

impl<C: Local<N>, const N: usize> Sweeps<C, N> {
    /// Of constraints on a mesh of so many vertices.
    pub(crate) fn new(constraints: Coloured<C, N>, vertex_count: usize, sweeps: u64) -> Self {
        let all = constraints.all();
        let vertices = || all.iter().map(Local::vertices);
        let mut starts = vec![0_u32; vertex_count + 1];
        for vertex in vertices().flatten() {
            starts[vertex as usize + 1] += 1;
        }
        for vertex in 0..vertex_count {
            starts[vertex + 1] += starts[vertex];
        }
        let mut next = starts.clone();
        let mut around = vec![0; all.len() * N];
        for (index, vertices) in vertices().enumerate() {
            for vertex in vertices {
                around[next[vertex as usize] as usize] = index as u32;
                next[vertex as usize] += 1;
            }
        }
        Self {
            sweeps,
            starts,
            around,
            pending: vec![0; all.len().div_ceil(64)],
            constraints,
        }
    }

    /// Those that may move something where things are now.
    fn find_pending(&mut self, positions: &[DVec3]) {
        let groups = self.constraints.all().chunks(64);
        for (pending, group) in self.pending.iter_mut().zip(groups) {
            *pending = 0;
            for (bit, constraint) in group.iter().enumerate() {
                let at = constraint.vertices().map(|v| positions[v as usize]);
                *pending |= u64::from(!constraint.moves_nothing(at)) << bit;
            }
        }
    }

    /// Visits the pending constraints of a range in ascending order, those included that become pending on the way.
    fn visit(&mut self, range: Range<usize>, step: &StepInput<'_>, positions: &mut [DVec3]) {
        for word in range.start / 64..range.end.div_ceil(64) {
            let first = 64 * word;
            let mut ahead = below(range.end - first) & !below(range.start.saturating_sub(first));
            loop {
                let here = self.pending[word] & ahead;
                if here == 0 {
                    break;
                }
                let bit = here.trailing_zeros() as usize;
                ahead &= !below(bit + 1);
                let index = first + bit;
                let moves = self.constraints.corrections(index, step, positions);
                self.settle(index, &moves, positions);
            }
        }
    }

    /// Visits all constraints of a colour, on all threads: they share no vertex, so none can become pending on the way but by itself.
    fn at_once(&mut self, colour: usize, step: &StepInput<'_>, positions: &mut [DVec3]) {
        let (range, buffer) = self.constraints.at_once(colour, step, positions);
        for (index, moves) in range.zip(&buffer) {
            self.settle(index, moves, positions);
        }
        self.constraints.give_back(buffer);
    }

    /// A constraint was visited: applies what came out, and if that is anything, its neighbours and itself are to be visited again.
    #[inline(always)]
    fn settle(&mut self, index: usize, moves: &[DVec3; N], positions: &mut [DVec3]) {
        self.pending[index / 64] &= !(1 << (index % 64));
        if moves.iter().all(|&by| by == DVec3::ZERO) {
            return;
        }
        let vertices = self.constraints.all()[index].vertices();
        for (vertex, &by) in vertices.into_iter().zip(moves) {
            let vertex = vertex as usize;
            positions[vertex] += by;
            let around = self.starts[vertex] as usize..self.starts[vertex + 1] as usize;
            for &other in &self.around[around] {
                self.pending[other as usize / 64] |= 1 << (other % 64);
            }
        }
    }
}

/// The lowest `count` bits; all if there are no more.
fn below(count: usize) -> u64 {
    if count < 64 { (1 << count) - 1 } else { !0 }
}

impl<C: Local<N>, const N: usize> Constraint for Sweeps<C, N> {
    fn project(&mut self, step: &StepInput<'_>, positions: &mut [DVec3], _: &mut Touches) {
        let count = self.constraints.all().len();
        self.find_pending(positions);
        for colour in 0..self.constraints.colour_count() {
            let range = self.constraints.colour(colour);
            if Coloured::<C, N>::is_worth_threads(&range) {
                self.at_once(colour, step, positions);
            } else {
                self.visit(range, step, positions);
            }
        }
        self.visit(self.constraints.without_colour(), step, positions);
        for _ in 1..self.sweeps {
            self.visit(0..count, step, positions);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parallel::Threads;
    use proptest::prelude::*;

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

    fn run(
        ropes: &[Rope],
        start: &[DVec3],
        project: &mut dyn Constraint,
        threads: usize,
    ) -> Vec<DVec3> {
        let mut positions = start.to_vec();
        let step = StepInput {
            time: 0.0,
            h: 1.0,
            start,
            inverse_masses: &vec![1.0; start.len()],
            poses: &[],
        };
        let threads = Threads::new(threads).unwrap();
        threads.run(|| project.project(&step, &mut positions, &mut Touches::default()));
        assert!(ropes.len() < 1 << 20);
        positions
    }

    proptest! {
        #[test]
        fn leaving_out_what_moves_nothing_changes_no_bit(
            vertices in 2..60_usize,
            pairs in prop::collection::vec(any::<[u32; 2]>(), 1..200),
            spread in 0.5..2.0_f64,
            sweeps in 1..6_u64,
        ) {
            let count = vertices as u32;
            let ropes: Vec<Rope> = pairs
                .into_iter()
                .map(|[a, b]| [a % count, b % count])
                .filter(|[a, b]| a != b)
                .map(Rope)
                .collect();
            let start: Vec<DVec3> = (0..vertices)
                .map(|k| DVec3::new((k as f64 * 1.3).sin(), (k as f64 * 0.7).cos(), 0.5) * spread)
                .collect();
            let coloured = || Coloured::new(ropes.clone(), vertices);
            let mut all = start.clone();
            for _ in 0..sweeps {
                all = run(&ropes, &all, &mut coloured(), 1);
            }
            let mut fewer = Sweeps::new(coloured(), vertices, sweeps);
            prop_assert_eq!(run(&ropes, &start, &mut fewer, 1), all);
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        let vertices = 5000;
        let ropes: Vec<_> = (0..vertices as u32 - 3)
            .flat_map(|k| [Rope([k, k + 1]), Rope([k, k + 3])])
            .collect();
        let start: Vec<DVec3> = (0..vertices)
            .map(|k| DVec3::new(0.9 * k as f64, (k as f64 * 0.7).cos(), 0.0))
            .collect();
        let sweeps = || Sweeps::new(Coloured::new(ropes.clone(), vertices), vertices, 4);
        let one = run(&ropes, &start, &mut sweeps(), 1);
        assert_ne!(one, start);
        assert_eq!(one, run(&ropes, &start, &mut sweeps(), 2));
    }
}
