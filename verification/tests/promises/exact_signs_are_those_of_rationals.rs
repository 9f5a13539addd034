//! `selvedge_core::kernels::exact` agrees with rational arithmetic for every finite pair.

use crate::support::prelude::*;
use crate::support::rationals::separations;
use crate::support::widths::at_the_limit_of_a_width;
use selvedge_core::kernels::exact::{
    KnownSigns, UNKNOWN, certain_signs, control_value_signs, is_never_coplanar, is_never_within,
};
use selvedge_verification::oracle::InRationals;
use std::cmp::Ordering::{self, Equal, Greater, Less};

fn signs<S: Format>(pair: &PairCase<S>) -> Option<[Ordering; 4]> {
    control_value_signs(&pair.pair())
}

fn never_coplanar<S: Format>(pair: &PairCase<S>, known: KnownSigns) -> bool {
    is_never_coplanar(&pair.pair(), known)
}

fn never_within<S: Format>(pair: &PairCase<S>, separation: S, known: KnownSigns) -> bool {
    is_never_within(&pair.pair(), separation, known)
}

fn signs_are_those_of_rationals<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    prop_assert_eq!(signs(pair), Some(InRationals::new(pair).signs()));
    Ok(())
}

formats!(signs_are_those_of_rationals(8_000, pairs_of_any_kind()));

formats!(nothing_overflows_at_the_limit_of_a_width is signs_are_those_of_rationals(2_000, from_choices(at_the_limit_of_a_width)));

fn never_coplanar_means_one_sign_whatever_is_known_before<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let signs = signs(pair).expect("finite");
    let one_sign = [[Greater; 4], [Less; 4]].contains(&signs);
    for subset in 0..16 {
        let known = [0, 1, 2, 3].map(|i| (subset >> i & 1 == 1).then_some(signs[i]));
        prop_assert_eq!(never_coplanar(pair, known), one_sign, "{:?}", known);
        prop_assert_eq!(never_within(pair, S::ZERO, known), one_sign);
        prop_assert_eq!(never_within(pair, -S::ZERO, known), one_sign);
    }
    // What is known is not computed again, even if it is wrong.
    for i in 0..4 {
        for claimed in [Less, Equal, Greater] {
            let mut known = [Some(claimed); 4];
            known[i] = None;
            let expected = claimed.is_ne() && signs[i] == claimed;
            prop_assert_eq!(never_coplanar(pair, known), expected, "{:?}", known);
        }
    }
    for no_length in [S::NAN, -S::NAN, S::INFINITY, -S::INFINITY, -S::ONE, -S::ZERO.up()] {
        prop_assert!(!never_within(pair, no_length, UNKNOWN), "{no_length:?}");
    }
    Ok(())
}

formats!(never_coplanar_means_one_sign_whatever_is_known_before(
    8_000,
    pairs_of_any_kind()
));

fn signs_that_rounding_cannot_change_are_the_exact_ones<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let tetrahedron = pair.tetrahedron();
    if !is_in_range(tetrahedron.largest_by_axis().largest()) {
        return Ok(());
    }
    let known = certain_signs(&tetrahedron.control_values(), tetrahedron.error_bounds());
    let signs = signs(pair).expect("finite");
    for i in 0..4 {
        prop_assert!(known[i].is_none_or(|sign| sign == signs[i]), "{:?}", known);
    }
    let all_known = [[Some(Greater); 4], [Some(Less); 4]].contains(&known);
    let certified = verdict(CertifiedTest::CertifiedNonCoplanarity, pair);
    prop_assert!(!all_known || certified.is_culled());
    Ok(())
}

formats!(signs_that_rounding_cannot_change_are_the_exact_ones(
    40_000,
    pairs_of_any_kind()
));

fn what_is_not_finite_has_no_signs_and_is_kept<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    prop_assert_eq!(signs(pair).is_some(), pair.is_finite());
    if !pair.is_finite() {
        prop_assert!(!never_coplanar(pair, UNKNOWN));
        prop_assert!(!never_within(pair, S::ZERO, UNKNOWN));
        prop_assert!(!never_coplanar(pair, [None, Some(Less), Some(Less), Some(Less)]));
    }
    Ok(())
}

formats!(what_is_not_finite_has_no_signs_and_is_kept(8_000, extraordinary_pairs()));

fn reversed(signs: [Ordering; 4]) -> [Ordering; 4] {
    signs.map(Ordering::reverse)
}

/// Mirroring, and exchanging two axes or two points, reverses the signs; reversing time reverses their order.
fn signs_follow_the_order<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let opposite = signs(pair).map(reversed);
    for axis in 0..3 {
        let mirrored = pair.with_positions(|mut position| {
            position[axis] = -position[axis];
            position
        });
        prop_assert_eq!(signs(&mirrored), opposite);
    }
    for axes in [[1, 0, 2], [0, 2, 1], [2, 1, 0]] {
        prop_assert_eq!(signs(&pair.with_axes(axes)), opposite);
    }
    for [i, j] in [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]] {
        let mut order = [0, 1, 2, 3];
        order.swap(i, j);
        prop_assert_eq!(signs(&pair.reordered(order)), opposite, "{:?}", order);
    }
    let backwards = signs(&pair.reversed()).map(|[a, b, c, d]| [d, c, b, a]);
    prop_assert_eq!(signs(pair), backwards);
    Ok(())
}

