//! The filter of inside functions never culls a pair that touches, culls pairs that become coplanar beside each other, and keeps
//! what is not finite.
//!
//! Its rounding in other environments is tested with the other certified tests
//! (`certified_in_every_floating_point_environment.rs`), its lanes in `batches_agree_with_one_pair.rs`.

use proptest::prelude::*;
use selvedge_core::Verdict;
use selvedge_core::filter::inside;
use selvedge_verification::generator::{
    Format, Moment, PairCase, check, coplanar_pairs, extraordinary_pairs, pairs_of_any_kind, touching_pairs,
};
use selvedge_verification::oracle::collides;
use std::cell::Cell;

fn verdict<S: Format>(pair: &PairCase<S>) -> Verdict {
    inside::never_inside(&pair.pair())
}

/// Needs no oracle: the pair touches by construction.
fn keeps_what_touches<S: Format>(moment: &Moment<S>) -> Result<(), TestCaseError> {
    prop_assert_eq!(verdict(&moment.pair()), Verdict::Kept);
    Ok(())
}

#[test]
fn keeps_every_pair_built_to_touch_f64() {
    check(100_000, touching_pairs::<f64>(), keeps_what_touches);
}

#[test]
fn keeps_every_pair_built_to_touch_f32() {
    check(100_000, touching_pairs::<f32>(), keeps_what_touches);
}

fn culls_only_what_never_touches<S: Format>(pair: &PairCase<S>, culled: &Cell<u32>) -> Result<(), TestCaseError> {
    if verdict(pair).is_culled() {
        culled.set(culled.get() + 1);
        prop_assert!(pair.is_finite(), "culled though it is not finite");
        let first = collides(&pair.question());
        prop_assert!(first.is_none(), "culled, but it touches at {first:?}");
    }
    Ok(())
}

/// Many of the pairs that become coplanar do so beside each other: there is something to cull.
fn culls_coplanar_pairs<S: Format>() {
    let (asked, culled) = (Cell::new(0), Cell::new(0));
    check(40_000, coplanar_pairs::<S>(), |moment| {
        asked.set(asked.get() + 1);
        culls_only_what_never_touches(&moment.pair(), &culled)
    });
    let (culled, asked) = (culled.get(), asked.get());
    assert!(culled > asked / 20, "only {culled} of {asked}");
}

#[test]
fn culls_coplanar_pairs_that_never_touch_and_no_others_f64() {
    culls_coplanar_pairs::<f64>();
}

#[test]
fn culls_coplanar_pairs_that_never_touch_and_no_others_f32() {
    culls_coplanar_pairs::<f32>();
}

#[test]
fn never_culls_what_touches_f64() {
    check(60_000, pairs_of_any_kind::<f64>(), |pair| {
        culls_only_what_never_touches(pair, &Cell::new(0))
    });
}

#[test]
fn never_culls_what_touches_f32() {
    check(60_000, pairs_of_any_kind::<f32>(), |pair| {
        culls_only_what_never_touches(pair, &Cell::new(0))
    });
}

#[test]
fn never_culls_nan_infinity_or_what_touches_at_the_ends_of_the_range() {
    check(40_000, extraordinary_pairs::<f64>(), |pair| {
        culls_only_what_never_touches(pair, &Cell::new(0))
    });
    check(40_000, extraordinary_pairs::<f32>(), |pair| {
        culls_only_what_never_touches(pair, &Cell::new(0))
    });
}
