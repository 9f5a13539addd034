//! Counts of the broad phase.

/// Counts of a [`MovingBroadPhase`](super::MovingBroadPhase). They do not depend on the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MovingStatistics {
    /// Builds of the hierarchies, including the first one.
    pub builds: usize,
    /// Tests of the last traversal, each of one box against sixteen.
    pub box_tests: u64,
    /// Candidates of the last traversal.
    pub candidates: usize,
}
