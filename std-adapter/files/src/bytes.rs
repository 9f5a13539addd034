//! Numbers as bytes and back: every number in full, least significant byte first.

use fnv::FnvHasher;
use std::hash::Hasher;

/// Takes numbers off the front of bytes, and returns `None` if there are too few.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a>(pub &'a [u8]);

impl<'a> Reader<'a> {
    pub fn bytes(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (&taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(taken)
    }

    pub fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    pub fn f64(&mut self) -> Option<f64> {
        self.array().map(f64::from_le_bytes)
    }

    pub fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.f64()?;
        }
        Some(numbers)
    }

    pub fn f32(&mut self) -> Option<f32> {
        self.array().map(f32::from_le_bytes)
    }

    /// Reads the number of items that follow, each of at least `size` bytes. Returns `None` if there is no room for so many, so
    /// that damaged bytes reserve no memory.
    pub fn count(&mut self, size: usize) -> Option<usize> {
        let count = usize::try_from(self.u64()?).ok()?;
        (count.checked_mul(size)? <= self.0.len()).then_some(count)
    }

    /// Returns the bytes of a [`block`](put_block).
    pub fn block(&mut self) -> Option<&'a [u8]> {
        let count = self.count(1)?;
        self.bytes(count)
    }
}

/// Appends bytes after their number.
pub fn put_block(bytes: &mut Vec<u8>, block: &[u8]) {
    bytes.extend((block.len() as u64).to_le_bytes());
    bytes.extend_from_slice(block);
}

/// A digest of bytes: FNV-1a, the same in every version of every compiler.
#[derive(Default)]
pub struct Fingerprint(FnvHasher);

impl Fingerprint {
    pub fn take(&mut self, bytes: &[u8]) {
        self.0.write(bytes);
    }

    #[must_use]
    pub fn value(&self) -> u64 {
        self.0.finish()
    }
}
