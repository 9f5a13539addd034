//! Finds the pairs that may come near each other on a motion, by [hierarchies of moving boxes](crate::broad_phase) and a
//! [sieve](super::sieve).

use super::horizon::Expected;
use super::interest::{Interest, Reach};
use super::known::Known;
use super::pair::NearPair;
use super::parts::Parts;
use super::sieve::{Sieve, SievedPair};
use crate::broad_phase::MovingBroadPhase;
use crate::mesh::Topology;
use crate::parallel;
use crate::step::{CollisionFilter, StepError};
use selvedge_core::PairKind;
use selvedge_core::glam::DVec3;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

#[derive(Debug)]
pub(super) struct Search<I> {
    topology: Arc<Topology>,
    interest: I,
    /// The vertices of which a pair of interest has at least one.
    wanted: Vec<bool>,
    /// True if the broad phase finds pairs of few vertices only.
    is_narrowed: bool,
    broad_phase: MovingBroadPhase,
    /// The largest number of bytes of candidates and near pairs.
    memory_limit: u64,
    /// True if the last search needed more bytes. It then found no pairs.
    pub(super) is_over_limit: bool,
    sieve: Sieve,
    vertex_face: Vec<[u32; 2]>,
    edge_edge: Vec<[u32; 2]>,
    /// The pairs that the sieve leaves.
    left: Vec<SievedPair>,
    by_first: Vec<SievedPair>,
    places: Vec<u32>,
}

impl<I: Interest> Search<I> {
    /// Makes a search for pairs with a `wanted` vertex. There is one entry for each vertex.
    pub(super) fn new(topology: Arc<Topology>, interest: I, wanted: Vec<bool>) -> Self {
        let mut broad_phase = MovingBroadPhase::new(Arc::clone(&topology));
        broad_phase.set_wanted(wanted.clone());
        broad_phase.set_neighbours(interest.neighbours());
        Self {
            sieve: Sieve::new(topology.vertex_count()),
            topology,
            interest,
            wanted,
            is_narrowed: false,
            broad_phase,
            memory_limit: u64::MAX,
            is_over_limit: false,
            vertex_face: Vec::new(),
            edge_edge: Vec::new(),
            left: Vec::new(),
            by_first: Vec::new(),
            places: Vec::new(),
        }
    }

    pub(super) const fn set_memory_limit(&mut self, limit: u64) {
        self.memory_limit = limit;
    }

