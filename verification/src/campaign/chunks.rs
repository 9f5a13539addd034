//! Sets of chunks.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A set of chunks, kept as runs. Threads take chunks in order, so there are hardly more runs than threads.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[u64; 2]>", into = "Vec<[u64; 2]>")]
pub struct Chunks {
    /// The first chunk and the one past the last of each run. Runs are in order, not empty, and have gaps between them.
    runs: Vec<[u64; 2]>,
}

impl Chunks {
    /// Returns whether the set has that chunk.
    pub fn contains(&self, chunk: u64) -> bool {
        let after = self.after(chunk);
        after > 0 && chunk < self.runs[after - 1][1]
    }

    /// Inserts a chunk. Returns `false` if the set has it already.
    pub fn insert(&mut self, chunk: u64) -> bool {
        if self.contains(chunk) {
            return false;
        }
        let after = self.after(chunk);
        let ends_here = after > 0 && self.runs[after - 1][1] == chunk;
        let begins_next = after < self.runs.len() && self.runs[after][0] == chunk + 1;
        match (ends_here, begins_next) {
            (true, true) => {
                self.runs[after - 1][1] = self.runs[after][1];
                self.runs.remove(after);
            }
            (true, false) => self.runs[after - 1][1] += 1,
            (false, true) => self.runs[after][0] -= 1,
            (false, false) => self.runs.insert(after, [chunk, chunk + 1]),
        }
        true
    }

    pub fn len(&self) -> u64 {
        self.runs.iter().map(|[first, end]| end - first).sum()
    }

    pub const fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Returns the first chunk and the one past the last of each run, in order.
    pub fn runs(&self) -> &[[u64; 2]] {
        &self.runs
    }

    /// Returns the first run that begins after that chunk.
    fn after(&self, chunk: u64) -> usize {
        self.runs.partition_point(|&[first, _]| first <= chunk)
    }
}

impl From<Range<u64>> for Chunks {
    fn from(range: Range<u64>) -> Self {
        let run = Some([range.start, range.end]).filter(|_| !range.is_empty());
        Self {
            runs: run.into_iter().collect(),
        }
    }
}

impl From<Chunks> for Vec<[u64; 2]> {
    fn from(chunks: Chunks) -> Self {
        chunks.runs
    }
}

impl TryFrom<Vec<[u64; 2]>> for Chunks {
    type Error = &'static str;

    fn try_from(runs: Vec<[u64; 2]>) -> Result<Self, Self::Error> {
        let none_is_empty = runs.iter().all(|[first, end]| first < end);
        if none_is_empty && runs.windows(2).all(|two| two[0][1] < two[1][0]) {
            Ok(Self { runs })
        } else {
            Err("runs of chunks that are empty, out of order or not apart")
        }
    }
}
