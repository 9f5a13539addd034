//! Motion that goes on from step to step: pairs that are near each other are found for several steps at once, and followed.
//!
//! ```text
//! now and then   hierarchies of moving boxes ─▶ sieve ─▶ the list of near pairs, good for some steps of the motion expected
//! every step     which vertices have strayed from it? those of few: their pairs found again; of many: all anew
//!                each pair: have its vertices strayed far enough? does the remembered direction last? another one?
//! what is left   open pairs
//! ```
//!
//! | module | what it does |
//! |---|---|
//! | `search` | near pairs: hierarchies of moving boxes, then the sieve |
//! | `sieve` | pairs that keep apart until the next search |
//! | `ahead`, `horizon`, `near` | how many steps to look ahead, for how many the pairs are good, and the list of them |
//! | `known` | what is known of pairs that are found again |
//! | `pair` | one pair, and the direction that keeps it apart |
//! | `follow` | all of it for the steps of a [`CollisionDetector`](crate::CollisionDetector) |
//!
//! Nothing here decides by a bound of its own: directions, clearances and courses, with their derivations, are
//! [core's](selvedge_core::separation).

mod ahead;
mod follow;
mod horizon;
mod known;
mod near;
mod pair;
mod search;
mod sieve;

pub(crate) use follow::{ENORMOUS, Followed};
pub use near::{NearPairs, NearStatistics};
pub use pair::NearPair;

use crate::PairKind;
use crate::broad_phase::Neighbours;
use std::sync::Arc;

/// Which pairs a caller has an interest in.
pub trait Interest: Sync {
    /// What it keeps with a pair while that is near.
    type Data: Copy + Send + Sync;

    /// Which of the [classes](Reach::classes) is the pair's, below [`CLASSES`]. Asked of every pair that boxes leave.
    fn class(&self, kind: PairKind, vertices: [u32; 4]) -> usize;

    /// Pairs of the first class that hierarchies of boxes tell many at a time, if there are any: asked once.
    fn neighbours(&self) -> Option<Arc<Neighbours>> {
        None
    }

    /// What is to be kept with the pair at first; `None` if it is of no interest. Always the same but for what the caller writes there.
    fn about(&self, kind: PairKind, vertices: [u32; 4]) -> Option<Self::Data>;
}

/// How many classes of pairs there can be.
pub const CLASSES: usize = 3;

/// How near pairs of one class are.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// Those that come within this are near.
    pub distance: f64,
    /// So much of the distance more is asked for along directions that are no axes: no part of any proof.
    pub margin: f32,
}

/// Which pairs are near, and for how long: lengths in the unit of the positions.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Pairs of each class that come within its distance, and
    pub classes: [Class; CLASSES],
    /// this beyond it: twice as far as each vertex may stray along an axis. More makes longer lists that last longer.
    pub beyond: f64,
    /// How much less than its distance has to be kept of any pair.
    pub spare: f64,
    /// Steps to look ahead, at most.
    pub farthest: u32,
    /// What a pair of the list costs in a step, in units of what finding one costs.
    pub upkeep: f64,
    /// Whether to find out of each pair how far its vertices may stray before it needs attention.
    pub is_graded: bool,
}

/// All pairs, of one class.
#[cfg(test)]
struct OfClass(usize);

#[cfg(test)]
impl Interest for OfClass {
    type Data = ();

    fn class(&self, _: PairKind, _: [u32; 4]) -> usize {
        self.0
    }

    fn about(&self, _: PairKind, _: [u32; 4]) -> Option<()> {
        Some(())
    }
}