formats!(signs_follow_the_order(8_000, pairs_of_any_kind()));

#[test]
fn the_same_numbers_in_f64_have_the_same_signs() {
    check(40_000, pairs_of_any_kind::<f32>(), |pair| {
        prop_assert_eq!(signs(pair), signs(&pair.widened()));
        Ok(())
    });
}

fn is_right_to_a_relative_2_to_the_minus_60<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let exact = InRationals::new(pair);
    let slack = Rational::from(1) + (Rational::from(1) >> 60);
    for separation in separations(pair, &exact) {
        let culled = never_within(pair, separation, UNKNOWN);
        let length = rational(separation);
        prop_assert!(!culled || exact.are_beyond(&length), "{separation:?}");
        let certainly = exact.are_beyond(&(length * &slack));
        prop_assert!(culled || !certainly, "{separation:?}");
    }
    Ok(())
}

formats!(never_within_is_right_to_a_relative_2_to_the_minus_60 is is_right_to_a_relative_2_to_the_minus_60(4_000, pairs_of_any_kind()));

/// The property above found this pair: the face turns so that one of the normals between start and end is zero.
#[test]
fn never_within_is_right_where_a_middle_normal_is_zero_and_its_control_value_is_not() {
    let pair = PairCase::<f64>::new(
        PairKind::VertexFace,
        [
            [[0.0, -1.0, 0.0]; 2],
            [[-1.0, 0.0, 0.0], [-1.0, 1.0, 1.0]],
            [[1.0, 1.0, 0.0], [-1.0, 0.0, -1.0]],
            [[0.0, 1.0, 1.0], [1.0, 1.0, -1.0]],
        ],
    );
    is_right_to_a_relative_2_to_the_minus_60(&pair).expect("right");
}

fn never_culls_what_the_oracle_calls_within<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let exact = InRationals::new(pair);
    for separation in separations(pair, &exact) {
        if never_within(pair, separation, UNKNOWN) {
            prop_assert!(!within(&pair.question(), separation.to_f64()), "{separation:?}");
        }
    }
    Ok(())
}

formats!(never_culls_what_the_oracle_calls_within(800, pairs_of_any_kind()));

/// In this unit a high power of two is 1, and the exponent of the unit is below those of all numbers of the format.
#[test]
fn the_unit_of_large_powers_of_two_is_their_own() {
    let large = f64::exact(1 << 40, 960);
    let corners = [[0.0; 3], [large, 0.0, 0.0], [0.0, large / 2.0, 0.0]];
    let [a, b, c] = corners.map(|corner| [corner; 2]);
    let pair = PairCase::new(PairKind::VertexFace, [[[0.0, 0.0, 1.0]; 2], a, b, c]);
    assert!(never_within(&pair, 1.0.down(), UNKNOWN));
    assert!(!never_within(&pair, 1.0, UNKNOWN));
    // The second pair has another unit for each axis.
    let pair = pair.with_axes([2, 0, 1]);
    assert!(never_within(&pair, 1.0.down(), UNKNOWN));
    assert!(!never_within(&pair, 1.0, UNKNOWN));
}

/// A vertex is at the smallest height above a face of the largest size: 2,098 and 277 bits along each axis.
fn decides_the_largest_spread_there_is<S: Format>() {
    let (small, large) = (S::ZERO.up(), S::LARGEST);
    let corner = |x: S, y: S| [[x, y, -small]; 2];
    for (height, sign) in [(S::ZERO, Greater), (-small, Equal), (-small.up(), Less)] {
        let vertex = [[small, small, height]; 2];
        let pair = PairCase::new(
            PairKind::VertexFace,
            [vertex, corner(-large, -large), corner(large, -large), corner(small, large)],
        );
        assert_eq!(signs(&pair), Some([sign; 4]), "{pair:?}");
        let along_x = pair.with_axes([2, 0, 1]);
        assert_eq!(signs(&along_x), Some([sign; 4]), "{along_x:?}");
        assert!(!never_within(&pair, S::ZERO.up(), UNKNOWN), "{pair:?}");
    }
}

formats!(decides_the_largest_spread_there_is);

fn answers_are_the_same_in_every_floating_point_environment<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let [[x, ..], _] = pair.points[1];
    let separation = x.abs();
    let answers = |pair: &PairCase<S>| (signs(pair), never_within(pair, separation, UNKNOWN));
    let expected = answers(pair);
    for environment in Environment::all() {
        let answers = environment.run(pair, answers);
        prop_assert_eq!(answers, expected, "{:?}", environment);
    }
    Ok(())
}

formats!(answers_are_the_same_in_every_floating_point_environment(
    8_000,
    pairs_of_any_kind()
));