    pub(super) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.broad_phase.set_filter(filter);
    }

    pub(super) fn vertex_count(&self) -> usize {
        self.topology.vertex_count()
    }

    pub(super) const fn interest(&self) -> &I {
        &self.interest
    }

    /// Sets the reach of the search.
    ///
    /// # Errors
    /// Returns an error if a length is negative or not finite. The old reach then stays.
    pub(super) fn set_reach(&mut self, reach: &Reach) -> Result<(), StepError> {
        let largest = reach.classes.iter().map(|class| class.distance).fold(0.0, f64::max);
        self.broad_phase.set_separation(largest + reach.beyond)
    }

    /// Replaces `pairs` by those of a motion, in ascending order of their keys, so that they do not depend on earlier steps. The
    /// data of `known` pairs stay.
    ///
    /// # Panics
    /// Panics if a position is not finite.
    pub(super) fn pairs(
        &mut self,
        reach: &Reach,
        expected: &Expected<'_>,
        known: Known<'_, I::Data>,
        pairs: &mut Vec<NearPair<I::Data>>,
    ) {
        if std::mem::take(&mut self.is_narrowed) {
            self.broad_phase.set_wanted(self.wanted.clone());
        }
        self.update(reach, expected, None);
        self.find(reach, expected.parts, None, known, pairs);
    }

    /// Replaces `pairs` by those with a vertex in `only`. The other vertices must have the motion of the last search. Pairs that
    /// are `known` are left out, unless strays are graded.
    ///
    /// # Panics
    /// Panics if a position is not finite.
    pub(super) fn pairs_of(
        &mut self,
        only: &[bool],
        reach: &Reach,
        expected: &Expected<'_>,
        known: Known<'_, I::Data>,
        pairs: &mut Vec<NearPair<I::Data>>,
    ) {
        self.broad_phase.narrow_to(only.to_vec());
        self.is_narrowed = true;
        self.update(reach, expected, Some(only));
        self.find(reach, expected.parts, Some(only), known, pairs);
    }

    /// Returns the number of near boxes of the last search, including neighbours that were left out. It is a measure of the cost.
    pub(super) fn work(&self) -> f64 {
        let left_out = self.broad_phase.neighbours_left_out();
        (self.vertex_face.len() + self.edge_edge.len()) as f64 + left_out as f64
    }

    /// Builds degraded hierarchies in a step without a search, so that the next search need not.
    pub(super) fn build_if_degraded(&mut self, [start, end]: [&[DVec3]; 2]) {
        self.broad_phase.build_if_degraded(start, end);
    }

    fn update(&mut self, reach: &Reach, expected: &Expected<'_>, only: Option<&[bool]>) {
        let [start, end] = expected.motion;
        let certain_gap = self.sieve.set_motion(reach, expected.motion, expected.largest, only);
        self.broad_phase.set_separation_of_neighbours(certain_gap);
        if expected.largest.is_finite() {
            // So are all positions: parts are far only where theirs are finite.
            return self.broad_phase.update_finite(start, end);
        }
        let updated = self.broad_phase.update(start, end);
        updated.expect("positions are finite");
    }

    fn find(
        &mut self,
        reach: &Reach,
        parts: &Parts,
        only: Option<&[bool]>,
        mut known: Known<'_, I::Data>,
        pairs: &mut Vec<NearPair<I::Data>>,
    ) {
        let Self {
            topology,
            interest,
            broad_phase,
            memory_limit,
            is_over_limit,
            sieve,
            vertex_face,
            edge_edge,
            left,
            by_first,
            places,
            ..
        } = self;
        let stored = AtomicU64::new(0);
        let limit = *memory_limit;
        let stores = |bytes: usize| stored.fetch_add(bytes as u64, Ordering::Relaxed) + bytes as u64 <= limit;
        broad_phase.candidates_until(&|pairs| stores(pairs * size_of::<[u32; 2]>()), vertex_face, edge_edge);
        *is_over_limit = !stores(0);
        let counts = [topology.vertex_count(), topology.edges().len()];
        let only_new = only.is_some() && !reach.is_graded;
        pairs.clear();
        for (kind, found, count) in [
            (PairKind::VertexFace, vertex_face, counts[0]),
            (PairKind::EdgeEdge, edge_edge, counts[1]),
        ] {
            let enough = reach.beyond as f32;
            if *is_over_limit {
                break;
            }
            parallel::gather(left, found, |pairs, left| {
                sieve.leave(topology, interest, enough, (kind, pairs), left);
            });
            if !stores(left.len() * size_of::<NearPair<I::Data>>()) {
                *is_over_limit = true;
                pairs.clear();
                break;
            }
            // Boxes are too coarse to leave out all pairs of far parts, and the sieve does not count on them.
            let are_near = |vertices: &[u32; 4]| vertices.iter().all(|&vertex| parts.is_near(vertex));
            pairs.reserve(left.len());
            for_each_in_order(left, count, by_first, places, |SievedPair { pair, stray }| {
                if let Some(same) = known.find((kind, pair)) {
                    // The caller's data stay.
                    if !only_new && are_near(&same.vertices) {
                        pairs.push(same.with_stray(stray));
                    }
                    return;
                }
                let vertices = topology.vertices_of(kind, pair);
                let about = interest.about(kind, vertices).filter(|_| are_near(&vertices));
                pairs.extend(about.map(|data| NearPair::new(kind, pair, vertices, data).with_stray(stray)));
            });
        }
    }
}

