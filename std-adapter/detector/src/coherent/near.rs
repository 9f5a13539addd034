//! The list of near pairs, found for several steps at once.
//!
//! **Guarantee.** Let h be the distance of a class and b the length [beyond](Reach::beyond) it. The list is made for a motion
//! ([`horizon`](super::horizon)). On it, a pair outside the list keeps h + b·(|d₁| + |d₂| + |d₃|) along a direction d of length
//! one ([`sieve`](super::sieve)). While no vertex strays from that motion by more than b/2 along an axis, the list holds every
//! pair within h. While none strays farther than b/2 + (h − m)/(2√3), it holds every pair that may come within m. Reason: the
//! stray along d is at most half of b·(|d₁| + |d₂| + |d₃|) + h − m. If few vertices stray farther, their pairs are found again
//! and added; otherwise all pairs are found again.

use super::horizon::Horizon;
use super::interest::{Interest, Reach};
use super::known::Known;
use super::pair::NearPair;
use super::parts::Parts;
use super::search::Search;
use crate::buffer::append_selected;
use crate::mesh::Topology;
use crate::step::{CollisionFilter, StepError};
use selvedge_core::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::course::room;
use std::ops::Range;
use std::sync::Arc;

/// The inverse of the share of strayed vertices from which on all pairs are found again.
const MANY: usize = 4;

/// Near pairs that are followed from step to step; see the [module](super). Times may be in any unit. Positions must be finite.
///
/// Searches run on the rayon pool of the caller, if there is one, and otherwise on the calling thread.
#[derive(Debug)]
pub struct NearPairs<I: Interest> {
    /// The pairs of the last full search, then those that were added since. Both parts ascend by [key](NearPair::key). Adding
    /// pairs does not move the first part, which may have millions.
    pub list: Vec<NearPair<I::Data>>,
    /// The number of pairs of the last full search.
    first: usize,
    /// The vertices of these pairs side by side, made when they are needed. They take 16 bytes to read for each pair instead of
    /// some 56.
    vertices: Vec<[u32; 4]>,
    /// For each vertex, whether it has [strayed](Self::find_strayed).
    strayed: Vec<bool>,
    search: Search<I>,
    horizon: Horizon,
    reach: Reach,
    /// The largest stray along an axis for which the list holds every pair within its distance.
    slack: f64,
    /// The largest stray along an axis for which the list holds every pair that may come too close.
    room: f64,
    /// The stray of each vertex, in the measure of [`Reach::beyond`].
    pub(super) strays: Vec<f32>,
    found: Vec<NearPair<I::Data>>,
    statistics: NearStatistics,
}

/// Counts of [`NearPairs`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearStatistics {
    /// The number of full searches.
    pub searches: u64,
    /// The number of searches for the pairs of strayed vertices only.
    pub joined: u64,
}

impl<I: Interest> NearPairs<I> {
    /// Makes an empty list for a mesh. It will hold pairs of `interest` that have a `wanted` vertex; there is one entry for each
    /// vertex.
    ///
    /// # Errors
    /// Returns an error if a length in `reach` is negative or not finite.
    ///
    /// # Panics
    /// Panics if there are fewer entries than vertices.
    pub fn new(topology: Arc<Topology>, interest: I, wanted: Vec<bool>, reach: Reach) -> Result<Self, StepError> {
        let mut search = Search::new(topology, interest, wanted);
        search.set_reach(&reach)?;
        Ok(Self {
            list: Vec::new(),
            first: 0,
            vertices: Vec::new(),
            strayed: Vec::new(),
            search,
            horizon: Horizon::new(reach.farthest),
            slack: room(reach.beyond, 0.0),
            room: room(reach.beyond, reach.spare),
            reach,
            strays: Vec::new(),
            found: Vec::new(),
            statistics: Default::default(),
        })
    }

    /// Sets the vertices of parts, such as bodies, that may be far from all else. Far parts change no list and no time of a
    /// search. The ranges ascend and are disjoint, their vertices are not wanted, and no edge or triangle has vertices of two of
    /// them, or of one and others.
    pub fn set_parts(&mut self, parts: Vec<Range<usize>>) {
        let largest = self.reach.classes.iter().map(|class| class.distance).fold(0.0, f64::max);
        let reach = largest + self.reach.beyond;
        self.horizon.parts = Parts::new(parts, self.search.vertex_count(), reach);
    }

    /// Returns the largest coordinate of all vertices that listed pairs may have, in the unit of the positions. It is infinite if
    /// one is not finite.
    #[must_use]
    pub fn largest_coordinate(&self, positions: &[DVec3]) -> f64 {
        self.horizon.parts.largest(positions)
    }

