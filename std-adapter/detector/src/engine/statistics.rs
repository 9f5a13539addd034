//! Counts and times of a step.

use crate::pair_counts::PairCounts;

/// Counts of the pairs after each stage of a step, and times in seconds.
///
/// The times of stages are sums over all threads. They are zero without the feature `timing`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepStatistics {
    /// The pairs that the caller listed.
    pub given: PairCounts,
    /// The pairs that moving boxes leave, listed ones included.
    pub candidates: PairCounts,
    /// The pairs that may become coplanar.
    pub filtered: PairCounts,
    /// The pairs that the elementary test finds in contact.
    pub contacts: PairCounts,
    /// The pairs that are followed from step to step, if steps are [coherent](crate::CollisionDetector::set_coherent).
    pub followed: u64,
    /// The time of boxes, hierarchies and traversal.
    pub broad_phase_seconds: f64,
    /// The time of the certified non-coplanarity filter.
    pub filter_seconds: f64,
    /// The time of the elementary test.
    pub elementary_seconds: f64,
    /// The elapsed time of the whole step.
    pub seconds: f64,
}
