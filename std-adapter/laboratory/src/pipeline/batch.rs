//! Runs the stages after the broad phase on one batch of candidate triangle pairs that stays in the cache.

use super::assignment::FeatureAssignment;
use super::pairs::MovingMesh;
use super::stored::StoredDops;
use crate::methods::{CullingTest, Stages, WithLanes, WithTest};
use arrayvec::ArrayVec;
use rustc_hash::FxHashSet;
use selvedge::Contact;
use selvedge::PairCounts;
use selvedge::PairKind;
use selvedge::clock::Clock;
use selvedge_core::batch::{BatchTest, LANES, Level, Mask, culled_from_rows};
use selvedge_core::distribution::distribute;
use selvedge_core::{PrimitivePair, Scalar};

/// The input that all batches of a step share.
#[derive(Clone, Copy)]
pub(super) struct StepInput<'a, S: Scalar> {
    pub(super) level: Level,
    pub(super) mesh: MovingMesh<'a, S>,
    pub(super) dops: &'a StoredDops<S>,
    pub(super) stages: Stages,
}

/// The survivors and seconds of one stage.
pub(super) type StageCounts = (PairCounts, f64);

/// The primitive pairs distributed so far in this step, for [`Redundancy::HashSets`](crate::methods::Redundancy::HashSets).
#[derive(Debug, Default)]
pub(super) struct Distributed {
    pub(super) vertex_face: FxHashSet<[u32; 2]>,
    pub(super) edge_edge: FxHashSet<[u32; 2]>,
}

/// The primitive pairs on their way through the stages. Each stage drops pairs in place and keeps their order.
#[derive(Clone, Debug)]
pub(super) struct Batch<S> {
    pub(super) vertex_face: Vec<[u32; 2]>,
    pub(super) edge_edge: Vec<[u32; 2]>,
    pub(super) contacts: Vec<Contact<S>>,
    /// The vertices of each pair, and the masks that a batched test returns for them.
    indices: Vec<[u32; 4]>,
    masks: Vec<Mask>,
    /// The counts of distribution, of each culling test, and of the elementary test.
    pub(super) tallies: ArrayVec<StageCounts, 8>,
}

impl<S: Scalar> Batch<S> {
    /// Makes room for the primitive pairs of this many candidate triangle pairs, so that no step has to grow it.
    pub(super) fn with_capacity(triangle_pairs: usize) -> Self {
        Self {
            vertex_face: Vec::with_capacity(6 * triangle_pairs),
            edge_edge: Vec::with_capacity(9 * triangle_pairs),
            contacts: Vec::with_capacity(15 * triangle_pairs),
            indices: Vec::with_capacity(9 * triangle_pairs),
            masks: Vec::with_capacity((9 * triangle_pairs).div_ceil(LANES)),
            tallies: ArrayVec::new(),
        }
    }

    pub(super) fn counts(&self) -> PairCounts {
        PairCounts {
            vertex_face: self.vertex_face.len() as u64,
            edge_edge: self.edge_edge.len() as u64,
        }
    }

    /// Replaces the batch by the primitive pairs of `triangle_pairs`.
    pub(super) fn distribute(&mut self, triangle_pairs: &[[u32; 2]], assignment: &FeatureAssignment) {
        let begin = Clock::now();
        self.vertex_face.clear();
        self.edge_edge.clear();
        self.contacts.clear();
        self.tallies.clear();
        let triangles = assignment.triangles();
        for &[a, b] in triangle_pairs {
            let pairs = distribute(&triangles[a as usize], &triangles[b as usize]);
            self.vertex_face.extend_from_slice(&pairs.vertex_face);
            self.edge_edge.extend_from_slice(&pairs.edge_edge);
        }
        self.tallies.push((self.counts(), begin.elapsed().as_secs_f64()));
    }

    /// Drops the pairs that were distributed before, and records the others. It counts as part of distribution.
    pub(super) fn keep_new(&mut self, distributed: &mut Distributed) {
        let begin = Clock::now();
        keep_where(&mut self.vertex_face, |pair| distributed.vertex_face.insert(pair));
        keep_where(&mut self.edge_edge, |[a, b]| {
            distributed.edge_edge.insert([a.min(b), a.max(b)])
        });
        let counts = self.counts();
        if let Some((survivors, seconds)) = self.tallies.first_mut() {
            *survivors = counts;
            *seconds += begin.elapsed().as_secs_f64();
        }
    }

