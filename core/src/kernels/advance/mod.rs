//! The proofs of the certified [time of impact](crate::elementary::advance) and their tools, for the corners of a pair alone.

pub mod closest;
pub mod confirm;
pub mod corners;
pub mod directions;
pub mod round;
pub(crate) mod turning;
pub mod volume;

/// The work of one answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// The rounds of advancing: at most [`ROUNDS`](crate::elementary::advance::ROUNDS), or
    /// [`ROUNDS_WITH_SEPARATION`](crate::elementary::advance::ROUNDS_WITH_SEPARATION). It is zero if relative boxes or the volume
    /// decide.
    pub rounds: u32,
    /// The steps of clipping the signed volume: at most 1 before the first round, and 8 in each.
    pub volume_steps: u32,
    /// The attempts with a turning direction: at most [`TURNS`](crate::elementary::advance::TURNS) in each round.
    pub turns: u32,
}
