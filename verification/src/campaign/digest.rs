//! A digest of a run's findings, in sixteen bytes.

use serde::{Deserialize, Serialize};
use sha2::digest::consts::U16;
use sha2::{Digest as _, Sha256};
use std::fmt;
use std::ops::AddAssign;

/// A digest of the findings of some chunks. It depends neither on the order of the chunks nor on the machines that ran them.
///
/// # Why
/// It is Σ h(chunk, findings) modulo 2¹²⁸, where h is the first half of SHA-256 of both as JSON. This addition is commutative and
/// associative. So any order, any division into shards and any sequence of kills adds the same terms, provided that each chunk is
/// added once. [`Progress`](super::Progress) ensures that, since it keeps chunk, findings and digest in one state. A chunk that
/// is missing, doubled or has other findings changes the sum, except by a chance of one in 2¹²⁸. (The construction is `AdHASH`,
/// Bellare and Micciancio 1997. 128 bits would be too few against an adversary, which is not a concern here.)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Digest(u128);

impl Digest {
    /// Returns the digest of one chunk.
    ///
    /// # Panics
    /// Panics if the findings cannot be written as JSON.
    pub fn of_chunk(chunk: u64, found: &impl Serialize) -> Self {
        let bytes = serde_json::to_vec(&(chunk, found)).expect("findings are numbers, words and lists");
        Self::of_bytes([bytes])
    }

    /// Returns the digest of bytes, one piece after the other.
    pub fn of_bytes(pieces: impl IntoIterator<Item = impl AsRef<[u8]>>) -> Self {
        let mut hash = Sha256::new();
        for piece in pieces {
            hash.update(piece);
        }
        let (first, _) = hash.finalize().split::<U16>();
        Self(u128::from_be_bytes(first.into()))
    }
}

impl AddAssign for Digest {
    fn add_assign(&mut self, other: Self) {
        self.0 = self.0.wrapping_add(other.0);
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl From<Digest> for String {
    fn from(digest: Digest) -> Self {
        digest.to_string()
    }
}

impl TryFrom<String> for Digest {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let digits = text.len() == 32 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let number = u128::from_str_radix(&text, 16).ok().filter(|_| digits);
        number.map(Self).ok_or("a digest has 32 hexadecimal digits")
    }
}
