//! Parts of a step: for the project's laboratory, its verification and the crates beside this one, and for nobody else. **Nothing is
//! promised of what stands here**; it changes as the inside of the detector does.
//!
//! A [`CollisionDetector`](crate::CollisionDetector) then also tells what it counted ([`tally`](crate::CollisionDetector::tally)) and
//! takes an instruction set ([`set_level`](crate::CollisionDetector::set_level)).

pub use crate::broad_phase::{Centre, Degradation, LEAF, MovingBroadPhase, MovingStatistics, Neighbours, Prices, order};
pub use crate::buffer::{add_kept, with_headroom};
pub use crate::coherent::{CLASSES, Class, Interest, NearPair, NearPairs, NearStatistics, Reach};
pub use crate::dispatch::{Level, available_levels, best_level};
pub use crate::frame::{check_frames, check_length};
pub use crate::pair_counts::PairCounts;
pub use crate::step::StepTally;

/// Loops that are split between threads.
pub mod parallel {
    pub use crate::parallel::*;
}
