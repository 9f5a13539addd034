//! What is known of pairs that are found again.

use super::pair::NearPair;
use crate::PairKind;

/// Pairs that are known, in two runs that each ascend by key, from the next ones that may be asked for on.
pub(super) struct Known<'a, D>([&'a [NearPair<D>]; 2]);

impl<'a, D: Copy> Known<'a, D> {
    /// The second run begins at `first`.
    pub(super) fn of(list: &'a [NearPair<D>], first: usize) -> Self {
        Self(list.split_at(first).into())
    }

    /// The pair with this key, which comes after all that were asked for.
    #[inline(always)]
    pub(super) fn find(&mut self, key: (PairKind, [u32; 2])) -> Option<&'a NearPair<D>> {
        let [first, added] = &mut self.0;
        let order = order_of(key);
        let found = find_in(first, order);
        found.or_else(|| find_in(added, order))
    }
}

/// The pair of this order in a run, which begins with it or what comes after it then.
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

/// So many are passed over one by one: mostly it is none.
const SINGLY: usize = 8;

/// How many come before, in a time that grows with the logarithm of their number.
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

/// The key of a pair as one number.
#[inline(always)]
fn order_of((kind, pair): (PairKind, [u32; 2])) -> u128 {
    let [first, second] = pair.map(u128::from);
    (kind as u128) << 64 | first << 32 | second
}
