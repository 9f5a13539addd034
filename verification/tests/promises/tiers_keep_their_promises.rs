//! The promises of each tier for one pair at a time: the pairs that it never culls, and which of two tiers culls more.

use crate::support::distance::distance;
use crate::support::rationals::separations;
use proptest::prelude::*;
use selvedge_core::PairKind;
use selvedge_core::filter::{Filter, Tier};
use selvedge_verification::altered::{Factors, Kernel};
use selvedge_verification::formats;
use selvedge_verification::generator::{
    Format, Moment, PairCase, check, coplanar_pairs, extraordinary_pairs, grazes_of_a_box, pairs_of_any_kind, touching_pairs,
};
use selvedge_verification::oracle::{InRationals, collides, coplanar, rational, within};

/// Error bounds of zero.
struct NoBounds;

impl Factors for NoBounds {
    const UNIT_ROUNDOFF: f64 = 0.0;
    const UNDERFLOW: f64 = 0.0;
}

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
fn nothing_culls_what_it_must_not<S: Format>(pair: &PairCase<S>) -> Result<(), TestCaseError> {
    let culling: Vec<_> = Tier::ALL.into_iter().filter(|&tier| culls(tier, pair)).collect();
    if !culling.is_empty() {
        let question = pair.question();
        let coplanar = coplanar(&question.start, &question.end);
        prop_assert!(!coplanar, "coplanar, culled by {culling:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_the_oracle_calls_coplanar is nothing_culls_what_it_must_not(100_000, pairs_of_any_kind()));

formats!(nothing_certified_culls_a_graze is nothing_culls_what_it_must_not(8_000, grazes_of_a_box()));

fn nothing_certified_culls_what_is_not_finite<S: Format>(pair: &PairCase<S>) -> Result<(), TestCaseError> {
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

fn nothing_certified_culls_what_is_built_to_touch<S: Format>(moment: &Moment<S>) -> Result<(), TestCaseError> {
    let pair = moment.pair();
    for tier in Tier::ALL {
        prop_assert!(!culls(tier, &pair), "{tier:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_is_built_to_touch(25_000, touching_pairs()));

fn nothing_certified_culls_what_is_built_to_be_coplanar<S: Format>(moment: &Moment<S>) -> Result<(), TestCaseError> {
    let pair = moment.pair();
    for tier in Tier::ALL {
        prop_assert!(!culls(tier, &pair), "{tier:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_is_built_to_be_coplanar(25_000, coplanar_pairs()));

fn exact_culls_exactly_when_the_rational_control_values_have_one_sign<S: Format>(
    pair: &PairCase<S>,
) -> Result<(), TestCaseError> {
    let one_sign = InRationals::new(pair).have_one_sign();
    prop_assert_eq!(culls(Tier::Exact, pair), one_sign);
    Ok(())
}

formats!(exact_culls_exactly_when_the_rational_control_values_have_one_sign(
    8_000,
    pairs_of_any_kind()
));

/// Checks that the second tier culls whatever the first culls, for the given separations and for none.
fn is_at_least_as_sharp<S: Format>(
    pair: &PairCase<S>,
    separations: &[S],
    [tier, sharper]: [Tier; 2],
) -> Result<(), TestCaseError> {
    for &separation in [S::ZERO].iter().chain(separations) {
        prop_assert!(
            !culls_beyond(tier, separation, pair) || culls_beyond(sharper, separation, pair),
            "{tier:?} culls, {sharper:?} does not, by {separation}"
        );
    }
    Ok(())
}

/// Returns lengths of the pair's own size, large and small.
fn lengths<S: Format>(pair: &PairCase<S>) -> Vec<S> {
    let [[x, y, _], [z, ..]] = pair.points[1];
    let [[x2, ..], _] = pair.points[2];
    let fine = S::exact(1, -10);
    vec![x.abs(), y.abs() * fine, (z - x2).abs().made_finite(), fine]
}

fn sharper_tiers_cull_whatever_others_cull<S: Format>(pair: &PairCase<S>) -> Result<(), TestCaseError> {
    use Tier::{Exact, Permanent, Widened};
    let lengths = lengths(pair);
    for pair_of_tiers in [[Permanent, Widened], [Widened, Exact], [Permanent, Exact]] {
        is_at_least_as_sharp(pair, &lengths, pair_of_tiers)?;
    }
    Ok(())
}

formats!(sharper_tiers_cull_whatever_others_cull(40_000, pairs_of_any_kind()));

fn a_larger_separation_never_culls_more_and_none_is_zero<S: Format>(pair: &PairCase<S>) -> Result<(), TestCaseError> {
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
fn nothing_certified_culls_what_comes_within_the_separation<S: Format>(pair: &PairCase<S>) -> Result<(), TestCaseError> {
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

/// Without bounds a filter is wrong here. The vertex rests on a corner of the face, and rounding gives all four control values,
/// which are zero, one sign.
fn uncertified_culls_a_vertex_on_a_corner<S: Format>(pair: &PairCase<S>) {
    assert!(pair.points[1..].contains(&pair.points[0]));
    assert!(collides(&pair.question()).is_some());
    assert!(Kernel::NonCoplanarity.culls::<NoBounds, _>(pair));
    for tier in Tier::ALL {
        assert!(!culls(tier, pair), "{tier:?}");
    }
}

#[test]
fn uncertified_culls_a_vertex_on_a_corner_of_the_face_f32() {
    let resting = |position: [f32; 3]| [position; 2];
    uncertified_culls_a_vertex_on_a_corner(&PairCase::new(
        PairKind::VertexFace,
        [
            resting([13_780.0, 54_168.0, 15_324.0]),
            resting([-13_464.0, -53_076.0, 42_424.0]),
            resting([33_896.0, 12_028.0, -40_416.0]),
            resting([13_780.0, 54_168.0, 15_324.0]),
        ],
    ));
}

#[test]
fn uncertified_culls_a_vertex_on_a_corner_of_the_face_f64() {
    let resting = |position: [f64; 3]| [position; 2];
    let corner = resting([-7_172_806_750_584.0, 25_238_060_115_324.0, -25_166_202_288_376.0]);
    uncertified_culls_a_vertex_on_a_corner(&PairCase::new(
        PairKind::VertexFace,
        [
            corner,
            resting([-3_263_883_216_216.0, 27_459_903_486_776.0, 19_004_056_350_876.0]),
            corner,
            resting([-5_332_277_524_980.0, 23_865_234_970_576.0, 25_235_061_558_840.0]),
        ],
    ));
}
