//! Which pairs may come near each other on a motion: from [hierarchies of moving boxes](crate::broad_phase), through a
//! [sieve](super::sieve).

use super::known::Known;
use super::pair::NearPair;
use super::sieve::{Left, Sieve};
use super::{Interest, Reach};
use crate::PairKind;
use crate::broad_phase::MovingBroadPhase;
use crate::collision_filter::CollisionFilter;
use crate::frame::StepError;
use crate::mesh::Topology;
use crate::parallel;
use selvedge_core::glam::DVec3;
use std::sync::Arc;

/// Finds near pairs, with buffers that it keeps.
#[derive(Debug)]
pub(super) struct Search<I> {
    topology: Arc<Topology>,
    interest: I,
    /// Vertices without which a pair is of no interest.
    wanted: Vec<bool>,
    /// Whether the broad phase looks for pairs of a few vertices only.
    is_narrowed: bool,
    broad_phase: MovingBroadPhase,
    sieve: Sieve,
    vertex_face: Vec<[u32; 2]>,
    edge_edge: Vec<[u32; 2]>,
    /// Of them, what the sieve leaves.
    left: Vec<Left>,
    by_first: Vec<Left>,
    places: Vec<u32>,
}

impl<I: Interest> Search<I> {
    /// Only pairs with a vertex that is `wanted` are found, one entry for each vertex.
    pub(super) fn new(topology: Arc<Topology>, interest: I, wanted: Vec<bool>) -> Self {
        let mut broad_phase = MovingBroadPhase::new(Arc::clone(&topology));
        broad_phase.set_wanted(wanted.clone());
        Self {
            sieve: Sieve::new(topology.vertex_count()),
            topology,
            interest,
            wanted,
            is_narrowed: false,
            broad_phase,
            vertex_face: Vec::new(),
            edge_edge: Vec::new(),
            left: Vec::new(),
            by_first: Vec::new(),
            places: Vec::new(),
        }
    }

    pub(super) fn set_filter(&mut self, filter: Option<Arc<CollisionFilter>>) {
        self.broad_phase.set_filter(filter);
    }

    pub(super) const fn interest(&self) -> &I {
        &self.interest
    }

    /// Pairs that come within a distance of `reach` and what is looked for beyond it, along every direction, will be found.
    ///
    /// # Errors
    /// If it is no length. Then it stays as it was.
    pub(super) fn set_reach(&mut self, reach: &Reach) -> Result<(), StepError> {
        let largest = reach.classes.iter().map(|class| class.distance).fold(0.0, f64::max);
        self.broad_phase.set_separation(largest + reach.beyond)
    }

    /// Replaces `pairs` by those of the motion from `start` to `end`, in ascending order of their keys: not that in which the hierarchies
    /// find them, which is all that depends on the steps before. What is `known` of them is remembered.
    ///
    /// # Panics
    /// If a position is not finite.
    pub(super) fn pairs(
        &mut self,
        reach: &Reach,
        motion: [&[DVec3]; 2],
        known: Known<'_, I::Data>,
        pairs: &mut Vec<NearPair<I::Data>>,
    ) {
        if std::mem::take(&mut self.is_narrowed) {
            self.broad_phase.set_wanted(self.wanted.clone());
        }
        self.update(motion);
        self.find(reach, motion, None, known, pairs);
    }

    /// Replaces `pairs` by those with a vertex that is in `only`, the only ones whose motion is not that of the last search; those that are
    /// not `known` yet, unless all are to be found out anew how far their vertices may stray.
    ///
    /// # Panics
    /// If a position is not finite.
    pub(super) fn pairs_of(
        &mut self,
        only: &[bool],
        reach: &Reach,
        motion: [&[DVec3]; 2],
        known: Known<'_, I::Data>,
        pairs: &mut Vec<NearPair<I::Data>>,
    ) {
        self.broad_phase.narrow_to(only.to_vec());
        self.is_narrowed = true;
        self.update(motion);
        self.find(reach, motion, Some(only), known, pairs);
    }

    /// How many pairs the boxes left in the last search: about what it cost.
    pub(super) fn work(&self) -> f64 {
        (self.vertex_face.len() + self.edge_edge.len()) as f64
    }

