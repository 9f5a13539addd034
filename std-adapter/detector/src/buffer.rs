//! Memory that is kept from step to step.

/// Half as much again.
#[must_use]
pub fn with_headroom(len: usize) -> usize {
    len + len / 2 + 1
}

/// To be called at the end of a step for a vector that is filled anew in each: makes room for half as much again as it holds, if
/// there is hardly any room left.
pub(crate) fn settle<T>(items: &mut Vec<T>) {
    if items.capacity() < items.len() + items.len() / 8 + 1 {
        items.reserve_exact(with_headroom(items.len()) - items.len());
    }
}
