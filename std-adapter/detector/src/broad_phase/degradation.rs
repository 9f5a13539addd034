//! Decides when a refitted hierarchy is worth building again.

/// Prices of builds and items, in box tests.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prices {
    /// The price of a build for each item and halving, in box tests.
    pub(super) build: f64,
    /// The price of an item in a search, in units of the price of a pair.
    pub(super) item: f64,
}

/// Sums what searches cost more than they would just after a build.
#[derive(Debug, Default)]
pub(super) struct Degradation {
    /// Box tests for each unit of size just after the build, if a search was measured then. The size is that of items, at their
    /// price, and pairs.
    fresh: Option<f64>,
    /// Box tests for each unit of size just after the build, for other searches.
    fresh_of_others: Option<f64>,
    /// Box tests beyond that, summed since the build.
    excess: f64,
}

/// Box tests for each unit of size of good hierarchies, where none were measured just after the build. A flat sheet of 20,000
/// triangles takes 0.22, and the same sheet crumpled takes 0.31 to 0.33.
const TYPICAL: f64 = 0.5;

impl Degradation {
    /// Notes a search that found `pairs` among `items` in this number of box tests. `is_new` says that it is the first one after
    /// the build.
    pub(super) fn observe(&mut self, prices: Prices, box_tests: u64, items: usize, pairs: usize, is_new: bool) {
        let size = size(prices, items, pairs);
        self.excess += excess(&mut self.fresh, 0.0, box_tests as f64, size, is_new);
    }

    /// Notes a search with other boxes, or for other pairs. Such searches may be of several kinds, so the first one is a weaker
    /// reference.
    pub(super) fn observe_another(&mut self, prices: Prices, box_tests: u64, items: usize, pairs: usize, is_new: bool) {
        let size = size(prices, items, pairs);
        self.excess += excess(&mut self.fresh_of_others, TYPICAL, box_tests as f64, size, is_new);
    }

    /// Returns whether searches since the build cost more, beyond their cost just after it, than another build.
    pub(super) fn is_worth_a_build(&self, prices: Prices, items: usize) -> bool {
        let items = items as f64;
        self.excess > prices.build * items * items.log2()
    }
}

fn size(prices: Prices, items: usize, pairs: usize) -> f64 {
    prices.item * items.max(1) as f64 + pairs as f64
}

/// Returns the box tests beyond those of new hierarchies, which take at least `least` for each unit of size.
fn excess(fresh: &mut Option<f64>, least: f64, box_tests: f64, size: f64, is_new: bool) -> f64 {
    if is_new {
        fresh.get_or_insert(box_tests / size);
    }
    (box_tests - fresh.unwrap_or(TYPICAL).max(least) * size).max(0.0)
}
