//! Loops that run on the current rayon pool when it has more than one thread, and never touch it otherwise.

use rayon::prelude::*;

/// Whether work should be split between threads.
pub(super) fn has_many_threads() -> bool {
    rayon::current_num_threads() > 1
}

/// Calls `action` with each item and its index.
pub(super) fn for_each<T: Send>(items: &mut [T], action: impl Fn(usize, &mut T) + Sync) {
    if items.len() > 1 && has_many_threads() {
        items
            .par_iter_mut()
            .enumerate()
            .for_each(|(index, item)| action(index, item));
    } else {
        for (index, item) in items.iter_mut().enumerate() {
            action(index, item);
        }
    }
}

/// Calls both, in any order.
pub(super) fn both(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    if has_many_threads() {
        rayon::join(one, other);
    } else {
        one();
        other();
    }
}

/// Calls `action` with each item, its index, and its chunk of `others`, `size` long.
pub(super) fn for_each_with_chunk<T: Send, U: Send>(
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
