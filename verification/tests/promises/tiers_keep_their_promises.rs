//! The promises of each tier of the non-coplanarity filter for one pair at a time: the pairs that it never culls, in any
//! arrangement of their points, and which of two tiers culls more.

use crate::support::distance::distance;
use crate::support::prelude::*;
use crate::support::rationals::separations;
use selvedge_verification::culling::CertifiedTest::CertifiedNonCoplanarity;
use selvedge_verification::oracle::InRationals;

fn filter_culls<S: Format>(filter: Filter<S>, pair: &PairCase<S>) -> bool {
    filter.verdict(&pair.pair()).is_culled()
}

fn culls<S: Format>(tier: Tier, pair: &PairCase<S>) -> bool {
    filter_culls(Filter::new(tier), pair)
}

fn culls_beyond<S: Format>(tier: Tier, separation: S, pair: &PairCase<S>) -> bool {
    let filter = Filter::new(tier).with_separation(separation);
    filter_culls(filter.expect("a length"), pair)
}

/// Checks that no tier culls the pair wrongly. The oracle runs at most once, and only if a tier culls it.
fn nothing_culls_what_it_must_not<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let culling: Vec<_> = Tier::ALL.into_iter().filter(|&tier| culls(tier, pair)).collect();
    if !culling.is_empty() {
        let question = pair.question();
        let coplanar = are_ever_coplanar(&question.start, &question.end);
        prop_assert!(!coplanar, "coplanar, culled by {culling:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_the_oracle_calls_coplanar is nothing_culls_what_it_must_not(100_000, pairs_of_any_kind()));

formats!(nothing_certified_culls_a_graze is nothing_culls_what_it_must_not(8_000, grazes_of_a_box()));

fn nothing_certified_culls_what_is_not_finite<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if pair.is_finite() {
        return nothing_culls_what_it_must_not(pair);
    }
    for tier in Tier::ALL {
        prop_assert!(!culls(tier, pair), "{tier:?}");
        prop_assert!(!culls_beyond(tier, S::ONE, pair), "{tier:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_is_not_finite(40_000, extraordinary_pairs()));

fn nothing_certified_culls_what_is_built_to_meet<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair();
    for tier in Tier::ALL {
        prop_assert!(!culls(tier, &pair), "{tier:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_is_built_to_touch is nothing_certified_culls_what_is_built_to_meet(25_000, touching_pairs()));

formats!(nothing_certified_culls_what_is_built_to_be_coplanar is nothing_certified_culls_what_is_built_to_meet(25_000, coplanar_pairs()));

fn exact_culls_exactly_when_the_rational_control_values_have_one_sign<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let one_sign = InRationals::new(pair).have_one_sign();
    prop_assert_eq!(culls(Tier::Exact, pair), one_sign);
    Ok(())
}

formats!(exact_culls_exactly_when_the_rational_control_values_have_one_sign(
    8_000,
    pairs_of_any_kind()
));

/// Returns lengths of the pair's own size, large and small.
fn lengths<S: Format>(pair: &PairCase<S>) -> Vec<S> {
    let [[x, y, _], [z, ..]] = pair.points[1];
    let [[x2, ..], _] = pair.points[2];
    let fine = S::exact(1, -10);
    vec![x.abs(), y.abs() * fine, (z - x2).abs().made_finite(), fine]
}

fn sharper_tiers_cull_whatever_others_cull<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    for separation in lengths(pair).into_iter().chain([S::ZERO]) {
        let culled = [Tier::Permanent, Tier::Widened, Tier::Exact].map(|tier| culls_beyond(tier, separation, pair));
        prop_assert!(culled.is_sorted(), "{culled:?} by {separation}");
    }
    Ok(())
}

formats!(sharper_tiers_cull_whatever_others_cull(40_000, pairs_of_any_kind()));

fn a_larger_separation_never_culls_more_and_none_is_zero<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let mut lengths = lengths(pair);
    lengths.extend([S::ZERO, -S::ZERO, S::ZERO.up(), S::LARGEST]);
    lengths.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    for tier in Tier::ALL {
        let culled: Vec<_> = lengths.iter().map(|&length| culls_beyond(tier, length, pair)).collect();
        prop_assert!(culled.is_sorted_by(|a, b| a >= b), "{tier:?}: {culled:?}");
        prop_assert_eq!(culls_beyond(tier, S::ZERO, pair), culls(tier, pair));
        prop_assert_eq!(culls_beyond(tier, -S::ZERO, pair), culls(tier, pair));
    }
    Ok(())
}

formats!(a_larger_separation_never_culls_more_and_none_is_zero(
    20_000,
    pairs_of_any_kind()
));

/// The promise is about the plane of the face and the lines of the edges, whose distance is at most that of the sets. The
/// separations are those at which the rational control values change their answer, where the tiers must err to the safe side.
fn nothing_certified_culls_what_comes_within_the_separation<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let exact = InRationals::new(pair);
    for separation in separations(pair, &exact) {
        let culling: Vec<_> = Tier::ALL
            .into_iter()
            .filter(|&tier| culls_beyond(tier, separation, pair))
            .collect();
        if culling.is_empty() {
            continue;
        }
        let within = within(&pair.question(), separation.to_f64());
        prop_assert!(!within, "{culling:?} by {separation}");
        for tier in culling {
            prop_assert!(
                exact.are_beyond(&rational(separation)),
                "{tier:?} by {separation}, nearer to the plane or the line"
            );
        }
    }
    Ok(())
}

formats!(nothing_certified_culls_what_comes_within_the_separation(
    600,
    pairs_of_any_kind()
));

/// The separation is slightly more than the distance at some time in floating point, so that the pair certainly comes within it,
/// or slightly less.
fn nothing_certified_culls_beyond_the_distance_at_a_time<S: Format>() {
    let culled = std::cell::Cell::new(0);
    check(20_000, pairs_of_any_kind::<S>(), |pair| {
        if pair.coordinates().any(|x| x.abs() > S::exact(1 << 10, 0)) {
            return Ok(());
        }
        let question = pair.question();
        for part in 0..=8 {
            let separation = S::from_f64(distance(&question, f64::from(part) / 8.0));
            for separation in [separation.nudged(2), separation.nudged(-40).abs()] {
                let culling: Vec<_> = Tier::ALL
                    .into_iter()
                    .filter(|&tier| culls_beyond(tier, separation, pair))
                    .collect();
                if !culling.is_empty() {
                    culled.set(culled.get() + 1);
                    let within = within(&question, separation.to_f64());
                    prop_assert!(!within, "{culling:?} by {separation}");
                }
            }
        }
        Ok(())
    });
    assert!(culled.get() > 100, "{culled:?} culled: nothing was tested");
}

formats!(nothing_certified_culls_beyond_the_distance_at_a_time);

fn a_separation_that_is_no_length_is_refused<S: Format>() {
    for tier in Tier::ALL {
        for no_length in [S::NAN, -S::NAN, S::INFINITY, -S::INFINITY, -S::ONE, -S::ZERO.up()] {
            assert_eq!(Filter::new(tier).with_separation(no_length), None);
        }
        for length in [S::ZERO, S::ONE, S::LARGEST] {
            let filter = Filter::new(tier).with_separation(length);
            assert_eq!(filter.map(|filter| filter.separation()), Some(length));
        }
        // A subnormal separation counts as the smallest normal number, never as less.
        let filter = Filter::new(tier).with_separation(S::ZERO.up());
        assert!(filter.is_some_and(|filter| filter.separation() > S::ZERO.up()));
    }
}

formats!(a_separation_that_is_no_length_is_refused);

fn certified_culls<S: Format>(pair: &PairCase<S>) -> bool {
    verdict(CertifiedNonCoplanarity, pair).is_culled()
}

/// Each point may be the base of the volume, and each axis may come first: every arrangement rounds differently.
fn never_culls_a_coplanar_pair_in_any_arrangement<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair();
    let four = (0..256_usize).map(|code| [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6]);
    for order in four.filter(|order| order.iter().fold(0, |seen, point| seen | 1 << point) == 0b1111) {
        let arranged = pair.reordered(order);
        for axes in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let arranged = arranged.with_axes(axes);
            prop_assert!(!certified_culls(&arranged), "{arranged:?}");
        }
    }
    Ok(())
}

formats!(never_culls_a_coplanar_pair_in_any_arrangement(20_000, coplanar_pairs()));

/// If a computed control value is above its bound, the exact one is at least about one unit roundoff of f32 times its permanent.
/// This is far above the bound of f64. (To nearest, at most 7 of the 16 in the bound are needed, and at most 9 of the 20.)
#[test]
fn what_the_f32_filter_culls_the_f64_filter_culls_too() {
    check(300_000, pairs_of_any_kind::<f32>(), |pair| {
        prop_assert!(!certified_culls(pair) || certified_culls(&pair.widened()));
        Ok(())
    });
}
