//! Looks up pairs that are found again.

use super::pair::NearPair;
use selvedge_core::PairKind;

/// Known pairs, in two runs that each ascend by key. Look-ups ascend too, and drop the pairs that they pass.
pub(super) struct Known<'a, D>([&'a [NearPair<D>]; 2]);

impl<'a, D: Copy> Known<'a, D> {
    /// Takes a list whose second run begins at `first`.
    pub(super) fn new(list: &'a [NearPair<D>], first: usize) -> Self {
        Self(list.split_at(first).into())
    }

    /// Returns the pair with this key, which must be larger than all earlier ones.
    #[inline(always)]
    pub(super) fn find(&mut self, key: (PairKind, [u32; 2])) -> Option<&'a NearPair<D>> {
        let [first, added] = &mut self.0;
        let order = order_of(key);
        let found = find_in(first, order);
        found.or_else(|| find_in(added, order))
    }
}

/// Returns the pair of this order in a run. The run then begins with it, or with the pair after it.
#[inline(always)]
fn find_in<'a, D: Copy>(run: &mut &'a [NearPair<D>], order: u128) -> Option<&'a NearPair<D>> {
    let mut passed = 0;
    while run.get(passed).is_some_and(|other| order_of(other.key()) < order) {
        passed += 1;
        if passed == SINGLY {
            passed = how_many_before(run, order);
        }
    }
    *run = &run[passed..];
    run.first().filter(|first| order_of(first.key()) == order)
}

/// The number of pairs that are passed one by one; mostly none needs to be.
const SINGLY: usize = 8;

/// Returns how many pairs come before, in logarithmic time.
#[cold]
fn how_many_before<D: Copy>(run: &[NearPair<D>], order: u128) -> usize {
    let comes_before = |other: &NearPair<D>| order_of(other.key()) < order;
    let mut end = 2 * SINGLY;
    while run.get(end - 1).is_some_and(comes_before) {
        end *= 2;
    }
    let start = end / 2;
    start + run[start..run.len().min(end)].partition_point(comes_before)
}

#[inline(always)]
fn order_of((kind, pair): (PairKind, [u32; 2])) -> u128 {
    let [first, second] = pair.map(u128::from);
    (kind as u128) << 64 | first << 32 | second
}
