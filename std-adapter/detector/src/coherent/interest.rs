//! The pairs that a caller has an interest in, and how near they are.

use crate::broad_phase::Neighbours;
use selvedge_core::PairKind;
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

    /// Returns the first data of a pair, or `None` if the pair is of no interest. It must always return the same for the same
    /// pair.
    fn about(&self, kind: PairKind, vertices: [u32; 4]) -> Option<Self::Data>;
}

/// The number of classes of pairs.
pub const CLASSES: usize = 3;

/// The distance of near pairs in one class.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// The distance within which pairs are near.
    pub distance: f64,
    /// The share of the distance by which directions other than the axes must keep a pair farther apart for the sieve to drop it.
    /// Proofs do not use it.
    pub margin: f32,
}

/// Defines which pairs are near, and for how long. Lengths are in the unit of the positions.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// The distance of each class.
    pub classes: [Class; CLASSES],
    /// A length beyond the distance within which pairs are looked for. It is twice the length by which each vertex may stray
    /// along an axis. A larger value gives longer lists that last longer.
    pub beyond: f64,
    /// The length by which every pair may come closer than its distance.
    pub spare: f64,
    /// The largest number of steps to look ahead.
    pub farthest: u32,
    /// The cost of a listed pair in a step, in units of the cost of finding a pair.
    pub upkeep: f64,
    /// True if each pair gets the length by which its vertices may stray before it needs attention.
    pub is_graded: bool,
}

/// An interest in all pairs, of one class.
#[cfg(test)]
pub(super) struct OfClass(pub(super) usize);

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
