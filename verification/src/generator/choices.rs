//! Decisions read from bytes.

/// A stream of decisions. Every question has an answer, even with few bytes. When they are used up, each answer is the first one,
/// which by convention is the simplest.
#[derive(Clone, Copy, Debug)]
pub struct Choices<'a> {
    rest: &'a [u8],
}

impl<'a> Choices<'a> {
    /// About the number of bytes that the longest case needs.
    pub const ENOUGH: usize = 640;

    /// Makes decisions from `bytes`, in order.
    pub const fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    pub fn byte(&mut self) -> u8 {
        match self.rest.split_first() {
            Some((&first, rest)) => {
                self.rest = rest;
                first
            }
            None => 0,
        }
    }

    pub fn word(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// Returns a number below `count`, from one byte.
    ///
    /// # Panics
    /// Panics if `count` is 0 or above 256.
    pub fn below(&mut self, count: u32) -> u32 {
        assert!((1..=256).contains(&count), "one byte decides");
        u32::from(self.byte()) % count
    }

    /// Returns an integer from `-limit` to `limit`, from one byte: 0, 1, −1, 2, −2 and so on.
    ///
    /// # Panics
    /// Panics if `limit` is above 127.
    pub fn within(&mut self, limit: u32) -> i64 {
        let index = i64::from(self.below(2 * limit + 1));
        if index % 2 == 0 { -index / 2 } else { (index + 1) / 2 }
    }

    /// Returns true once in `odds` times.
    pub fn once_in(&mut self, odds: u32) -> bool {
        self.below(odds) == odds - 1
    }

    /// Returns one of `options`.
    ///
    /// # Panics
    /// Panics if there are no options, or more than 256.
    pub fn pick<T: Copy>(&mut self, options: &[T]) -> T {
        let count = u32::try_from(options.len()).expect("at most 256 options");
        options[self.below(count) as usize]
    }
}
