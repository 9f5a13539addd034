//! The parts of a run.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// One part of a run, counted from 1: of four parts, `1/4` is the first and `4/4` the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    of: u64,
}

impl Shard {
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Returns the shard's range of `chunks` chunks. Each chunk is in one of the shards, and their sizes differ by at most one.
    /// If there are more shards than chunks, some are empty.
    pub fn range(self, chunks: u64) -> Range<u64> {
        // This is at most `chunks`, since `before` is at most `of`.
        let begin = |before: u64| (u128::from(before) * u128::from(chunks) / u128::from(self.of)) as u64;
        begin(self.number - 1)..begin(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text
            .split_once('/')
            .and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((number, of)) if 1 <= number && number <= of => Ok(Self { number, of }),
            _ => Err("a shard is I/N, I from 1 to N, as 1/4, 2/4, 3/4 and 4/4"),
        }
    }
}
