//! The published methods are right if rounding does not matter; otherwise the comparison with them would be worthless.

use proptest::prelude::*;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::{PairKind, PrimitivePair};
use selvedge_laboratory::baselines::plain::non_coplanarity;
use selvedge_laboratory::baselines::{additive, bernstein_sign, cubic, tight_inclusion};
use selvedge_verification::generator::{PairCase, check, pairs};
use selvedge_verification::oracle::collides;

/// Generates coordinates anywhere from −1 to 1, all different. Half of the pairs are coplanar at some time, one in twenty touch,
/// and hardly any so closely that rounding to 53 bits could matter.
fn any_pairs(kind: PairKind) -> impl Strategy<Value = PairCase<f64>> + Clone {
    let coordinate = || -1.0..1.0_f64;
    let position = move || [coordinate(), coordinate(), coordinate()];
    let motion = move || [position(), position()];
    [motion(), motion(), motion(), motion()].prop_map(move |points| PairCase::new(kind, points))
}

/// Runs a method on pairs of either kind, and gives `is_allowed` the truth and the answer.
fn compare(cases: u32, asked: fn(&PrimitivePair<f64>) -> bool, is_allowed: fn(truth: bool, answer: bool) -> bool) {
    for kind in PairKind::ALL {
        check(cases, any_pairs(kind), |pair| {
            let (truth, answer) = (collides(&pair.question()).is_some(), asked(&pair.pair()));
            prop_assert!(is_allowed(truth, answer), "{truth}, answered {answer}");
            Ok(())
        });
    }
}

fn equal(truth: bool, answer: bool) -> bool {
    truth == answer
}

/// Methods with a tolerance may give a false alarm.
fn no_miss(truth: bool, answer: bool) -> bool {
    answer || !truth
}

#[test]
fn the_plain_cubic_decides_pairs_in_general_position() {
    compare(20_000, |pair| cubic::time_of_impact(pair).is_some(), equal);
}

#[test]
fn signs_of_polynomials_decide_pairs_in_general_position() {
    compare(20_000, bernstein_sign::touches, equal);
}

#[test]
fn tight_inclusion_misses_nothing() {
    const LIMITS: Limits<f64> = Limits::accurate_to(1e-6);
    compare(
        2_000,
        |pair| tight_inclusion::time_of_impact(pair, &LIMITS) != Impact::Never,
        no_miss,
    );
}

#[test]
fn additive_advancement_misses_nothing_in_general_position() {
    compare(2_000, |pair| additive::time_of_impact(pair, 0.0) != Impact::Never, no_miss);
}

/// The paper's filter is written twice, here and in `selvedge-verification`, whose campaigns show that they find its false culls.
#[test]
fn the_plain_filter_is_the_one_of_the_campaigns() {
    check(4_000, pairs::<f64>(PairKind::VertexFace), |case| {
        let expected = selvedge_verification::plain::culls(case);
        prop_assert_eq!(non_coplanarity(&case.pair()).is_culled(), expected);
        Ok(())
    });
}
