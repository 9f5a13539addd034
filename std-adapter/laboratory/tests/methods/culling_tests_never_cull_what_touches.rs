//! No certified culling test of the laboratory culls a pair that touches, and nine directions cull exactly what their definition
//! says.

use proptest::prelude::*;
use selvedge_core::PairKind;
use selvedge_laboratory::baselines::nine_directions::separated;
use selvedge_laboratory::methods::CullingTest;
use selvedge_verification::formats;
use selvedge_verification::generator::{
    Format, PairCase, check, extraordinary_pairs, from_choices, pairs_of_any_kind, touching_pairs,
};
use selvedge_verification::oracle::collides;

fn culling<S: Format>(pair: &PairCase<S>) -> Vec<CullingTest> {
    let culls = |test: &CullingTest| test.is_certified() && test.culls(&pair.pair());
    CullingTest::ALL.into_iter().filter(culls).collect()
}

fn certified_tests_are_right<S: Format>() {
    check(10_000, pairs_of_any_kind::<S>(), |pair| {
        let culling = culling(pair);
        prop_assert!(
            culling.is_empty() || collides(&pair.question()).is_none(),
            "culled by {culling:?}"
        );
        Ok(())
    });
    check(10_000, touching_pairs::<S>(), |moment| {
        prop_assert_eq!(culling(&moment.pair()), []);
        Ok(())
    });
    check(5_000, extraordinary_pairs::<S>(), |pair| {
        prop_assert!(pair.is_finite() || culling(pair).is_empty());
        Ok(())
    });
}

formats!(certified_tests_are_right);

/// Small integers, whose sums do not round.
#[test]
fn nine_directions_are_exact_where_sums_are() {
    const DIRECTIONS: [[i64; 3]; 9] = [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
        [1, 1, 0],
        [1, -1, 0],
        [1, 0, 1],
        [1, 0, -1],
        [0, 1, 1],
        [0, 1, -1],
    ];
    let small = from_choices(|choices| {
        let kind = choices.pick(&PairKind::ALL);
        let limit = choices.pick(&[2, 5, 100]);
        PairCase::<f64>::from_coordinates(kind, || choices.within(limit) as f64)
    });
    check(4_000, small, |pair| {
        let [one, other] = pair.sets();
        let keeps_order = |direction: &[i64; 3]| {
            let height = |x: [f64; 3]| x.into_iter().zip(direction).map(|(x, &d)| x * d as f64).sum::<f64>();
            let below = |low: &[[[f64; 3]; 2]], high: &[[[f64; 3]; 2]], end: usize| {
                low.iter()
                    .all(|low| high.iter().all(|high| height(low[end]) < height(high[end])))
            };
            [(one, other), (other, one)]
                .iter()
                .any(|&(low, high)| below(low, high, 0) && below(low, high, 1))
        };
        prop_assert_eq!(separated(&pair.pair()).is_culled(), DIRECTIONS.iter().any(keeps_order));
        Ok(())
    });
}
