//! Reproducible pseudo-random numbers.

/// A small and fast generator (`SplitMix64`), since most of the time should go to the tests.
pub struct Random(pub u64);

impl Random {
    pub const fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// Returns a number below `count`, which is at most 2³².
    pub const fn below(&mut self, count: u64) -> u64 {
        ((self.word() >> 32) * count) >> 32
    }

    pub fn pick<T: Copy>(&mut self, options: &[T]) -> T {
        options[self.below(options.len() as u64) as usize]
    }

    /// Returns a number from −1 to 1, in steps of 2^-`bits`, at most 52.
    pub const fn fraction(&mut self, bits: u32) -> f64 {
        (self.word().cast_signed() >> (63 - bits)) as f64 * (1.0 / (1_u64 << bits) as f64)
    }

    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        for word in bytes.chunks_mut(8) {
            word.copy_from_slice(&self.word().to_le_bytes()[..word.len()]);
        }
        bytes
    }
}