/// Visits distinct pairs in ascending order. Their first numbers are below `count`.
///
/// A counting sort orders many pairs by the first number, and then each group by the second.
fn for_each_in_order(
    pairs: &mut [SievedPair],
    count: usize,
    by_first: &mut Vec<SievedPair>,
    places: &mut Vec<u32>,
    mut visit: impl FnMut(SievedPair),
) {
    // Counting takes a time in proportion to `count`.
    if pairs.len() < count / 16 {
        pairs.sort_unstable_by_key(|left| left.pair);
        return pairs.iter().copied().for_each(visit);
    }
    places.clear();
    places.resize(count + 1, 0);
    for left in &*pairs {
        places[left.pair[0] as usize + 1] += 1;
    }
    for first in 0..count {
        places[first + 1] += places[first];
    }
    // All entries are overwritten.
    by_first.resize(pairs.len(), SievedPair::default());
    for left in &*pairs {
        let place = &mut places[left.pair[0] as usize];
        by_first[*place as usize] = *left;
        *place += 1;
    }
    let mut in_order = [SievedPair::default(); FEW];
    for same in by_first.chunk_by_mut(|a, b| a.pair[0] == b.pair[0]) {
        if same.len() > FEW {
            same.sort_unstable_by_key(|left| left.pair[1]);
            same.iter().copied().for_each(&mut visit);
            continue;
        }
        // The place of a pair is the number of smaller ones, counted side by side and without unpredictable branches.
        let mut seconds = [u32::MAX; FEW];
        seconds
            .iter_mut()
            .zip(&*same)
            .for_each(|(second, left)| *second = left.pair[1]);
        let seconds = &seconds[..same.len().next_multiple_of(8)];
        for left in &*same {
            let before: u32 = seconds.iter().map(|&second| u32::from(second < left.pair[1])).sum();
            in_order[before as usize % FEW] = *left;
        }
        in_order[..same.len()].iter().copied().for_each(&mut visit);
    }
}

/// The largest number of pairs of a group that are compared each with each; a multiple of eight. Most groups have fewer than ten.
const FEW: usize = 64;

#[cfg(test)]
mod tests {
    use super::super::interest::{CLASSES, Class};
    use super::*;
    use crate::broad_phase::Neighbours;
    use proptest::prelude::*;

    /// An interest in every pair; neighbours have a smaller distance.
    struct Told {
        neighbours: Arc<Neighbours>,
        at_once: bool,
    }

    impl Interest for Told {
        type Data = ();

        fn class(&self, kind: PairKind, vertices: [u32; 4]) -> usize {
            usize::from(!self.neighbours.are(kind, vertices))
        }

        fn neighbours(&self) -> Option<Arc<Neighbours>> {
            self.at_once.then(|| Arc::clone(&self.neighbours))
        }

        fn about(&self, _: PairKind, _: [u32; 4]) -> Option<()> {
            Some(())
        }
    }

    const CELLS: u32 = 12;

    fn vertex(row: u32, column: u32) -> u32 {
        row * (CELLS + 1) + column
    }

    /// Makes two sheets with two triangles for each cell.
    fn two_sheets() -> Arc<Topology> {
        let cells = (0..CELLS).flat_map(|row| (0..CELLS).map(move |column| [row, column]));
        let of_one = cells.flat_map(|[row, column]| {
            let [a, b] = [vertex(row, column), vertex(row, column + 1)];
            let [c, d] = [vertex(row + 1, column), vertex(row + 1, column + 1)];
            [[a, b, d], [a, d, c]]
        });
        let count = vertex(CELLS, CELLS) + 1;
        let triangles = of_one.flat_map(|triangle| [triangle, triangle.map(|vertex| vertex + count)]);
        Arc::new(Topology::new(2 * count as usize, triangles.collect()).unwrap())
    }

