//! Threads, and loops that are split between them.
//!
//! [`Workers`] are threads. A loop inside [`Workers::run`] is split between them. Outside it, a loop runs on the caller's rayon
//! pool if that has more than one thread, and otherwise on the calling thread. Rayon's global pool is never started. Without the
//! feature `parallel` all loops run on the calling thread.
//!
//! ```
//! use selvedge::parallel::{Workers, for_each};
//!
//! let workers = Workers::default(); // The calling thread. `Workers::new(Threads::EachCore)` starts others.
//! let mut squares = [0; 100];
//! workers.run(|| for_each(&mut squares, |index, square| *square = index * index));
//! assert_eq!(squares[9], 81);
//! ```
//!
//! All loops give the same results on any number of threads.

#[cfg(feature = "parallel")]
mod pool;

pub use crate::buffer::append_selected;

#[cfg(feature = "parallel")]
pub use pool::{ThreadError, Threads, Workers, has_many_threads, own_index, threads};
#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// The threads of a loop. Without the feature `parallel` only the calling thread is used.
#[cfg(not(feature = "parallel"))]
#[derive(Debug, Default)]
pub struct Workers(());

#[cfg(not(feature = "parallel"))]
impl Workers {
    /// Returns the number of threads.
    #[must_use]
    pub fn count(&self) -> usize {
        1
    }

    /// Runs `action`.
    pub fn run<T: Send>(&self, action: impl FnOnce() -> T + Send) -> T {
        action()
    }
}

/// Returns whether loops are split between threads.
#[cfg(not(feature = "parallel"))]
#[must_use]
pub const fn has_many_threads() -> bool {
    false
}

/// Returns the number of the calling thread, below [`threads`].
#[cfg(not(feature = "parallel"))]
#[must_use]
pub const fn own_index() -> usize {
    0
}

/// Returns the number of threads that loops are split between.
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

/// Replaces `output` by `make(item)` for each item of `input`.
pub fn fill<I: Sync, O: Send>(output: &mut Vec<O>, input: &[I], make: impl Fn(&I) -> O + Sync + Send) {
    #[cfg(feature = "parallel")]
    if has_many_threads() {
        input.par_iter().map(make).collect_into_vec(output);
        return;
    }
    output.clear();
    output.extend(input.iter().map(make));
}

/// Replaces `output` by the items that `add` appends for chunks of `items`, in their order.
pub fn gather<I: Sync, O: Copy + Send>(output: &mut Vec<O>, items: &[I], add: impl Fn(&[I], &mut Vec<O>) + Sync + Send) {
    output.clear();
    #[cfg(feature = "parallel")]
    if items.len() > CHUNK && has_many_threads() {
        let of_chunk = |chunk: &[I]| {
            let mut share = Vec::new();
            add(chunk, &mut share);
            share
        };
        let chunks: Vec<_> = items.par_chunks(CHUNK).map(of_chunk).collect();
        chunks.iter().for_each(|chunk| output.extend_from_slice(chunk));
        return;
    }
    add(items, output);
}

/// Calls `action` with each chunk of the items, the index of its first item, and a result of its own. `take` joins the results to
/// `result`, in order.
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
            let mut share = R::default();
            action(index * CHUNK, chunk, &mut share);
            share
        };
        let chunks = items.par_chunks_mut(CHUNK).enumerate();
        let results: Vec<R> = chunks.map(of_chunk).collect();
        results.into_iter().for_each(|share| take(result, share));
        return;
    }
    #[cfg(not(feature = "parallel"))]
    drop(take);
    action(0, items, result);
}

#[cfg(feature = "parallel")]
const CHUNK: usize = 4096;

/// Calls both functions, in any order or at the same time.
pub fn both(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if has_many_threads() {
        rayon::join(one, other);
        return;
    }
    one();
    other();
}

/// Calls `action` with each item, its index, and its chunk of `others`, of `size` items.
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

/// Calls `action` with chunks of `size` items of both lists that begin at the same index, and with that index.
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