    /// Runs the culling tests in order.
    pub(super) fn cull(&mut self, step: &StepInput<'_, S>) {
        for &test in step.stages.tests {
            let begin = Clock::now();
            self.cull_by(test, step);
            self.tallies.push((self.counts(), begin.elapsed().as_secs_f64()));
        }
    }

    fn cull_by(&mut self, test: CullingTest, step: &StepInput<'_, S>) {
        match test {
            CullingTest::StoredDop18 => self.keep_overlapping(step.dops),
            _ => test.run_lanes(AtWork { batch: self, step }),
        }
    }

    /// Drops the pairs that `test` culls, sixteen at a time.
    fn drop_culled_by_lanes(&mut self, step: &StepInput<'_, S>, test: impl BatchTest<S>) {
        for kind in PairKind::ALL {
            let pairs = match kind {
                PairKind::VertexFace => &mut self.vertex_face,
                PairKind::EdgeEdge => &mut self.edge_edge,
            };
            let topology = step.mesh.topology;
            self.indices.clear();
            self.indices
                .extend(pairs.iter().map(|&pair| topology.vertices_of(kind, pair)));
            self.masks.clear();
            self.masks.resize(pairs.len().div_ceil(LANES), 0);
            let rows = step.mesh.rows;
            culled_from_rows(step.level, kind, test, rows, &self.indices, &mut self.masks);

            let masks = &self.masks;
            let mut index = 0;
            keep_where(pairs, |_| {
                let culled = masks[index / LANES] >> (index % LANES) & 1;
                index += 1;
                culled == 0
            });
        }
    }

    /// Drops the pairs whose stored volumes do not overlap.
    fn keep_overlapping(&mut self, stored: &StoredDops<S>) {
        keep_where(&mut self.vertex_face, |pair| stored.vertex_face_overlap(pair));
        keep_where(&mut self.edge_edge, |pair| stored.edge_edge_overlap(pair));
    }

    /// Runs the elementary test on the remaining pairs and fills `contacts`, vertex–face first.
    pub(super) fn find_contacts(&mut self, step: &StepInput<'_, S>) {
        step.stages.elementary.run(AtWork { batch: self, step });
    }
}

/// A stage on a batch.
struct AtWork<'a, S: Scalar> {
    batch: &'a mut Batch<S>,
    step: &'a StepInput<'a, S>,
}

impl<S: Scalar> WithLanes<S> for AtWork<'_, S> {
    fn with(self, test: impl BatchTest<S>) {
        self.batch.drop_culled_by_lanes(self.step, test);
    }
}

impl<S: Scalar> WithTest<S, Option<S>> for AtWork<'_, S> {
    type Outcome = ();

    fn with(self, time: impl Fn(&PrimitivePair<S>) -> Option<S>) {
        let Self { batch, step } = self;
        let begin = Clock::now();
        let mut found = [0; 2];
        let lists = [
            (PairKind::VertexFace, &batch.vertex_face),
            (PairKind::EdgeEdge, &batch.edge_edge),
        ];
        for ((kind, pairs), found) in lists.into_iter().zip(&mut found) {
            let before = batch.contacts.len();
            batch.contacts.extend(pairs.iter().filter_map(|&pair| {
                let time = time(&step.mesh.pair(kind, pair))?;
                Some(Contact { kind, pair, time })
            }));
            *found = (batch.contacts.len() - before) as u64;
        }
        let [vertex_face, edge_edge] = found;
        let found = PairCounts { vertex_face, edge_edge };
        batch.tallies.push((found, begin.elapsed().as_secs_f64()));
    }
}

/// Retains items like `Vec::retain`, without a branch on the outcome, which is hard to predict.
fn keep_where(pairs: &mut Vec<[u32; 2]>, mut keep: impl FnMut([u32; 2]) -> bool) {
    let mut kept = 0;
    for read in 0..pairs.len() {
        let pair = pairs[read];
        pairs[kept] = pair;
        kept += usize::from(keep(pair));
    }
    pairs.truncate(kept);
}
