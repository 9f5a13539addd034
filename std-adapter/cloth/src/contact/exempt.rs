//! Pairs that have left the promise: those of bodies that were let pass, and what was tangled where the simulation started.
//!
//! **Bodies** that were let pass come back when they are apart from the cloth.
//!
//! **A tangle.** An edge and a face that meet cannot be kept apart, and may have to pass the edges and faces next to them on their way out. So
//! while they meet, all pairs with a vertex of the edge on one side and a vertex of the face on the other are left out. (With only the
//! five pairs that the two consist of, tangles stick: a vertex that comes to a face from the wrong side would be held off it as long as its edges meet
//! no more than the faces beside it.) A pair that is left out comes back when it is apart by its separation and has no such vertices any more: from
//! then on it is certified as any other, and never meets again. All other pairs are certified in every step. What is left out
//! is found anew after each step, so that
//!
//! * curves along which surfaces pass through each other can move, grow, shrink and vanish, but none can begin where there is none: an edge
//!   and a face that begin to meet have a vertex each in common with such as met at the start of the step, or were not apart yet;
//! * when nothing is left out any more, every state is free again, for good.

use super::candidate::Candidate;
use super::candidates::{Candidates, OfContact};
use super::crossing::{Crossing, CrossingFinder, PairKey};
use selvedge::{Intersection, PairKind, StepError};
use selvedge_core::glam::DVec3;

/// What certificates leave out.
#[derive(Debug)]
pub(crate) struct Exempt {
    /// Bodies whose pairs have left the promise.
    pub(crate) yielding: Vec<bool>,
    /// Made only if the simulation starts tangled.
    pub(super) tangle: Option<Tangle>,
}

/// What meets, and what met and is not apart yet.
#[derive(Debug)]
pub(crate) struct Tangle {
    finder: CrossingFinder,
    /// What meets now, in ascending order.
    intersections: Vec<Intersection>,
    crossings: Vec<Crossing>,
    /// A vertex of the edge and one of the face of each, the smaller number first, in order.
    links: Vec<[u32; 2]>,
    /// Pairs without such vertices that are not apart by their separation yet, in order.
    parting: Vec<PairKey>,
    /// Of each vertex, whether it has links.
    is_linked: Vec<bool>,
}

impl Exempt {
    pub(super) fn new(bodies: usize) -> Self {
        Self {
            yielding: vec![false; bodies],
            tangle: None,
        }
    }

    /// Whether nothing is promised of this pair.
    #[inline]
    pub(super) fn has(&self, pair: &Candidate) -> bool {
        pair.data.is_with_body() && self.yielding[pair.data.body as usize]
            || self.tangle.as_ref().is_some_and(|tangle| tangle.has(pair))
    }

    /// Whether something may be tangled.
    pub(super) fn has_tangle(&self) -> bool {
        self.tangle.is_some()
    }

    /// Whether the pair is about something that meets: which way it would have to be pushed is not known.
    #[inline]
    pub(super) fn is_tangled(&self, pair: &Candidate) -> bool {
        self.tangle.as_ref().is_some_and(|tangle| tangle.links(pair))
    }

    /// Whether the pair was about something that met, and is not apart by its separation yet.
    pub(super) fn is_parting(&self, pair: &Candidate) -> bool {
        self.tangle.as_ref().is_some_and(|tangle| tangle.is_parting(pair))
    }

    /// Edges that meet faces, of those that have left the promise.
    pub(crate) fn crossings(&self) -> &[Crossing] {
        self.tangle.as_ref().map_or(&[], Tangle::crossings)
    }

    /// What they are.
    pub(super) fn intersections(&self) -> &[Intersection] {
        self.tangle.as_ref().map_or(&[], |tangle| &tangle.intersections)
    }

    /// Pairs of a tangle that are left out besides those about what meets; `None` if there is no tangle.
    pub(crate) fn parting(&self) -> Option<&[PairKey]> {
        self.tangle.as_ref().map(Tangle::parting)
    }

    /// Whether all is certified.
    pub(crate) fn is_empty(&self) -> bool {
        self.tangle.is_none() && !self.yielding.contains(&true)
    }
}

impl Tangle {
    /// Nothing yet, of so many vertices.
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

    /// Whether nothing is left out.
    pub(super) fn is_empty(&self) -> bool {
        self.links.is_empty() && self.parting.is_empty()
    }

    /// Looks at a state anew. `parting` are pairs, in order, that are left out even if they are not about what meets.
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

    /// Looks at the state after a step: what `is_apart` comes back into the promise.
    pub(super) fn take_back(&mut self, candidates: &Candidates, positions: &[DVec3], is_apart: impl Fn(&Candidate) -> bool) {
        // What is in no list of candidates is farther apart than that.
        let parting = candidates.list.iter().filter(|pair| self.has(pair) && !is_apart(pair));
        let mut parting: Vec<_> = parting.map(Candidate::key).collect();
        // What was added to the list comes after the others.
        parting.sort_unstable();
        // Where it cannot be asked, as a coordinate is beyond all numbers, all stays as it was.
        let _ = self.look(candidates.interest(), parting, positions);
    }

    #[inline]
    pub(super) fn has(&self, pair: &Candidate) -> bool {
        self.links(pair) || self.is_parting(pair)
    }

    fn is_parting(&self, pair: &Candidate) -> bool {
        self.parting.binary_search(&pair.key()).is_ok()
    }

    /// Whether it is about what meets.
    #[inline]
    pub(super) fn links(&self, pair: &Candidate) -> bool {
        let of_first = match pair.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        };
        let (first, second) = pair.vertices.split_at(of_first);
        let is_link = |a: u32, b: u32| self.is_linked[b as usize] && self.links.binary_search(&link(a, b)).is_ok();
        let mut linked = first.iter().filter(|&&a| self.is_linked[a as usize]);
        linked.any(|&a| second.iter().any(|&b| is_link(a, b)))
    }
}

const fn link(a: u32, b: u32) -> [u32; 2] {
    if a < b { [a, b] } else { [b, a] }
}
