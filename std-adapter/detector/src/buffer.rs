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

/// Adds to `output` the items that come with true; they are no more than `most`. Without a branch, which nobody could foretell.
///
/// # Panics
/// If there are more.
#[inline(always)]
pub fn add_kept<T: Copy + Default>(output: &mut Vec<T>, most: usize, items: impl Iterator<Item = (bool, T)>) {
    let mut count = output.len();
    output.resize(count + most, T::default());
    for (is_kept, item) in items {
        output[count] = item;
        count += usize::from(is_kept);
    }
    output.truncate(count);
}

#[cfg(test)]
mod tests {
    use super::add_kept;

    #[test]
    fn what_is_kept_is_added_in_order() {
        let mut output = vec![7];
        add_kept(&mut output, 4, [(false, 1), (true, 2), (true, 3), (false, 4)].into_iter());
        add_kept(&mut output, 0, std::iter::empty());
        assert_eq!(output, [7, 2, 3]);
    }
}
