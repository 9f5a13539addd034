//! When a hierarchy that is only refitted should be built anew.

/// What builds and items cost.
#[derive(Clone, Copy, Debug)]
pub struct Prices {
    /// What a build costs for each item and halving, in block tests.
    pub build: f64,
    /// What an item costs in block tests, in units of what a pair costs.
    pub item: f64,
}

/// How much more the traversals since the last build have cost than one just after a build would have.
#[derive(Debug, Default)]
pub struct Degradation {
    /// Block tests for each unit of size (items at their price, and pairs) just after the build.
    fresh: Option<f64>,
    /// Block tests above that, summed over the steps since.
    excess: f64,
}

impl Degradation {
    /// A traversal has found so many pairs of so many items.
    pub fn observe(&mut self, prices: Prices, block_tests: u64, items: usize, pairs: usize) {
        let size = prices.item * items.max(1) as f64 + pairs as f64;
        let fresh = *self.fresh.get_or_insert(block_tests as f64 / size);
        self.excess += (block_tests as f64 - fresh * size).max(0.0);
    }

    /// Whether the traversals since the build have cost more, beyond what they would have just after it, than another build.
    #[must_use]
    pub fn is_worth_a_build(&self, prices: Prices, items: usize) -> bool {
        let items = items as f64;
        self.excess > prices.build * items * items.log2()
    }
}