    pub(super) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.search.set_filter(filter);
    }

    /// Sets the largest number of bytes of candidates and near pairs that a search may store.
    pub(super) const fn set_memory_limit(&mut self, limit: u64) {
        self.search.set_memory_limit(limit);
    }

    /// Returns whether the last search needed more bytes than that. The list is then incomplete.
    pub(super) const fn is_over_memory_limit(&self) -> bool {
        self.search.is_over_limit
    }

    /// Returns the interest that the list was made with.
    pub const fn interest(&self) -> &I {
        self.search.interest()
    }

    /// Returns the place of a pair in the list.
    pub fn place_of(&self, key: (PairKind, [u32; 2])) -> Option<usize> {
        let of_run = |run: &[NearPair<I::Data>]| run.binary_search_by_key(&key, NearPair::key).ok();
        let (first, added) = self.list.split_at(self.first);
        of_run(first).or_else(|| Some(first.len() + of_run(added)?))
    }

    /// Replaces `places` by those of all listed pairs with a `marked` vertex, in order. There is one mark for each vertex.
    ///
    /// # Panics
    /// Panics if there are fewer entries than vertices.
    pub fn find_places(&mut self, marked: &[bool], places: &mut Vec<usize>) {
        let (first, added) = self.list.split_at(self.first);
        if self.vertices.is_empty() {
            self.vertices.extend(first.iter().map(|pair| pair.vertices));
        }
        let is_marked = |vertex: u32| marked[vertex as usize];
        let has_marked = |[a, b, c, d]: [u32; 4]| is_marked(a) | is_marked(b) | is_marked(c) | is_marked(d);
        places.clear();
        append_selected(places, &self.vertices, |place, &vertices| (has_marked(vertices), place));
        append_selected(places, added, |place, pair| (has_marked(pair.vertices), first.len() + place));
    }

    /// Returns counts of the searches so far.
    pub const fn statistics(&self) -> NearStatistics {
        self.statistics
    }

    /// Returns which vertices have [strayed](Self::find_strayed).
    pub fn strayed(&self) -> &[bool] {
        &self.strayed
    }

    /// Forgets all earlier steps. Then finds the pairs for a motion that begins with the step from `start` to `end`, which takes
    /// a time of `h`.
    ///
    /// # Panics
    /// Panics as [`cover`](Self::cover) does.
    pub fn refresh(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        self.list.clear();
        self.set_first(0);
        self.horizon.forget();
        self.find(start, end, h);
    }

    /// Ends a step that took a time of `h`.
    pub fn advance(&mut self, h: f64) {
        self.horizon.advance(h);
        self.horizon.ahead.spend(self.reach.upkeep * self.list.len() as f64);
    }

    /// Finds the vertices that stray too far on the path from `start` to `end`, a time of `h` later. Then a pair outside the list
    /// may come closer than allowed. Returns their number.
    pub fn find_strayed(&mut self, [start, end]: [&[DVec3]; 2], h: f64) -> usize {
        self.horizon.parts.update([start, end]);
        self.horizon.find_strayed(end, h, self.room, &mut self.strayed)
    }

    /// Adds the pairs of vertices that have strayed. Returns false if that is impossible, because too many have strayed or the
    /// motion has ended.
    ///
    /// # Panics
    /// Panics as [`cover`](Self::cover) does.
    pub fn add_of_strayed(&mut self, strayed: usize, [start, end]: [&[DVec3]; 2], h: f64) -> bool {
        !self.are_many(strayed, end.len()) && self.horizon.lasts(h) && self.find_of_strayed(start, end, h)
    }

    /// Makes the list valid for the step from `start`, where the last step ended, to `end`, which takes a time of `h`.
    ///
    /// # Panics
    /// Panics if a position is not finite.
    pub fn cover(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        if !self.horizon.lasts(h) {
            return self.find(start, end, h);
        }
        self.horizon.parts.update([start, end]);
        let strayed = self.horizon.find_strayed(end, h, self.slack, &mut self.strayed);
        self.cover_strayed(strayed, start, end, h);
    }

    /// Sets the difference between the displacement of each vertex in the next step and its displacement in the last one.
    pub fn set_bends(&mut self, bends: impl Iterator<Item = DVec3>) {
        self.horizon.bends.clear();
        self.horizon.bends.extend(bends);
    }

    /// Makes the list [valid](Self::cover) for a step from `start` to `end` where the last step may have ended elsewhere.
    ///
    /// # Panics
    /// Panics if a position is not finite.
    pub fn cover_from(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        if !self.horizon.lasts(h) {
            return self.find(start, end, h);
        }
        self.horizon.parts.update([start, end]);
        let mut at_start = Vec::new();
        self.horizon.find_strayed(start, 0.0, self.slack, &mut at_start);
        self.horizon.find_strayed(end, h, self.slack, &mut self.strayed);
        self.strayed
            .iter_mut()
            .zip(at_start)
            .for_each(|(strayed, at_start)| *strayed |= at_start);
        let strayed = self.strayed.iter().filter(|&&strayed| strayed).count();
        self.cover_strayed(strayed, start, end, h);
    }

    /// Returns whether so many strayed vertices, of all these, are too many to be found alone.
    fn are_many(&self, strayed: usize, vertices: usize) -> bool {
        strayed >= self.horizon.parts.count(vertices) / MANY
    }

    fn cover_strayed(&mut self, strayed: usize, start: &[DVec3], end: &[DVec3], h: f64) {
        if strayed > 0 && self.are_many(strayed, end.len()) {
            return self.find(start, end, h);
        }
        self.search.build_if_degraded([start, end]);
        if strayed > 0 {
            self.find_of_strayed(start, end, h);
        }
    }

    /// Adds the pairs of vertices that have strayed. Returns false if it had to find all pairs again.
    fn find_of_strayed(&mut self, start: &[DVec3], end: &[DVec3], h: f64) -> bool {
        self.statistics.joined += 1;
        let Some(expected) = self.horizon.lead_back(&self.strayed, [start, end], h, self.slack) else {
            self.find(start, end, h);
            return false;
        };
        let Self {
            search,
            strayed,
            reach,
            list,
            first,
            found,
            ..
        } = self;
        search.pairs_of(strayed, reach, &expected, Known::new(list, *first), found);
        self.horizon.ahead.spend(self.search.work());
        if self.reach.is_graded {
            self.drop_strayed();
        }
        add(&mut self.list, self.first, &mut self.found);
        true
    }

    /// Removes the pairs with a vertex that has strayed.
    fn drop_strayed(&mut self) {
        let Self {
            list, strayed, first, ..
        } = self;
        let led_back = self.strays.iter_mut().zip(&*strayed).filter(|(_, strayed)| **strayed);
        led_back.for_each(|(stray, _)| *stray = 0.0);
        let has_strayed = |pair: &NearPair<I::Data>| pair.vertices.iter().any(|&vertex| strayed[vertex as usize]);
        let (mut place, mut left_of_first) = (0, 0);
        list.retain(|pair| {
            let stays = !has_strayed(pair);
            left_of_first += usize::from(stays && place < *first);
            place += 1;
            stays
        });
        self.set_first(left_of_first);
    }

    fn set_first(&mut self, first: usize) {
        self.first = first;
        self.vertices.clear();
    }

    /// Finds how far each vertex strays up to `positions`, a time of `h` later, if the list [covers](Self::cover) them. The
    /// strays decide which pairs [need attention](NearPair::needs_attention).
    pub(super) fn find_strays(&mut self, positions: &[DVec3], h: f64) {
        self.horizon.find_strays(positions, h, self.reach.beyond, &mut self.strays);
    }

    /// Finds all pairs for a motion that begins with the step from `start` to `end`, which takes a time of `h`.
    ///
    /// # Panics
    /// Panics as [`cover`](Self::cover) does.
    pub fn find(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        self.statistics.searches += 1;
        self.strays.clear();
        self.strays.resize(end.len(), 0.0);
        let expected = self.horizon.begin(start, end, h, self.slack);
        let known = Known::new(&self.list, self.first);
        self.search.pairs(&self.reach, &expected, known, &mut self.found);
        self.horizon.ahead.spend(self.search.work());
        std::mem::swap(&mut self.list, &mut self.found);
        self.set_first(self.list.len());
    }

    /// Forgets all gaps, because the pairs have moved without a test.
    pub fn forget_gaps(&mut self) {
        self.list.iter_mut().for_each(NearPair::forget_gap);
    }
}

