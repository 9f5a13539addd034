//! Counts of the broad phase.

/// Counts of a [`MovingBroadPhase`](super::MovingBroadPhase). They do not depend on the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MovingStatistics {
    /// The number of times that the hierarchies were built, including the first.
    pub builds: usize,
    /// The number of tests in the last traversal, each of one box against sixteen.
    pub box_tests: u64,
    /// The number of candidates of the last traversal.
    pub candidates: usize,
}
