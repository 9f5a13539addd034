//! Long runs over many pairs, in chunks, each with random numbers of its own: what a run finds depends on neither threads,
//! interruptions nor how many machines share it.
//!
//! | module | what it is |
//! |---|---|
//! | [`exact`] | a billion pairs, every cull and every "never" checked by exact arithmetic |
//! | [`false_culls`] | every tier of the filter over random and adversarial pairs |
//! | `screw_motions` | bodies that turn and meet, against enclosures of their arcs |
//! | [`mutants`] | changes of core, and whether a test notices: `verification/mutants/` writes its states, which are joined here |
//!
//! # Beyond one machine
//! A run has its chunks in one order; a [`Shard`] is a run of them. Its [`Progress`] says what run it is of ([`Settings`]), which chunks
//! are its own, which of them are done, and what was found in those, with a [`Digest`]; a [`StateFile`] keeps it through kills. [`merge()`]
//! joins shards that together have each chunk once, and refuses all others. No shard knows of the others, and nobody watches
//! them: whatever starts them again until each is finished will do.

mod chunks;
mod digest;
pub mod exact;
pub mod false_culls;
mod file;
mod merge;
pub mod mutants;
mod progress;
#[cfg(feature = "screw-motions")]
pub mod screw_motions;
mod shard;

pub use chunks::Chunks;
pub use digest::Digest;
pub use file::{FileError, StateFile, read, read_as};
pub use merge::{Refusal, merge};
pub use progress::{AnotherRun, Progress, Settings};
pub use shard::Shard;

use crate::generator::Choices;
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::sync::Mutex;

/// What a run looks for.
pub trait Findings: Send + Serialize + DeserializeOwned {
    /// What the campaign is called, in states.
    const CAMPAIGN: &'static str;

    /// What is found in one chunk.
    type OfChunk: Send + Serialize;

    /// Adds what was found in a chunk. In whichever order chunks come, the sum is the same.
    fn add(&mut self, chunk: u64, found: Self::OfChunk);

    /// Adds what was found in other chunks of the same run. In whichever order, the sum is the same.
    fn join(&mut self, other: Self);

    /// How many promises were found broken.
    fn wrong(&self) -> u64;
}

/// The random numbers of a chunk.
fn random(seed: u64, chunk: u64) -> TestRng {
    let mut bytes = [0; 16];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    // Never all zero, with which this generator would be stuck.
    bytes[8..].copy_from_slice(&(chunk + 1).to_le_bytes());
    let mut random = TestRng::from_seed(RngAlgorithm::XorShift, &bytes);
    // Seeds that differ in a few bits begin alike.
    random.fill_bytes(&mut [0; Choices::ENOUGH]);
    random
}

/// Does what is left, on as many threads, until `stops` says so: `look_at` a chunk of that index; `after_chunk` sees each state that
/// may be kept, one at a time.
///
/// # Panics
/// If a thread panics.
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
