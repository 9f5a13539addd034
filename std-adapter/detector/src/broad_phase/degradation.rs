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
    /// Block tests for each unit of size (items at their price, and pairs) just after the build, if it was measured then.
    fresh: Option<f64>,
    /// The same of traversals that look for something else.
    fresh_of_others: Option<f64>,
    /// Block tests above that, summed over the steps since.
    excess: f64,
}

/// Block tests for each unit of size where hierarchies are as good as new: 0.22 on a flat sheet of 20,000 triangles, 0.31 to 0.33 on the same
/// crumpled until nine tenths of it are pairs. It stands for what was not measured just after the build.
const TYPICAL: f64 = 0.5;

impl Degradation {
    /// A traversal has found so many pairs of so many items; `is_new`: with the boxes of the step of the build.
    pub fn observe(&mut self, prices: Prices, block_tests: u64, items: usize, pairs: usize, is_new: bool) {
        let size = size(prices, items, pairs);
        self.excess += excess(&mut self.fresh, 0.0, block_tests as f64, size, is_new);
    }

    /// The same of a traversal with boxes of another kind, or for pairs of another kind. They may be of several kinds: the first one says less.
    pub fn observe_another(&mut self, prices: Prices, block_tests: u64, items: usize, pairs: usize, is_new: bool) {
        let size = size(prices, items, pairs);
        self.excess += excess(&mut self.fresh_of_others, TYPICAL, block_tests as f64, size, is_new);
    }

    /// Whether the traversals since the build have cost more, beyond what they would have just after it, than another build.
    #[must_use]
    pub fn is_worth_a_build(&self, prices: Prices, items: usize) -> bool {
        let items = items as f64;
        self.excess > prices.build * items * items.log2()
    }
}

fn size(prices: Prices, items: usize, pairs: usize) -> f64 {
    prices.item * items.max(1) as f64 + pairs as f64
}

/// Block tests above those that hierarchies take that are as good as new, and such take `least` for each unit of size.
fn excess(fresh: &mut Option<f64>, least: f64, block_tests: f64, size: f64, is_new: bool) -> f64 {
    if is_new {
        fresh.get_or_insert(block_tests / size);
    }
    (block_tests - fresh.unwrap_or(TYPICAL).max(least) * size).max(0.0)
}
