//! The baseline filters give sixteen pairs at a time the verdicts that they give one by one, on every instruction set of this
//! machine.

use proptest::prelude::*;
use selvedge::simd::available_levels;
use selvedge_core::batch::{BatchTest, ByPoints, ByVolume, LANES, culled};
use selvedge_core::{PairKind, PrimitivePair};
use selvedge_laboratory::baselines::as_computed::AsComputed;
use selvedge_laboratory::baselines::nine_directions::{self, NineDirections};
use selvedge_laboratory::baselines::plain::{Plain, non_coplanarity};
use selvedge_verification::formats;
use selvedge_verification::generator::{Format, PairCase, check, config, pairs};

fn agrees<S: Format>(
    cases: &[PairCase<S>],
    test: impl BatchTest<S>,
    one_by_one: impl Fn(&PrimitivePair<S>) -> bool,
) -> Result<(), TestCaseError> {
    let pairs: Vec<_> = cases.iter().map(PairCase::pair).collect();
    for (name, level) in available_levels() {
        let mut masks = vec![0; pairs.len().div_ceil(LANES)];
        culled(level, test, &pairs, &mut masks);
        for (k, pair) in pairs.iter().enumerate() {
            prop_assert_eq!(
                masks[k / LANES] >> (k % LANES) & 1 == 1,
                one_by_one(pair),
                "{} {:?}",
                name,
                cases[k]
            );
        }
    }
    Ok(())
}

fn baselines_agree<S: Format>() {
    PairKind::ALL.into_iter().for_each(baselines_agree_on::<S>);
}

formats!(baselines_agree);

fn baselines_agree_on<S: Format>(kind: PairKind) {
    proptest!(config(256), |(cases in prop::collection::vec(pairs::<S>(kind), 0..40), scale in 0..24_i32)| {
        agrees(&cases, ByPoints(NineDirections), |pair| nine_directions::separated(pair).is_culled())?;
        agrees(&cases, ByPoints(Plain), |pair| non_coplanarity(pair).is_culled())?;
        let as_computed = AsComputed::<S>::new();
        let separated = as_computed.with_separation(S::exact(1, -scale)).expect("a length");
        for filter in [as_computed, separated] {
            agrees(&cases, ByVolume(filter), |pair| filter.verdict(pair).is_culled())?;
        }
    });
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