    /// Does what the next search need not do then; a step that does not search has the time.
    pub(super) fn build_if_degraded(&mut self, [start, end]: [&[DVec3]; 2]) {
        self.broad_phase.build_if_degraded(start, end);
    }

    fn update(&mut self, [start, end]: [&[DVec3]; 2]) {
        let updated = self.broad_phase.update(start, end);
        updated.expect("the caller keeps every position finite");
    }

    fn find(
        &mut self,
        reach: &Reach,
        motion: [&[DVec3]; 2],
        only: Option<&[bool]>,
        mut known: Known<'_, I::Data>,
        pairs: &mut Vec<NearPair<I::Data>>,
    ) {
        let Self {
            topology,
            interest,
            broad_phase,
            sieve,
            vertex_face,
            edge_edge,
            left,
            by_first,
            places,
            ..
        } = self;
        broad_phase.candidates(vertex_face, edge_edge);
        sieve.set_motion(reach, motion, only);
        let counts = [topology.vertex_count(), topology.edges().len()];
        let only_new = only.is_some() && !reach.is_graded;
        pairs.clear();
        for (kind, found, count) in [
            (PairKind::VertexFace, vertex_face, counts[0]),
            (PairKind::EdgeEdge, edge_edge, counts[1]),
        ] {
            let enough = reach.beyond as f32;
            parallel::gather(left, found, |pairs, left| {
                sieve.leave(topology, interest, enough, (kind, pairs), left);
            });
            for_each_in_order(left, count, by_first, places, |Left { pair, stray }| {
                let found = match known.find((kind, pair)) {
                    Some(_) if only_new => None,
                    // What it is about is still the same.
                    Some(same) => Some(*same),
                    None => {
                        let vertices = topology.vertices_of(kind, pair);
                        let about = interest.about(kind, vertices);
                        about.map(|data| NearPair::new(kind, pair, vertices, data))
                    }
                };
                pairs.extend(found.map(|found| found.with_stray(stray)));
            });
        }
    }
}

/// Visits pairs, no two of which are alike and whose first numbers are below `count`, in ascending order: unless they are few, by counting how many
/// have which first number, then each few with the same one.
fn for_each_in_order(
    pairs: &mut [Left],
    count: usize,
    by_first: &mut Vec<Left>,
    places: &mut Vec<u32>,
    mut visit: impl FnMut(Left),
) {
    // Counting looks at all that there are to count.
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
    // All of them are written over.
    by_first.resize(pairs.len(), Left::default());
    for left in &*pairs {
        let place = &mut places[left.pair[0] as usize];
        by_first[*place as usize] = *left;
        *place += 1;
    }
    let mut in_order = [Left::default(); FEW];
    for same in by_first.chunk_by_mut(|a, b| a.pair[0] == b.pair[0]) {
        if same.len() > FEW {
            same.sort_unstable_by_key(|left| left.pair[1]);
            same.iter().copied().for_each(&mut visit);
            continue;
        }
        // By how many come before it: without a branch that nobody could foretell, and side by side.
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

/// So many, a multiple of eight, are compared each with each, which takes as long as the square of them: mostly it is fewer than ten.
/// Where cloth is jammed a step takes a sixtieth less time than with 24.
const FEW: usize = 64;

#[cfg(test)]
mod tests {
    use super::{Left, for_each_in_order};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pairs_come_in_ascending_order(
            pairs in prop::collection::btree_set([0..4_u32, 0..99_u32], 0..350).prop_map(Vec::from_iter).prop_shuffle(),
            count in prop::sample::select(vec![4, 3000]),
        ) {
            let of_pair = |&pair: &[u32; 2]| Left { pair, stray: pair[1] as f32 };
            let mut expected = pairs.clone();
            expected.sort_unstable();
            let expected: Vec<_> = expected.iter().map(of_pair).collect();
            let mut pairs: Vec<_> = pairs.iter().map(of_pair).collect();
            // Of a search before.
            let (mut by_first, mut places) = (vec![of_pair(&[9, 9]); 150], vec![9; 50]);
            let mut visited = Vec::new();
            for_each_in_order(&mut pairs, count, &mut by_first, &mut places, |left| visited.push(left));
            prop_assert_eq!(visited, expected);
        }
    }
}
