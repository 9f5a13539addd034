//! The largest bound that a decision accepts.

use super::prelude::*;

/// Returns the largest tried number up to which all are accepted, if zero is.
pub(crate) fn largest_accepted<S: Format>(accepts: impl Fn(S) -> bool) -> Option<S> {
    if !accepts(S::ZERO) {
        return None;
    }
    let (mut low, mut high) = (0, S::INFINITY.encoding());
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if accepts(S::from_word(middle)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(S::from_word(low))
}

/// Returns the largest result of `f` in any environment.
pub(crate) fn largest_of_all<S: Format, I>(input: &I, f: impl Fn(&I) -> Option<S>) -> Option<S> {
    let found = Environment::all()
        .into_iter()
        .filter_map(|environment| environment.run(input, &f));
    found.reduce(|a, b| if a < b { b } else { a })
}
