//! Buffers that are kept from step to step.

fn with_headroom(len: usize) -> usize {
    len + len / 2 + 1
}

/// Makes room for half as much again as `items` holds, if there is hardly any room left. Call it at the end of a step for a
/// vector that each step fills again.
pub(crate) fn reserve_headroom<T>(items: &mut Vec<T>) {
    if items.capacity() < items.len() + items.len() / 8 + 1 {
        items.reserve_exact(with_headroom(items.len()) - items.len());
    }
}

/// Appends `selected(index, item)` to `output` where it is selected, without a branch, since the branch would be unpredictable.
///
/// ```
/// let mut even = Vec::new();
/// selvedge::parallel::append_selected(&mut even, &[7, 8, 10], |index, &item| (item % 2 == 0, (index, item)));
/// assert_eq!(even, [(1, 8), (2, 10)]);
/// ```
#[inline(always)]
pub fn append_selected<T, K: Copy + Default>(output: &mut Vec<K>, items: &[T], selected: impl Fn(usize, &T) -> (bool, K)) {
    let mut index = 0;
    for some in items.chunks(AT_ONCE) {
        let mut count = output.len();
        // The room is for some items only, so that it is in the cache when it is written.
        output.resize(count + some.len(), K::default());
        for item in some {
            let (is_selected, item) = selected(index, item);
            output[count] = item;
            count += usize::from(is_selected);
            index += 1;
        }
        output.truncate(count);
    }
}

/// The number of items for which room is made at a time: some kilobytes.
const AT_ONCE: usize = 1024;

#[cfg(test)]
mod tests {
    use super::{AT_ONCE, append_selected};

    #[test]
    fn selected_items_are_appended_in_order() {
        let items: Vec<usize> = (0..3 * AT_ONCE + 7).collect();
        let mut output = vec![7];
        append_selected(&mut output, &items, |place, item| (item % 3 == 0, 10 * item + place));
        append_selected(&mut output, &[], |_, _: &u8| (true, 0));
        let expected = items.iter().filter(|&item| item % 3 == 0).map(|item| 11 * item);
        assert!(output.iter().copied().eq(std::iter::once(7).chain(expected)));
    }
}
