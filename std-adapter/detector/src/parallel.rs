//! Loops that run on the rayon pool they are called in when it has more than one thread, and touch no pool otherwise.
//!
//! Outside a pool there is one thread: rayon's global pool is never started behind a caller's back, and code that is not
//! run in a pool allocates nothing for it.

use rayon::prelude::*;

/// The threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {threads} threads: {source}")]
pub struct ThreadError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

/// A pool of its own, or the calling thread.
#[derive(Debug, Default)]
pub struct Threads(Option<rayon::ThreadPool>);

impl Threads {
    /// So many threads; 0: one for each core. With one thread no pool is made.
    pub fn new(threads: usize) -> Result<Self, ThreadError> {
        if threads == 1 {
            return Ok(Self(None));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|source| ThreadError { threads, source })?;
        Ok(Self(Some(pool)))
    }

    pub fn count(&self) -> usize {
        self.0.as_ref().map_or(1, rayon::ThreadPool::current_num_threads)
    }

    /// Runs `action`, whose loops are then split between the threads.
    pub fn run<T: Send>(&self, action: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(pool) => pool.install(action),
            None => action(),
        }
    }
}

/// Whether work should be split between threads.
#[must_use]
pub fn has_many_threads() -> bool {
    rayon::current_thread_index().is_some() && rayon::current_num_threads() > 1
}

/// Calls `action` with each item and its index.
pub fn for_each<T: Send>(items: &mut [T], action: impl Fn(usize, &mut T) + Sync) {
    if items.len() > 1 && has_many_threads() {
        items.par_iter_mut().enumerate().for_each(|(index, item)| action(index, item));
    } else {
        for (index, item) in items.iter_mut().enumerate() {
            action(index, item);
        }
    }
}

/// Replaces `output` by `make` of each input.
pub fn fill<I: Sync, O: Send>(output: &mut Vec<O>, input: &[I], make: impl Fn(&I) -> O + Sync + Send) {
    if has_many_threads() {
        input.par_iter().map(make).collect_into_vec(output);
    } else {
        output.clear();
        output.extend(input.iter().map(make));
    }
}

/// Keeps the items for which `keep` is true, in their order.
pub fn retain<T: Copy + Send + Sync>(items: &mut Vec<T>, keep: impl Fn(&T) -> bool + Sync + Send) {
    if has_many_threads() {
        let kept = |chunk: &[T]| -> Vec<T> { chunk.iter().copied().filter(&keep).collect() };
        let chunks: Vec<_> = items.par_chunks(CHUNK).map(kept).collect();
        items.clear();
        chunks.iter().for_each(|chunk| items.extend_from_slice(chunk));
    } else {
        // Without a branch that nobody could foretell.
        let mut kept = 0;
        for index in 0..items.len() {
            let item = items[index];
            items[kept] = item;
            kept += usize::from(keep(&item));
        }
        items.truncate(kept);
    }
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
    if items.len() > CHUNK && has_many_threads() {
        let of_chunk = |(index, chunk): (usize, &mut [T])| {
            let mut own = R::default();
            action(index * CHUNK, chunk, &mut own);
            own
        };
        let chunks = items.par_chunks_mut(CHUNK).enumerate();
        let results: Vec<R> = chunks.map(of_chunk).collect();
        results.into_iter().for_each(|own| take(result, own));
    } else {
        action(0, items, result);
    }
}

/// Items that one thread takes at once.
const CHUNK: usize = 4096;

/// Calls both, in any order.
pub fn both(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    if has_many_threads() {
        rayon::join(one, other);
    } else {
        one();
        other();
    }
}

/// Calls `action` with each item, its index, and its chunk of `others`, `size` long.
pub fn for_each_with_chunk<T: Send, U: Send>(
    items: &mut [T],
    others: &mut [U],
    size: usize,
    action: impl Fn(usize, &mut T, &mut [U]) + Sync,
) {
    if items.len() > 1 && has_many_threads() {
        let chunks = others.par_chunks_mut(size);
        items
            .par_iter_mut()
            .zip(chunks)
            .enumerate()
            .for_each(|(index, (item, chunk))| action(index, item, chunk));
    } else {
        for (index, (item, chunk)) in items.iter_mut().zip(others.chunks_mut(size)).enumerate() {
            action(index, item, chunk);
        }
    }
}

/// Calls `action` with chunks of both lists, `size` long, that begin at the same index, and with that index.
pub fn for_each_chunk_with_chunk<T: Send, U: Send>(
    items: &mut [T],
    others: &mut [U],
    size: usize,
    action: impl Fn(usize, &mut [T], &mut [U]) + Sync,
) {
    if items.len() > size && has_many_threads() {
        let others = others.par_chunks_mut(size);
        items
            .par_chunks_mut(size)
            .zip(others)
            .enumerate()
            .for_each(|(index, (items, others))| action(index * size, items, others));
    } else {
        action(0, items, others);
    }
}

/// The number of the thread that calls, below [`threads`].
#[must_use]
pub fn own_index() -> usize {
    rayon::current_thread_index().unwrap_or(0)
}

/// How many threads work is split between.
#[must_use]
pub fn threads() -> usize {
    if has_many_threads() { rayon::current_num_threads() } else { 1 }
}
