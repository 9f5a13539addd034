//! The pairs that a traversal finds.

use selvedge_core::batch::{LANES, Mask};

/// Takes the pairs of a traversal, some thousand at a time.
pub(crate) trait Sink {
    /// Takes pairs of positions in the two trees. Returns whether to continue.
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool;
}

#[derive(Debug)]
pub(super) struct PairBuffer {
    pairs: Vec<[u32; 2]>,
    len: usize,
}

/// The number of pairs that go to the sink at a time, or a few more. They fit into a core's own cache, with all that is computed
/// from them.
pub(crate) const CHUNK: usize = 4096;

/// The set bits of each byte, lowest first, each after a zero. The numbers after them have no meaning. With the zeros, eight
/// pairs are sixteen sums side by side.
const SET_BITS: [[u8; 16]; 256] = {
    let mut table = [[0; 16]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut count, mut bit) = (0, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                table[byte][2 * count + 1] = bit as u8;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    table
};

impl PairBuffer {
    pub(super) fn new() -> Self {
        Self {
            // Two blocks give at most 256 pairs, and a write may go eight places beyond the last.
            pairs: vec![[0; 2]; CHUNK + LANES * LANES + 8],
            len: 0,
        }
    }

    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// Returns whether the sink should take the pairs.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.len >= CHUNK
    }

    pub(super) fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs[..self.len]
    }

    /// Appends `first` with each set lane of the block that begins at `second`.
    ///
    /// There is no branch on the number of set lanes, since it would be unpredictable. Eight pairs are written, of which only the
    /// first ones count.
    #[inline(always)]
    pub(super) fn push(&mut self, first: u32, second: u32, mask: Mask) {
        for (second, byte) in [(second, mask & 0xFF), (second + 8, mask >> 8)] {
            let mut numbers: [u32; 16] = std::array::from_fn(|k| if k % 2 == 0 { first } else { second });
            for (number, &lane) in numbers.iter_mut().zip(&SET_BITS[byte as usize]) {
                *number += u32::from(lane);
            }
            self.pairs[self.len..self.len + 8].copy_from_slice(numbers.as_chunks().0);
            self.len += byte.count_ones() as usize;
        }
    }
}
