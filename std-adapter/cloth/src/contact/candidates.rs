//! The candidates of the steps to come, found for several at once, each with what is known of it.
//!
//! **What they hold.** Whatever is none keeps, along a direction d of length one, h + b·(|d₁| + |d₂| + |d₃|) on the motion that they were
//! found for ([`horizon`](super::horizon)), h the thickness and b what is looked for beyond it ([`sieve`](super::sieve)). While no vertex
//! strays from that motion by more than b/2 along any axis, they hold every pair within h; while repairs take none farther than
//! b/2 + (h − m)/(2√3), which along d is at most half of b·(|d₁| + |d₂| + |d₃|) + h − m, every pair that may come within m. If few stray
//! farther, the candidates of these are found again and added; else all are found anew.

use super::candidate::Candidate;
use super::horizon::Horizon;
use super::search::{Search, Wanted};
use super::settings::{ContactSettings, NEIGHBOURS_AT_REST, Thickness};
use super::sieve::{self, Distances, Neighbours};
use crate::step::Carrier;
use selvedge::{Topology, TopologyError};
use selvedge_core::glam::DVec3;
use selvedge_core::separation::course::room;
use std::sync::Arc;

/// How far beyond the thickness candidates are looked for, in thicknesses: more makes longer lists that last longer. Measured on the
/// arm sleeve: from 0.2 to 0.7 a step costs the same within a tenth.
const REACH: f64 = 0.3;
/// The same on a fine mesh, which has a small thickness for the way that a vertex goes in a step.
const REACH_OF_FINE: f64 = 0.6;
/// Where the largest thickness of neighbours lies, between the separation and the thickness. On a sleeve of 134,000 triangles
/// three quarters of the pairs within the reach are neighbours that are not within theirs.
const NEIGHBOURS: f64 = 0.2;

/// If one vertex in so many or more has strayed, all candidates are found anew.
const MANY: usize = 4;

/// Pairs near the state.
#[derive(Debug)]
pub(super) struct Candidates {
    /// In ascending order of their keys.
    pub(super) list: Vec<Candidate>,
    /// Vertices that were [found](Self::find_strayed) to have strayed.
    pub(super) strayed: Vec<bool>,
    search: Search,
    horizon: Horizon,
    /// How far vertices may stray along each axis, for candidates to hold every pair within the thickness.
    slack: f64,
    /// The same for every pair that may come within the separation.
    room: f64,
    /// Where new ones are put.
    found: Vec<Candidate>,
}

impl Candidates {
    /// `rest` and `carriers` are of all vertices, the cloth's first. Gives neighbours in `settings` a thickness of their own if they are
    /// many.
    pub(super) fn new(
        settings: &mut ContactSettings,
        triangles: &[[u32; 3]],
        rest: &[DVec3],
        carriers: &[Carrier],
        cloth_vertices: usize,
    ) -> Result<Self, TopologyError> {
        let largest = |pick: fn(Thickness) -> f64| settings.all().map(pick).fold(0.0, f64::max);
        let thickness = largest(|thickness| thickness.thickness);
        let separation = largest(|thickness| thickness.separation);
        let wanted = Wanted {
            cloth: settings.cloth.is_some(),
            bodies: settings.bodies.is_some(),
        };
        let topology = Arc::new(Topology::new(rest.len(), triangles.to_vec())?);
        let mut beyond = thickness * REACH;
        let mut neighbours = None;
        if let Some((_, own)) = settings.cloth {
            let at_rest = NEIGHBOURS_AT_REST * own.thickness;
            if sieve::are_many(&topology, rest, cloth_vertices, at_rest) {
                beyond = thickness * REACH_OF_FINE;
                let smaller = own.separation + NEIGHBOURS * (own.thickness - own.separation);
                settings.neighbours = Some(smaller);
                neighbours = Some(Neighbours {
                    at_rest,
                    thickness: smaller,
                });
            }
        }
        let distances = Distances {
            thickness,
            beyond,
            neighbours,
        };
        let least = settings.neighbours.unwrap_or(thickness);
        Ok(Self {
            list: Vec::new(),
            strayed: Vec::new(),
            search: Search::new(topology, rest, carriers, cloth_vertices, distances, wanted),
            horizon: Horizon::new(neighbours.is_some()),
            slack: room(beyond, 0.0),
            room: room(beyond, least - separation),
            found: Vec::new(),
        })
    }

    /// Forgets everything but the positions.
    pub(super) fn refresh(&mut self, positions: &[DVec3]) {
        self.list.clear();
        self.search.forget();
        self.horizon.forget();
        self.find(positions, positions, 1.0);
        self.horizon.forget();
    }

