//! Test whether torn cloth may open.
//!
//! The two sides of a closed tear touch: no certificate can begin there. But they had a vertex in common just before, and could
//! not have passed through each other. So an opening is free if
//!
//! * all other pairs keep on the way the distance that a step would have to keep, and
//! * at its end the exact test finds that no pair meets, or is so near that rounding cannot distinguish the two. Then the sides
//!   of the tear are apart as well, and certified from there on like any other pair.

use super::candidate::Candidate;
use super::pass::keeps_separation;
use super::separations::Separations;
use super::solver::{ContactSolver, gap_error};
use selvedge_core::glam::DVec3;

impl ContactSolver {
    /// The vertices of the pair that prevents torn cloth from opening; empty if it may open. `from` gives the vertex from which
    /// each vertex was torn; the steps are expected to take `h` seconds. No pair may be exempt.
    pub(crate) fn in_the_way(&mut self, [closed, open]: [&[DVec3]; 2], from: &[u32], h: f64) -> Vec<u32> {
        self.refresh(closed, open, h);
        let mut found = Vec::new();
        let error = gap_error(&self.candidates, [closed, open]);
        let separations = Separations::new(&self.settings, &self.exempt);
        let moves = |pair: &Candidate| pair.vertices.iter().any(|&v| closed[v as usize] != open[v as usize]);
        for pair in &mut self.candidates.list {
            if moves(pair)
                && !were_one(pair, from)
                && let Some(separation) = separations.of(pair)
                && !keeps_separation(pair, [closed, open], separation, error)
            {
                found.extend(pair.vertices);
            }
        }
        if found.is_empty() {
            self.refresh(open, open, h);
            let meeting = self.tolerate(open);
            self.exempt.tangle = None;
            match meeting {
                Ok(crossings) => found.extend(crossings.iter().flat_map(|own| own.edge.into_iter().chain(own.face))),
                Err(_) => found.extend(0..from.len() as u32),
            }
        }
        found
    }

    /// Continues from the state of another solver; `from` gives the vertex of that solver from which each vertex of this one was
    /// made.
    pub(crate) fn take_over(&mut self, other: &Self, from: &[u32]) {
        self.rest.clear();
        self.rest.extend(from.iter().map(|&vertex| other.rest[vertex as usize]));
        (self.counts, self.stages, self.pushes) = (other.counts, other.stages, other.pushes);
    }
}

/// Returns whether the two sides of a pair had a vertex in common.
fn were_one(pair: &Candidate, from: &[u32]) -> bool {
    let [first, second] = pair.sides();
    let whole = |vertex: &u32| from[*vertex as usize];
    first.iter().any(|one| second.iter().any(|other| whole(one) == whole(other)))
}
