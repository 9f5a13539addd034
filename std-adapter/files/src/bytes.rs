//! A digest of bytes.

use fnv::FnvHasher;
use std::hash::Hasher;

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
