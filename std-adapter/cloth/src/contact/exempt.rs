//! Pairs that certificates leave out (exempt pairs): those of bodies that were let pass, and those that were tangled at the start
//! of the simulation.
//!
//! **Bodies** that were let pass are certified again as soon as they are apart from the cloth.
//!
//! **A tangle.** An edge and a face that meet cannot be kept apart, and may have to pass the edges and faces next to them on
//! their way out. So while they meet, all pairs with a vertex of the edge on one side and one of the face on the other are left
//! out. (If only the five pairs that make up the two were left out, tangles would not come apart. A vertex that comes to a face
//! from the wrong side would be held off as long as its edges meet only the faces beside it.) A pair returns as soon as it is
//! apart by its separation and has no such vertices. From then on it is certified like any other pair, and never meets again. All
//! other pairs are certified in every step. The pairs to leave out are computed again after each step, so that
//!
//! * contours can move, grow, shrink and vanish, but none can begin away from the others. An edge and a face that begin to meet
//!   were not yet apart, or share vertices with a pair that met at the start of the step;
//! * when nothing is left out, every state is free again, permanently.

use super::candidate::Candidate;
use super::candidates::{Candidates, OfContact};
use super::crossing::{Crossing, CrossingFinder, PairKey};
use selvedge::{Intersection, StepError};
use selvedge_core::glam::DVec3;

/// The pairs that certificates leave out.
#[derive(Debug)]
pub(crate) struct Exempt {
    /// True for bodies whose pairs are exempt.
    pub(crate) yielding: Vec<bool>,
    /// The tangle, if the simulation starts tangled.
    pub(super) tangle: Option<Tangle>,
}

/// The pairs that meet, and those that met and are not yet apart.
#[derive(Debug)]
pub(crate) struct Tangle {
    finder: CrossingFinder,
    /// The pairs that meet now, in ascending order.
    intersections: Vec<Intersection>,
    crossings: Vec<Crossing>,
    /// A vertex of the edge and one of the face of each intersection, the smaller number first, in order.
    links: Vec<[u32; 2]>,
    /// The pairs without such vertices that are not yet apart by their separation, in order.
    parting: Vec<PairKey>,
    /// True for vertices with links.
    is_linked: Vec<bool>,
}

impl Exempt {
    pub(super) fn new(bodies: usize) -> Self {
        Self {
            yielding: vec![false; bodies],
            tangle: None,
        }
    }

    /// Returns whether certificates leave this pair out.
    #[inline]
    pub(super) fn has(&self, pair: &Candidate) -> bool {
        pair.data.is_with_body() && self.yielding[pair.data.body as usize]
            || self.tangle.as_ref().is_some_and(|tangle| tangle.has(pair))
    }

    /// Returns whether the pair has vertices of an edge and a face that meet: the direction to push it is not known.
    #[inline]
    pub(super) fn is_tangled(&self, pair: &Candidate) -> bool {
        self.tangle.as_ref().is_some_and(|tangle| tangle.links(pair))
    }

    /// Returns whether the pair had such vertices, and is not yet apart by its separation.
    pub(super) fn is_parting(&self, pair: &Candidate) -> bool {
        self.tangle.as_ref().is_some_and(|tangle| tangle.is_parting(pair))
    }

    /// The edges that meet faces, among exempt pairs.
    pub(crate) fn crossings(&self) -> &[Crossing] {
        self.tangle.as_ref().map_or(&[], Tangle::crossings)
    }

    /// The intersections of the tangle.
    pub(super) fn intersections(&self) -> &[Intersection] {
        self.tangle.as_ref().map_or(&[], |tangle| &tangle.intersections)
    }

    /// The exempt pairs of a tangle that have no vertices of an edge and a face that meet; `None` if there is no tangle.
    pub(crate) fn parting(&self) -> Option<&[PairKey]> {
        self.tangle.as_ref().map(Tangle::parting)
    }

    /// Returns whether every pair is certified.
    pub(crate) fn is_empty(&self) -> bool {
        self.tangle.is_none() && !self.yielding.contains(&true)
    }
}

impl Tangle {
    /// Makes a tangle without intersections, of so many vertices.
    pub(super) fn new(interest: &OfContact, vertices: usize) -> Self {
        Self {
            finder: CrossingFinder::new(interest.topology()),
            intersections: Vec::new(),
            crossings: Vec::new(),
            links: Vec::new(),
            parting: Vec::new(),
            is_linked: vec![false; vertices],
        }
    }

    pub(super) fn crossings(&self) -> &[Crossing] {
        &self.crossings
    }

    pub(super) fn parting(&self) -> &[PairKey] {
        &self.parting
    }

    /// Returns whether nothing is left out.
    pub(super) fn is_empty(&self) -> bool {
        self.links.is_empty() && self.parting.is_empty()
    }

    /// Finds the intersections of a state. `parting` are pairs, in order, that are left out even without vertices of an edge and
    /// a face that meet.
    pub(super) fn look(&mut self, interest: &OfContact, parting: Vec<PairKey>, positions: &[DVec3]) -> Result<(), StepError> {
        assert!(parting.is_sorted(), "they are looked up by halving");
        let found = self.finder.find(positions, |a, b| interest.body_of_pair(a, b).is_some())?;
        self.intersections.clear();
        self.intersections.extend_from_slice(found);
        self.crossings.clear();
        self.crossings
            .extend(found.iter().map(|own| interest.crossing(own, positions)));
        self.links.clear();
        self.is_linked.fill(false);
        for Crossing { edge, face, .. } in &self.crossings {
            let links = edge.iter().flat_map(|&a| face.map(|b| link(a, b)));
            self.links.extend(links);
            edge.iter()
                .chain(face)
                .for_each(|&vertex| self.is_linked[vertex as usize] = true);
        }
        self.links.sort_unstable();
        self.links.dedup();
        self.parting = parting;
        Ok(())
    }

    /// Finds the intersections of the state after a step: pairs that `is_apart` accepts are certified again.
    pub(super) fn take_back(&mut self, candidates: &Candidates, positions: &[DVec3], is_apart: impl Fn(&Candidate) -> bool) {
        // Pairs in no list of candidates are farther apart than their separation.
        let parting = candidates.list.iter().filter(|pair| self.has(pair) && !is_apart(pair));
        let mut parting: Vec<_> = parting.map(Candidate::key).collect();
        // Pairs that were added to the list come after the others.
        parting.sort_unstable();
        // If the test fails, as for an infinite coordinate, nothing changes.
        let _ = self.look(candidates.interest(), parting, positions);
    }

    #[inline]
    pub(super) fn has(&self, pair: &Candidate) -> bool {
        self.links(pair) || self.is_parting(pair)
    }

    fn is_parting(&self, pair: &Candidate) -> bool {
        self.parting.binary_search(&pair.key()).is_ok()
    }

    /// Returns whether the pair has vertices of an edge and a face that meet.
    #[inline]
    pub(super) fn links(&self, pair: &Candidate) -> bool {
        let [first, second] = pair.sides();
        let is_link = |a: u32, b: u32| self.is_linked[b as usize] && self.links.binary_search(&link(a, b)).is_ok();
        let mut linked = first.iter().filter(|&&a| self.is_linked[a as usize]);
        linked.any(|&a| second.iter().any(|&b| is_link(a, b)))
    }
}

const fn link(a: u32, b: u32) -> [u32; 2] {
    if a < b { [a, b] } else { [b, a] }
}
