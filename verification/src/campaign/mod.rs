//! Long runs over many pairs, in chunks, each with random numbers of its own: what a run finds depends on neither threads nor
//! interruptions.
//!
//! | module | what it is |
//! |---|---|
//! | [`exact`] | a billion pairs, every cull and every "never" checked by exact arithmetic |
//! | [`false_culls`] | every tier of the filter over random and adversarial pairs |

pub mod exact;
pub mod false_culls;

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::sync::Mutex;

/// What a run looks for.
pub trait Findings: Send {
    /// What is found in one chunk.
    type OfChunk: Send;

    /// Adds what was found in a chunk. In whichever order chunks come, the sum is the same.
    fn add(&mut self, chunk: u64, found: Self::OfChunk);

    /// How many promises were found broken.
    fn wrong(&self) -> u64;

    /// Whether a run with the findings of `other` looks for the same, in the same pairs if its seed is the same.
    fn looks_for_the_same(&self, other: &Self) -> bool;
}

/// How far a run has come.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Progress<F> {
    /// Where random numbers come from.
    pub seed: u64,
    /// Chunks in all.
    pub chunks: u64,
    /// Pairs a chunk.
    pub pairs_per_chunk: u64,
    /// Finished chunks.
    pub done: BTreeSet<u64>,
    /// What was found in them.
    #[serde(flatten)]
    pub found: F,
}

impl<F: Findings> Progress<F> {
    /// Nothing done yet, and nothing found; whole chunks, at least `pairs` pairs in all.
    fn with_nothing_done(seed: u64, pairs: u64, pairs_per_chunk: u64, nothing: F) -> Self {
        Self {
            seed,
            chunks: pairs.div_ceil(pairs_per_chunk),
            pairs_per_chunk,
            done: BTreeSet::new(),
            found: nothing,
        }
    }

    /// Whether all chunks are done.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.done.len() as u64 == self.chunks
    }

    /// Whether it is the same run as `other`, however far either has come.
    #[must_use]
    pub fn is_of_the_same_run(&self, other: &Self) -> bool {
        let key = |run: &Self| (run.seed, run.chunks, run.pairs_per_chunk);
        key(self) == key(other) && self.found.looks_for_the_same(&other.found)
    }
}

/// Does what is left, on as many threads, until `stops` says so: `look_at` a chunk of that index; `after_chunk` sees each state that
/// may be kept, one at a time.
///
/// # Panics
/// If a thread panics.
fn run<F: Findings>(
    progress: Progress<F>,
    threads: usize,
    look_at: impl Fn(u64) -> F::OfChunk + Sync,
    after_chunk: impl Fn(&Progress<F>) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress<F> {
    let all = 0..progress.chunks;
    let left: Vec<u64> = all.filter(|chunk| !progress.done.contains(chunk)).collect();
    let left = Mutex::new(left.into_iter());
    let progress = Mutex::new(progress);
    let take = || left.lock().expect("no panic").next();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while !stops() {
                    let Some(chunk) = take() else {
                        break;
                    };
                    let found = look_at(chunk);
                    let mut progress = progress.lock().expect("no panic");
                    progress.found.add(chunk, found);
                    progress.done.insert(chunk);
                    after_chunk(&progress);
                }
            });
        }
    });
    progress.into_inner().expect("no panic")
}