    /// An edge that passes through a face, of those that are to be kept apart; in words.
    pub(super) fn first_crossing(&self, positions: &[DVec3]) -> Option<String> {
        self.search.first_crossing(positions)
    }

    /// A step of `h` seconds was made.
    pub(super) fn advance(&mut self, h: f64) {
        self.horizon.advance(h);
    }

    /// Finds which vertices have strayed so far that pairs which are no candidates may come within the separation; how many.
    pub(super) fn find_strayed(&mut self, end: &[DVec3], h: f64) -> usize {
        self.horizon.find_strayed(end, h, self.room, &mut self.strayed)
    }

    /// Adds the candidates of vertices that have strayed. Returns whether that was possible: not if many have, or the motion has ended;
    /// or if all were found anew.
    pub(super) fn add_of_strayed(&mut self, strayed: usize, [start, end]: [&[DVec3]; 2], h: f64) -> bool {
        strayed < end.len() / MANY && self.horizon.lasts(h) && self.find_of_strayed(start, end, h)
    }

    /// Sees to it that the candidates are good for the step from `start` to `end`.
    pub(super) fn cover(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        if !self.horizon.lasts(h) {
            return self.find(start, end, h);
        }
        let strayed = self.horizon.find_strayed(end, h, self.slack, &mut self.strayed);
        match strayed {
            0 => {}
            few if few < end.len() / MANY => {
                self.find_of_strayed(start, end, h);
            }
            _ => self.find(start, end, h),
        }
    }

    /// Adds the candidates that vertices have which have strayed. Returns whether it is so; else all were found anew.
    fn find_of_strayed(&mut self, start: &[DVec3], end: &[DVec3], h: f64) -> bool {
        let motion = self.horizon.lead_back(&self.strayed, start, end, h);
        let is_narrow = self.search.candidates_of(&self.strayed, motion, &mut self.found);
        if is_narrow {
            add(&mut self.list, &mut self.found);
        } else {
            self.take_found();
        }
        is_narrow
    }

    /// Candidates for a motion.
    pub(super) fn find(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        let motion = self.horizon.begin(start, end, h, self.slack);
        self.search.candidates(motion, &mut self.found);
        self.take_found();
    }

    /// Replaces the candidates by those that were found, with what is known of them.
    fn take_found(&mut self) {
        // Both lists ascend by key.
        let mut known = self.list.iter().peekable();
        for pair in &mut self.found {
            while known.next_if(|other| other.key < pair.key).is_some() {}
            if let Some(same) = known.next_if(|other| other.key == pair.key) {
                pair.remember(same);
            }
        }
        std::mem::swap(&mut self.list, &mut self.found);
    }

    pub(super) fn forget_gaps(&mut self) {
        self.list.iter_mut().for_each(Candidate::forget_gap);
    }
}

/// Adds to `pairs` those of `found` that are not there yet. Both ascend by key, and do so afterwards.
fn add(pairs: &mut Vec<Candidate>, found: &mut Vec<Candidate>) {
    found.retain(|new| pairs.binary_search_by_key(&new.key, |known| known.key).is_err());
    // From the end, so that every pair is moved at most once, and those before the first new one not at all.
    let mut known = pairs.len();
    pairs.extend_from_slice(found);
    while let Some(&new) = found.last() {
        let place = known + found.len() - 1;
        if known > 0 && pairs[known - 1].key > new.key {
            known -= 1;
            pairs[place] = pairs[known];
        } else {
            pairs[place] = new;
            found.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use selvedge::PairKind;

    fn pairs(keys: &std::collections::BTreeSet<u64>, body: Carrier) -> Vec<Candidate> {
        let pair = |&key: &u64| Candidate::new(key, PairKind::EdgeEdge, [0; 4], body);
        keys.iter().map(pair).collect()
    }

    proptest! {
        #[test]
        fn what_is_new_is_added_in_order_and_what_is_known_stays(
            known in prop::collection::btree_set(0..60_u64, 0..30),
            found in prop::collection::btree_set(0..60_u64, 0..30),
        ) {
            let mut all = pairs(&known, 1);
            add(&mut all, &mut pairs(&found, 2));
            let keys: Vec<_> = all.iter().map(|pair| pair.key).collect();
            prop_assert_eq!(keys, known.union(&found).copied().collect::<Vec<_>>());
            prop_assert!(all.iter().all(|pair| (pair.body == 1) == known.contains(&pair.key)));
        }
    }
}