    /// Rolls both sheets up, with waves.
    fn rolled(radius: f64, waves: f64, phase: f64) -> Vec<DVec3> {
        let at = |place: u32| {
            let (sheet, in_sheet) = (place / (vertex(CELLS, CELLS) + 1), place % (vertex(CELLS, CELLS) + 1));
            let (along, across) = (f64::from(in_sheet / (CELLS + 1)), f64::from(in_sheet % (CELLS + 1)));
            let radius = radius + f64::from(sheet) * 1.1 + waves * (phase + 1.7 * along + 0.9 * across).sin() + 0.02 * along;
            let angle = along / radius.max(0.5);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), across)
        };
        (0..2 * (vertex(CELLS, CELLS) + 1)).map(at).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        /// Searches for all pairs, then for those of some vertices, with sheets as one part or two.
        #[test]
        fn neighbours_that_are_told_at_once_are_left_out_as_if_one_by_one(
            radius in 0.6..8.0_f64,
            waves in 0.0..0.4_f64,
            at_rest in 0.5..3.0_f64,
            distance in 0.05..0.8_f64,
            is_one in any::<bool>(),
            strayed in prop::collection::vec(prop::bool::weighted(0.1), 2 * (CELLS as usize + 1) * (CELLS as usize + 1)),
        ) {
            let topology = two_sheets();
            let count = topology.vertex_count();
            let of_sheet = count as u32 / 2;
            let ends = if is_one { vec![2 * of_sheet] } else { vec![of_sheet, 2 * of_sheet] };
            let parts = (0..).zip(ends).map(|(part, end)| (end, at_rest * (1.0 + 0.2 * f64::from(part))));
            let neighbours = Arc::new(Neighbours::new(&rolled(1e3, 0.0, 0.0), parts));
            let mut classes = [Class { distance: 1.2, margin: 0.3 }; CLASSES];
            classes[0] = Class { distance, margin: 0.0 };
            let reach = Reach { classes, beyond: 0.2, spare: 0.0, farthest: 1, upkeep: 0.0, is_graded: false };
            let start = rolled(radius, waves, 0.0);
            let end = rolled(radius * 1.05, waves, 0.5);
            let later: Vec<DVec3> = rolled(radius, waves, 1.0);
            let led_back = |old: &[DVec3], new: &[DVec3]| -> Vec<DVec3> {
                (0..count).map(|k| if strayed[k] { new[k] } else { old[k] }).collect()
            };
            let (other_start, other_end) = (led_back(&start, &end), led_back(&end, &later));
            let found = |at_once| {
                let interest = Told { neighbours: Arc::clone(&neighbours), at_once };
                let mut search = Search::new(Arc::clone(&topology), interest, vec![true; count]);
                search.set_reach(&reach).unwrap();
                let [mut all, mut of_some] = [Vec::new(), Vec::new()];
                let parts = Parts::default();
                let expected = |motion| Expected { motion, largest: 20.0, parts: &parts };
                search.pairs(&reach, &expected([&start, &end]), Known::new(&[], 0), &mut all);
                let candidates = search.broad_phase.statistics().candidates;
                let work = search.work();
                search.pairs_of(&strayed, &reach, &expected([&other_start, &other_end]), Known::new(&[], 0), &mut of_some);
                let keys = [all, of_some].map(|list| list.iter().map(NearPair::key).collect::<Vec<_>>());
                (keys, candidates, [work, search.work()])
            };
            let (one_by_one, told) = (found(false), found(true));
            prop_assert!(told.0 == one_by_one.0);
            prop_assert_eq!(told.2, one_by_one.2, "what it cost is counted as before");
            // Cells side by side are a cell apart, which is more than the distance of neighbours.
            let leaves_out = at_rest > 1.5 && radius > 2.0 && distance < 0.5;
            prop_assert!(told.1 < one_by_one.1 || !leaves_out, "{} of {}", told.1, one_by_one.1);
        }
    }

    proptest! {
        #[test]
        fn pairs_come_in_ascending_order(
            pairs in prop::collection::btree_set([0..4_u32, 0..99_u32], 0..350).prop_map(Vec::from_iter).prop_shuffle(),
            count in prop::sample::select(vec![4, 3000]),
        ) {
            let of_pair = |&pair: &[u32; 2]| SievedPair { pair, stray: pair[1] as f32 };
            let mut expected = pairs.clone();
            expected.sort_unstable();
            let expected: Vec<_> = expected.iter().map(of_pair).collect();
            let mut pairs: Vec<_> = pairs.iter().map(of_pair).collect();
            // The buffers are those of an earlier search.
            let (mut by_first, mut places) = (vec![of_pair(&[9, 9]); 150], vec![9; 50]);
            let mut visited = Vec::new();
            for_each_in_order(&mut pairs, count, &mut by_first, &mut places, |left| visited.push(left));
            prop_assert_eq!(visited, expected);
        }
    }
}
