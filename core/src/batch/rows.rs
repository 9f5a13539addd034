use super::mask::{LANES, Mask};
use crate::motion::Motion;
use crate::scalar::Scalar;

/// A vertex's start and end in one row, `x₀ y₀ z₀ 0 x₁ y₁ z₁ 0`: one or two loads fetch all of it.
///
/// A mesh has one row for each vertex, in the order of its vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct VertexRow<S>(pub(super) [S; 8]);

impl<S: Scalar> VertexRow<S> {
    /// Makes a row for a moving vertex.
    #[inline(always)]
    pub fn new(motion: Motion<S>) -> Self {
        let ([x, y, z], [u, v, w]) = (motion.start.into(), motion.end.into());
        Self([x, y, z, S::ZERO, u, v, w, S::ZERO])
    }

    /// Returns the moving vertex of the row.
    #[inline(always)]
    #[must_use]
    pub fn motion(&self) -> Motion<S> {
        let [x, y, z, _, u, v, w, _] = self.0;
        Motion::new(S::Vector::from([x, y, z]), S::Vector::from([u, v, w]))
    }
}

/// Fewer than sixteen pairs, or some with indices out of range. A known pair fills the other lanes.
pub(super) struct Padded {
    pub(super) indices: [[u32; 4]; LANES],
    /// The lanes of pairs that are known.
    pub(super) known: Mask,
}

impl Padded {
    /// Pads `indices` of `rows` rows. Returns `None` if no pair is known.
    #[cold]
    pub(super) fn new(indices: &[[u32; 4]], rows: usize) -> Option<Self> {
        let is_known = |pair: &&[u32; 4]| pair.iter().all(|&index| (index as usize) < rows);
        let mut padded = Self {
            indices: [*indices.iter().find(is_known)?; LANES],
            known: 0,
        };
        for (lane, (own, pair)) in padded.indices.iter_mut().zip(indices).enumerate() {
            if is_known(&pair) {
                *own = *pair;
                padded.known |= 1 << lane;
            }
        }
        Some(padded)
    }
}
