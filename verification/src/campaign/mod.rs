//! Long runs over many pairs, in chunks. Each chunk has random numbers of its own, so the findings do not depend on threads,
//! interruptions or the number of machines.
//!
//! | module | contents |
//! |---|---|
//! | [`exact`] | a billion pairs, every cull and every "never" checked by exact arithmetic |
//!
//! # Beyond one machine
//! A run has its chunks in one order; a [`Shard`] is a range of them. Its [`Progress`] holds the [`Settings`] of the run, the shard's
//! chunks, the finished ones, their findings and a [`Digest`] of these. A [`StateFile`] keeps it, even if the process is killed.
//! [`merge()`] joins shards that together have each chunk once, and refuses all others. Shards do not communicate: restart each of
//! them until it has finished.

mod chunks;
mod digest;
pub mod exact;
mod file;
mod merge;
mod progress;
mod shard;

pub use chunks::Chunks;
pub use digest::Digest;
pub use file::{FileError, StateFile, read};
pub use merge::{Refusal, merge};
pub use progress::{AnotherRun, Progress, Settings};
pub use shard::Shard;

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::sync::Mutex;

/// The findings of a run, by chunk and in sum.
pub trait Findings: Send + Serialize + DeserializeOwned {
    /// The campaign's name in state files.
    const CAMPAIGN: &'static str;

    /// The findings of one chunk.
    type OfChunk: Send + Serialize;

    /// Adds the findings of a chunk. The sum does not depend on the order of the chunks.
    fn add(&mut self, chunk: u64, found: Self::OfChunk);

    /// Adds the findings of other chunks of the same run. The sum does not depend on the order.
    fn join(&mut self, other: Self);

    fn wrong(&self) -> u64;
}

/// Runs the remaining chunks on `threads` threads until `stops` returns true.
///
/// `look_at` examines the chunk of an index. `after_chunk` gets each state that may be kept, one at a time.
///
/// # Panics
/// Panics if a thread panics.
pub fn run<F: Findings>(
    progress: Progress<F>,
    threads: usize,
    look_at: impl Fn(u64) -> F::OfChunk + Sync,
    after_chunk: impl Fn(&Progress<F>) + Sync,
    stops: impl Fn() -> bool + Sync,
) -> Progress<F> {
    let done = progress.done.clone();
    let left = Mutex::new(progress.range.clone().filter(|&chunk| !done.contains(chunk)));
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
                    progress.add(chunk, found);
                    after_chunk(&progress);
                }
            });
        }
    });
    progress.into_inner().expect("no panic")
}
