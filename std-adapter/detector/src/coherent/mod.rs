//! Coherent motion: finds near pairs for several steps at once and follows them from step to step.
//!
//! A [`CollisionDetector`](crate::CollisionDetector::set_coherent) does this by itself. Use [`NearPairs`] directly in a solver that handles contact on
//! its own: the solver decides which pairs are of [interest](Interest), keeps data with each, and holds pairs apart by remembered directions.
//!
//! ```text
//! now and then   hierarchies of moving boxes ─▶ sieve ─▶ the list of near pairs, good for some steps of the expected motion
//! every step     few vertices stray from it: find their pairs again; many stray: find all pairs again
//!                each pair: do its vertices stray far enough? does the remembered direction hold? does another one?
//! remaining      open pairs
//! ```
//!
//! ```
//! use selvedge::coherent::{CLASSES, Class, Interest, NearPairs, Reach};
//! use selvedge::core::separation::gap::GapError;
//! use selvedge::{PairKind, Topology, glam::DVec3};
//! use std::sync::Arc;
//!
//! /// Takes all pairs, and counts for each the steps in which it is held apart.
//! struct All;
//!
//! impl Interest for All {
//!     type Data = u32;
//!
//!     fn class(&self, _: PairKind, _: [u32; 4]) -> usize {
//!         0
//!     }
//!
//!     fn about(&self, _: PairKind, _: [u32; 4]) -> Option<u32> {
//!         Some(0)
//!     }
//! }
//!
//! // A triangle slides above another one.
//! let frame = |step: u32| {
//!     let by = f64::from(step) * DVec3::X * 0.01;
//!     let above = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + DVec3::Z * 0.1 + by);
//!     [[DVec3::ZERO, DVec3::X, DVec3::Y], above].concat()
//! };
//! let topology = Arc::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
//! let reach = Reach {
//!     classes: [Class { distance: 0.15, margin: 0.0 }; CLASSES],
//!     beyond: 0.02,
//!     spare: 0.0,
//!     farthest: 8,
//!     upkeep: 0.1,
//!     is_graded: false,
//! };
//! let mut near = NearPairs::new(topology, All, vec![true; 6], reach)?;
//! let error = GapError::from_largest_coordinate(2.0);
//! for step in 0..20 {
//!     let (start, end) = (frame(step), frame(step + 1));
//!     // The list now holds every pair that comes within the distance.
//!     near.cover(&start, &end, 1.0);
//!     for pair in &mut near.list {
//!         assert!(pair.keeps_apart([&start, &end], 0.05, error));
//!         pair.data += 1;
//!     }
//!     near.advance(1.0);
//! }
//! assert!(near.statistics().searches < 20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | source file | contents |
//! |---|---|
//! | `search` | finds near pairs: hierarchies of moving boxes, then the sieve |
//! | `sieve` | drops pairs that keep apart until the next search |
//! | `ahead`, `horizon`, `near` | the number of steps to look ahead, the steps for which pairs are good, and their list |
//! | `known` | looks up pairs that are found again |
//! | `pair` | one pair, and the direction that keeps it apart |
//! | `follow` | the near pairs of a [`CollisionDetector`](crate::CollisionDetector) |
//!
//! All certificates are [core's](selvedge_core::separation): directions, clearances and courses, with their derivations.

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

/// Selects the pairs that a caller has an interest in.
pub trait Interest: Sync {
    /// The data that the caller keeps with each near pair.
    type Data: Copy + Send + Sync;

    /// Returns the number of the pair's [class](Reach::classes), below [`CLASSES`]. It is called for every pair that boxes leave.
    fn class(&self, kind: PairKind, vertices: [u32; 4]) -> usize;

    /// Returns the pairs of the first class that hierarchies can leave out many at a time, if there are any. It is called once.
    fn neighbours(&self) -> Option<Arc<Neighbours>> {
        None
    }

    /// Returns the first data of a pair, or `None` if the pair is of no interest. It must always return the same for the same pair.
    fn about(&self, kind: PairKind, vertices: [u32; 4]) -> Option<Self::Data>;
}

/// The number of classes of pairs.
pub const CLASSES: usize = 3;

/// The distance of near pairs of one class.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// Pairs that come within this distance are near.
    pub distance: f64,
    /// The share of the distance by which directions other than the axes must keep a pair farther apart for the sieve to drop it. It is no part of a
    /// proof.
    pub margin: f32,
}

/// Defines which pairs are near, and for how long. Lengths are in the unit of the positions.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// The distance of each class.
    pub classes: [Class; CLASSES],
    /// A length beyond the distance within which pairs are looked for. It is twice the length by which each vertex may stray along an axis. A larger
    /// value gives longer lists that last longer.
    pub beyond: f64,
    /// The length by which every pair may come closer than its distance.
    pub spare: f64,
    /// The most steps to look ahead.
    pub farthest: u32,
    /// The cost of a listed pair in a step, in units of the cost of finding a pair.
    pub upkeep: f64,
    /// Whether each pair gets the length by which its vertices may stray before it needs attention.
    pub is_graded: bool,
}

/// Takes all pairs, of one class.
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