/// Merges `found` into the pairs from `first` on. Both ascend by key, and have no pair in common.
fn add<D: Copy>(pairs: &mut Vec<NearPair<D>>, first: usize, found: &mut Vec<NearPair<D>>) {
    // The merge goes backwards, so that every pair moves at most once, and pairs before the first new one do not move.
    let mut known = pairs.len();
    pairs.extend_from_slice(found);
    while let Some(&new) = found.last() {
        let place = known + found.len() - 1;
        if known > first && pairs[known - 1].key() > new.key() {
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
    use super::super::interest::{CLASSES, Class, OfClass};
    use super::*;
    use proptest::prelude::*;
    use selvedge_core::separation::gap::GapError;
    use std::collections::BTreeSet;

    fn pairs(keys: &BTreeSet<[u32; 2]>, data: u32) -> Vec<NearPair<u32>> {
        let pair = |&pair: &[u32; 2]| NearPair::new(PairKind::EdgeEdge, pair, [0; 4], data);
        keys.iter().map(pair).collect()
    }

    /// An interest in all pairs, each with a number that the caller may replace.
    struct Numbered;

    impl Interest for Numbered {
        type Data = u32;

        fn class(&self, _: PairKind, _: [u32; 4]) -> usize {
            0
        }

        fn about(&self, _: PairKind, _: [u32; 4]) -> Option<u32> {
            Some(7)
        }
    }

    #[test]
    fn data_and_gaps_of_pairs_last_through_a_full_search() {
        let triangle = |height: f64| [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + DVec3::Z * height);
        let positions = [triangle(0.0), triangle(0.1)].concat();
        let topology = Arc::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).unwrap());
        let reach = Reach {
            classes: [Class {
                distance: 0.15,
                margin: 0.0,
            }; CLASSES],
            beyond: 0.02,
            spare: 0.0,
            farthest: 8,
            upkeep: 0.0,
            is_graded: false,
        };
        let mut near = NearPairs::new(topology, Numbered, vec![true; 6], reach).unwrap();
        near.find(&positions, &positions, 1.0);
        assert!(near.list.iter().all(|pair| pair.data == 7 && pair.gap() == f32::NEG_INFINITY));
        let error = GapError::from_largest_coordinate(1.0);
        for (number, pair) in (0..).zip(&mut near.list) {
            assert!(pair.keeps_apart([&positions, &positions], 0.05, error));
            pair.data = number;
        }
        let before = near.list.clone();
        let missing = near.list.remove(3);
        near.set_first(near.list.len());
        near.find(&positions, &positions, 1.0);
        assert_eq!(near.list.len(), before.len());
        for (pair, before) in near.list.iter().zip(&before) {
            assert_eq!((pair.key(), pair.vertices), (before.key(), before.vertices));
            let is_new = pair.key() == missing.key();
            assert_eq!(pair.data, if is_new { 7 } else { before.data });
            assert_eq!(pair.gap(), if is_new { f32::NEG_INFINITY } else { before.gap() });
        }
    }

    proptest! {
        #[test]
        fn what_is_new_is_added_in_order_behind_the_first_and_what_is_known_is_found(
            first in prop::collection::btree_set([0..8_u32, 0..8_u32], 0..30),
            added in prop::collection::btree_set([0..8_u32, 0..8_u32], 0..30),
            found in prop::collection::btree_set([0..8_u32, 0..8_u32], 0..30),
        ) {
            let added: BTreeSet<_> = added.difference(&first).copied().collect();
            let mut all = pairs(&first, 1);
            all.extend(pairs(&added, 2));
            let mut new = pairs(&found, 3);
            let mut known = Known::new(&all, first.len());
            new.retain(|pair| known.find(pair.key()).is_none());
            add(&mut all, first.len(), &mut new);
            let keys = |pairs: &[NearPair<u32>]| pairs.iter().map(|pair| pair.pair).collect::<Vec<_>>();
            let (of_first, of_added) = all.split_at(first.len());
            prop_assert_eq!(keys(of_first), Vec::from_iter(first.iter().copied()));
            let expected = found.union(&added).filter(|pair| !first.contains(*pair));
            prop_assert_eq!(keys(of_added), Vec::from_iter(expected.copied()));
            prop_assert!(of_added.iter().all(|pair| (pair.data == 2) == added.contains(&pair.pair)));
        }

        /// One of several layers of triangles strays towards another.
        #[test]
        fn places_are_those_of_all_pairs_with_a_marked_vertex(
            marked in prop::collection::vec(any::<bool>(), 15),
            strays in 0..4_usize,
        ) {
            let layer = |k: u32| DVec3::Z * (0.2 * f64::from(k));
            let triangles = (0..5).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let topology = Arc::new(Topology::new(15, triangles).unwrap());
            let corners = |k: u32| [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + layer(k));
            let mut positions: Vec<DVec3> = (0..5).flat_map(corners).collect();
            let reach = Reach {
                classes: [Class { distance: 0.15, margin: 0.0 }; CLASSES],
                beyond: 0.02,
                spare: 0.0,
                farthest: 8,
                upkeep: 0.0,
                is_graded: false,
            };
            let mut near = NearPairs::new(topology, OfClass(0), vec![true; 15], reach).unwrap();
            positions[4].z -= 0.1;
            near.refresh(&positions, &positions, 1.0);
            let before = near.list.len();
            let mut places = Vec::new();
            for _ in 0..2 {
                near.find_places(&marked, &mut places);
                let has = |place: &usize| near.list[*place].vertices.iter().any(|&vertex| marked[vertex as usize]);
                prop_assert_eq!(&places, &(0..near.list.len()).filter(has).collect::<Vec<_>>());
                prop_assert!(near.list.iter().enumerate().all(|(place, pair)| near.place_of(pair.key()) == Some(place)));
                let start = positions.clone();
                positions[3 * strays + 2].z += 0.1;
                near.cover(&start, &positions, 1.0);
            }
            prop_assert!(near.list.len() > before && near.statistics().joined > 0 && near.statistics().searches == 1);
        }
    }
}
