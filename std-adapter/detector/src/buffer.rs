//! Memory that is kept from step to step.

/// Half as much again.
#[must_use]
fn with_headroom(len: usize) -> usize {
    len + len / 2 + 1
}

/// To be called at the end of a step for a vector that is filled anew in each: makes room for half as much again as it holds, if
/// there is hardly any room left.
pub(crate) fn settle<T>(items: &mut Vec<T>) {
    if items.capacity() < items.len() + items.len() / 8 + 1 {
        items.reserve_exact(with_headroom(items.len()) - items.len());
    }
}

/// Adds to `output` what `kept` makes of each item, told its place, if it says so. Without a branch, which nobody could foretell.
#[inline(always)]
pub fn add_kept<T, K: Copy + Default>(output: &mut Vec<K>, items: &[T], kept: impl Fn(usize, &T) -> (bool, K)) {
    let mut place = 0;
    for some in items.chunks(AT_ONCE) {
        let mut count = output.len();
        // Room for some only: it is in the cache when it is written.
        output.resize(count + some.len(), K::default());
        for item in some {
            let (is_kept, item) = kept(place, item);
            output[count] = item;
            count += usize::from(is_kept);
            place += 1;
        }
        output.truncate(count);
    }
}

/// Items that there is room for at a time: some kilobytes.
const AT_ONCE: usize = 1024;

#[cfg(test)]
mod tests {
    use super::{AT_ONCE, add_kept};

    #[test]
    fn what_is_kept_is_added_in_order() {
        let items: Vec<usize> = (0..3 * AT_ONCE + 7).collect();
        let mut output = vec![7];
        add_kept(&mut output, &items, |place, item| (item % 3 == 0, 10 * item + place));
        add_kept(&mut output, &[], |_, _: &u8| (true, 0));
        let expected = items.iter().filter(|&item| item % 3 == 0).map(|item| 11 * item);
        assert!(output.iter().copied().eq(std::iter::once(7).chain(expected)));
    }
}
