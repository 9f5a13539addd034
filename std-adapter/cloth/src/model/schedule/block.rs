//! Constraints that run on a copy of their vertices' positions.

use super::colouring::sort_by_colour;
use super::local::{Local, On};
use super::rooms::Rooms;
use crate::model::step::TimeStep;
use selvedge::parallel;
use selvedge_core::glam::DVec3;
use std::iter::repeat;
use std::ops::Range;

/// The number of constraints that are worth a thread. Fewer are done before another thread has started.
pub(super) const WORTH_A_THREAD: usize = 1024;

#[derive(Debug)]
pub(super) struct Block<C: Local<N>, const N: usize> {
    /// The constraints by colour, on places among the block's vertices.
    pub(super) constraints: Vec<On<C, N>>,
    /// The multipliers by constraint, for several sweeps in a row; otherwise empty.
    multipliers: Vec<C::Multipliers>,
    /// The ranges of colours with enough constraints to share among threads.
    shared: Vec<Range<usize>>,
    pub(super) vertices: Vec<u32>,
    /// The blocks that share a vertex with this one.
    pub(super) neighbours: Vec<u32>,
    /// The vertices' positions while the block runs, and whether any moved.
    pub(super) positions: Vec<DVec3>,
    pub(super) has_moved: bool,
    rooms: Rooms,
    inverse_masses: Vec<f64>,
    /// The results of constraints that threads share.
    corrections: Vec<([DVec3; N], C::Multipliers)>,
}

impl<C: Local<N>, const N: usize> Block<C, N> {
    /// Makes a block. `place_of` has an unset entry for each vertex of the mesh, before and afterwards.
    pub(super) fn new(mut constraints: Vec<On<C, N>>, place_of: &mut [u32]) -> Self {
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
            rooms: Rooms::default(),
            inverse_masses: Vec::new(),
            corrections: Vec::new(),
        }
    }

    /// Begins a step of one sweep, or of several with multipliers.
    pub(super) fn begin(&mut self, step: &TimeStep<'_>, has_multipliers: bool) {
        self.inverse_masses.clear();
        self.inverse_masses.extend(at(&self.vertices, step.inverse_masses));
        if has_multipliers {
            self.multipliers.clear();
            self.multipliers.resize(self.constraints.len(), C::Multipliers::default());
        }
    }

    /// Returns the elastic energy in J; `None` if the constraints never store any.
    pub(super) fn energy(&self, positions: &[DVec3]) -> Option<f64> {
        let own: Vec<DVec3> = at(&self.vertices, positions).collect();
        let constraints = self.constraints.iter();
        constraints
            .map(|(places, constraint)| constraint.energy(of(places, &own)))
            .sum()
    }

    /// Runs the constraints on the block's own positions. Returns whether anything moved.
    pub(super) fn run(&mut self, step: &TimeStep<'_>, positions: &[DVec3]) -> bool {
        let now = at(&self.vertices, positions);
        if C::HAS_ROOM {
            self.rooms.begin(&mut self.positions, now, self.constraints.len());
        } else {
            self.positions.clear();
            self.positions.extend(now);
        }
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
        if C::HAS_ROOM {
            return self.rooms.has_moved;
        }
        !at(&self.vertices, positions).eq(self.positions.iter().copied())
    }

    fn in_turn(&mut self, range: Range<usize>, step: &TimeStep<'_>) {
        let stiffening = stiffening(step);
        let (own, inverse_masses) = (&mut self.positions[..], &self.inverse_masses[..]);
        let rooms = &mut self.rooms;
        let mut project = |(index, (places, constraint)): (usize, &On<C, N>), so_far: &mut C::Multipliers| {
            if C::HAS_ROOM && rooms.suffices(index, places, || constraint.room(of(places, own))) {
                return;
            }
            let at = of(places, own);
            if !constraint.moves_nothing(at) {
                let moves = constraint.corrections(at, of(places, inverse_masses), stiffening, so_far);
                add(own, places, moves);
                if C::HAS_ROOM {
                    rooms.follow(places, moves);
                }
            }
        };
        let constraints = (range.start..).zip(&self.constraints[range.clone()]);
        match self.multipliers.get_mut(range) {
            Some(multipliers) => constraints.zip(multipliers).for_each(|(on, so_far)| project(on, so_far)),
            None => constraints.for_each(|on| project(on, &mut C::Multipliers::default())),
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
            rooms,
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
            if C::HAS_ROOM {
                rooms.follow(places, moves);
            }
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

fn at<T: Copy>(vertices: &[u32], all: &[T]) -> impl Iterator<Item = T> {
    vertices.iter().map(|&vertex| all[vertex as usize])
}

/// Returns the items at these places. It indexes, like the next function: `map` would not be inlined, and an iterator would pass
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
