//! The contacts and counts of one share of the work.

use crate::pair_counts::PairCounts;
use crate::step::Contact;
use selvedge_core::PairKind;
use std::cmp::Ordering;
use std::time::Duration;

/// Counts and times of the stages after the broad phase.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StageCounts {
    pub(super) candidates: PairCounts,
    pub(super) filtered: PairCounts,
    pub(super) contacts: PairCounts,
    pub(super) filter_time: Duration,
    pub(super) elementary_time: Duration,
}

/// The contacts and counts of one share.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub(super) contacts: Vec<Contact<f64>>,
    /// The first contact of the present source.
    pub(super) first: usize,
    /// The pairs that the filter keeps, as the mesh numbers them, if the caller wants them: VF, EE.
    pub(super) kept: [Vec<[u32; 2]>; 2],
    pub(super) counts: StageCounts,
}

impl Findings {
    /// Forgets the last step, but keeps the memory.
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.first = 0;
        self.kept.iter_mut().for_each(Vec::clear);
        self.counts = StageCounts::default();
    }

    /// Keeps only the earliest contact of the present source.
    pub(super) fn keep_earliest(&mut self) {
        let earliest = self.contacts[self.first..].iter().copied().min_by(by_time_and_pair);
        self.contacts.truncate(self.first);
        self.contacts.extend(earliest);
    }
}

/// Orders contacts of one mesh by time, kind and pair.
pub(super) fn by_time_and_pair(a: &Contact<f64>, b: &Contact<f64>) -> Ordering {
    let by_time = a.time.partial_cmp(&b.time).unwrap_or(Ordering::Equal);
    by_time.then((a.kind, a.pair).cmp(&(b.kind, b.pair)))
}

pub(super) fn count_of(counts: &mut PairCounts, kind: PairKind) -> &mut u64 {
    match kind {
        PairKind::VertexFace => &mut counts.vertex_face,
        PairKind::EdgeEdge => &mut counts.edge_edge,
    }
}
