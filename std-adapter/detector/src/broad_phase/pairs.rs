//! Where a traversal puts the pairs it finds.

use selvedge_core::batch::{LANES, Mask};

/// Takes what a traversal finds, some thousand pairs at a time.
pub(crate) trait Sink {
    /// Pairs of positions in the two trees. Returns whether to go on.
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool;
}

/// Pairs that a sink has not taken yet.
#[derive(Debug)]
pub(super) struct PairBuffer {
    pairs: Vec<[u32; 2]>,
    len: usize,
}

/// So many pairs go to the sink at once, or a few more: what fits in a core's own cache with all that is made of them.
pub(crate) const CHUNK: usize = 4096;

/// The set bits of each byte, lowest first; what follows them does not matter.
const SET_BITS: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut count, mut bit) = (0, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                table[byte][count] = bit as u8;
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
            // Two blocks give at most 256 pairs, and writing goes eight places beyond the last.
            pairs: vec![[0; 2]; CHUNK + LANES * LANES + 8],
            len: 0,
        }
    }

    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// Whether the sink should be given what there is.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.len >= CHUNK
    }

    pub(super) fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs[..self.len]
    }

    /// Appends `first` with each set lane of the block that begins at `second`. Without a branch on how many there are, which
    /// is hard to predict: eight pairs are written, of which those count that are set.
    #[inline(always)]
    pub(super) fn push(&mut self, first: u32, second: u32, mask: Mask) {
        if cfg!(debug_assertions) {
            // Who has these optimises nothing, as a rule: then a branch is cheap beside what it is about.
            return self.push_each(first, second, mask);
        }
        for (second, byte) in [(second, mask & 0xFF), (second + 8, mask >> 8)] {
            let places = &mut self.pairs[self.len..self.len + 8];
            let lanes = &SET_BITS[byte as usize];
            for (place, &lane) in places.iter_mut().zip(lanes) {
                *place = [first, second + u32::from(lane)];
            }
            self.len += byte.count_ones() as usize;
        }
    }

    /// The same, writing only those that are set.
    fn push_each(&mut self, first: u32, second: u32, mask: Mask) {
        let mut half = 0;
        while half < 16 {
            let (second, byte) = (second + half, mask >> half & 0xFF);
            half += 8;
            if byte == 0 {
                continue;
            }
            let count = byte.count_ones() as usize;
            let places = &mut self.pairs[self.len..self.len + count];
            let lanes = &SET_BITS[byte as usize];
            let mut k = 0;
            while k < count {
                places[k] = [first, second + lanes[k] as u32];
                k += 1;
            }
            self.len += count;
        }
    }
}
