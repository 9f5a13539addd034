//! The exact answers of `selvedge accuracy` are true: whether a pair touches, and between which times it first does.

use proptest::prelude::*;
use selvedge_laboratory::study::elementary::{ExactAnswer, WIDEST, exact_answer};
use selvedge_verification::formats;
use selvedge_verification::generator::{Format, PairCase, check, coplanar_pairs, pairs_of_any_kind, touching_pairs};
use selvedge_verification::oracle::collides;
use std::cell::Cell;

/// Counts pairs that touch, and those whose first time is known.
#[derive(Default)]
struct Counts {
    touching: Cell<u32>,
    with_time: Cell<u32>,
}

fn add(count: &Cell<u32>) {
    count.set(count.get() + 1);
}

fn is_true<S: Format>(pair: &PairCase<S>, counts: &Counts) -> Result<(), TestCaseError> {
    let answer = exact_answer(&pair.pair());
    let exact = collides(&pair.question());
    match (answer, exact) {
        (ExactAnswer::Never, None) => {}
        (ExactAnswer::Touches { first }, Some(exact)) => {
            add(&counts.touching);
            if let Some([from, to]) = first {
                add(&counts.with_time);
                prop_assert!(to - from <= WIDEST, "[{from}, {to}]");
                let is_between = exact.cmp_f64(from).is_ge() && exact.cmp_f64(to).is_le();
                prop_assert!(is_between, "{exact:?} is not in [{from}, {to}]");
            }
        }
        (answer, exact) => prop_assert!(false, "{answer:?}, but {exact:?}"),
    }
    Ok(())
}

fn answers_are_true<S: Format>() {
    let counts = Counts::default();
    check(7_500, pairs_of_any_kind::<S>(), |pair| is_true(pair, &counts));
    check(7_500, touching_pairs::<S>(), |moment| is_true(&moment.pair(), &counts));
    check(7_500, coplanar_pairs::<S>(), |moment| is_true(&moment.pair(), &counts));
    let [touching, with_time] = [counts.touching.get(), counts.with_time.get()];
    assert!(touching > 5_000 && with_time > 250, "{with_time} of {touching}");
}

formats!(answers_are_true);
