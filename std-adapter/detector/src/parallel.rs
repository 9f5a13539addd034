//! Threads: which ones a detector runs on, and loops that are split between them.
//!
//! A loop runs on the rayon pool that it is called in when that has more than one thread, and touches no pool otherwise: rayon's global
//! pool is never started behind a caller's back, and code that is not run in a pool allocates nothing for it. Within
//! [`Workers::run`] of [`Threads::Calling`] there is one thread, in a pool or not. Without the feature `parallel` there is one always.

#[cfg(feature = "parallel")]
mod pool;

pub use crate::buffer::add_kept;

#[cfg(feature = "parallel")]
pub use pool::{ThreadError, Threads, Workers, has_many_threads, own_index, threads};
#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// The calling thread.
#[cfg(not(feature = "parallel"))]
#[derive(Debug, Default)]
pub struct Workers(());

#[cfg(not(feature = "parallel"))]
impl Workers {
    /// How many threads there are.
    #[must_use]
    pub fn count(&self) -> usize {
        1
    }

    /// Runs `action`.
    pub fn run<T: Send>(&self, action: impl FnOnce() -> T + Send) -> T {
        action()
    }
}

/// Whether work should be split between threads.
#[cfg(not(feature = "parallel"))]
#[must_use]
pub const fn has_many_threads() -> bool {
    false
}

/// The number of the thread that calls, below [`threads`].
#[cfg(not(feature = "parallel"))]
#[must_use]
pub const fn own_index() -> usize {
    0
}

/// How many threads work is split between.
#[cfg(not(feature = "parallel"))]
#[must_use]
pub const fn threads() -> usize {
    1
}

/// Calls `action` with each item and its index.
pub fn for_each<T: Send>(items: &mut [T], action: impl Fn(usize, &mut T) + Sync) {
    #[cfg(feature = "parallel")]
    if items.len() > 1 && has_many_threads() {
        items.par_iter_mut().enumerate().for_each(|(index, item)| action(index, item));
        return;
    }
    for (index, item) in items.iter_mut().enumerate() {
        action(index, item);
    }
}

/// Replaces `output` by `make` of each input.
pub fn fill<I: Sync, O: Send>(output: &mut Vec<O>, input: &[I], make: impl Fn(&I) -> O + Sync + Send) {
    #[cfg(feature = "parallel")]
    if has_many_threads() {
        input.par_iter().map(make).collect_into_vec(output);
        return;
    }
    output.clear();
    output.extend(input.iter().map(make));
}

/// Replaces `output` by what `add` adds of chunks of the items, in their order.
pub fn gather<I: Sync, O: Copy + Send>(output: &mut Vec<O>, items: &[I], add: impl Fn(&[I], &mut Vec<O>) + Sync + Send) {
    output.clear();
    #[cfg(feature = "parallel")]
    if items.len() > CHUNK && has_many_threads() {
        let of_chunk = |chunk: &[I]| {
            let mut own = Vec::new();
            add(chunk, &mut own);
            own
        };
        let chunks: Vec<_> = items.par_chunks(CHUNK).map(of_chunk).collect();
        chunks.iter().for_each(|chunk| output.extend_from_slice(chunk));
        return;
    }
    add(items, output);
}

/// Calls `action` with chunks of the items and the index at which each begins; joins their results to `result` by `take`, in order.
pub fn map_chunks<T: Send, R>(
    items: &mut [T],
    action: impl Fn(usize, &mut [T], &mut R) + Sync + Send,
    result: &mut R,
    take: impl Fn(&mut R, R),
) where
    R: Default + Send,
{
    #[cfg(feature = "parallel")]
    if items.len() > CHUNK && has_many_threads() {
        let of_chunk = |(index, chunk): (usize, &mut [T])| {
            let mut own = R::default();
            action(index * CHUNK, chunk, &mut own);
            own
        };
        let chunks = items.par_chunks_mut(CHUNK).enumerate();
        let results: Vec<R> = chunks.map(of_chunk).collect();
        results.into_iter().for_each(|own| take(result, own));
        return;
    }
    #[cfg(not(feature = "parallel"))]
    drop(take);
    action(0, items, result);
}

/// Items that one thread takes at once.
#[cfg(feature = "parallel")]
const CHUNK: usize = 4096;

/// Calls both, in any order.
pub fn both(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if has_many_threads() {
        rayon::join(one, other);
        return;
    }
    one();
    other();
}

/// Calls `action` with each item, its index, and its chunk of `others`, `size` long.
pub fn for_each_with_chunk<T: Send, U: Send>(
    items: &mut [T],
    others: &mut [U],
    size: usize,
    action: impl Fn(usize, &mut T, &mut [U]) + Sync,
) {
    #[cfg(feature = "parallel")]
    if items.len() > 1 && has_many_threads() {
        let chunks = others.par_chunks_mut(size);
        items
            .par_iter_mut()
            .zip(chunks)
            .enumerate()
            .for_each(|(index, (item, chunk))| action(index, item, chunk));
        return;
    }
    for (index, (item, chunk)) in items.iter_mut().zip(others.chunks_mut(size)).enumerate() {
        action(index, item, chunk);
    }
}

/// Calls `action` with chunks of both lists, `size` long, that begin at the same index, and with that index.
pub fn for_each_chunk_with_chunk<T: Send, U: Send>(
    items: &mut [T],
    others: &mut [U],
    size: usize,
    action: impl Fn(usize, &mut [T], &mut [U]) + Sync,
) {
    #[cfg(feature = "parallel")]
    if items.len() > size && has_many_threads() {
        let others = others.par_chunks_mut(size);
        items
            .par_chunks_mut(size)
            .zip(others)
            .enumerate()
            .for_each(|(index, (items, others))| action(index * size, items, others));
        return;
    }
    #[cfg(not(feature = "parallel"))]
    let _ = size;
    action(0, items, others);
}
