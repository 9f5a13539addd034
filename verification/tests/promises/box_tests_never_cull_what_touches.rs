//! Box tests never cull a pair that touches, cull exactly the pairs of their definition, and keep numbers that are not finite.

use crate::support::prelude::*;
use selvedge_core::boxes::segment;
use selvedge_verification::culling::CertifiedTest::{RelativeBoxes, SegmentBox, StoredSweptBoxes, SweptBoxes};
use selvedge_verification::oracle::segment_meets_box;

/// This needs no oracle: the pair touches by construction.
fn nothing_certified_culls_a_pair_built_to_touch<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair();
    for test in CertifiedTest::ALL {
        prop_assert!(!verdict(test, &pair).is_culled(), "{test:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_a_pair_built_to_touch(60_000, touching_pairs()));

fn nothing_certified_culls_what_collides<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let culling: Vec<CertifiedTest> = CertifiedTest::ALL
        .into_iter()
        .filter(|&test| verdict(test, pair).is_culled())
        .collect();
    if !culling.is_empty() {
        prop_assert!(collides(&pair.question()).is_none(), "culled by {culling:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_what_collides(25_000, pairs_of_any_kind()));

fn nothing_certified_culls_what_is_not_finite<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if pair.is_finite() {
        return nothing_certified_culls_what_collides(pair);
    }
    for test in CertifiedTest::ALL {
        prop_assert!(!verdict(test, pair).is_culled(), "{test:?}");
    }
    Ok(())
}

formats!(nothing_certified_culls_nan_or_infinity is nothing_certified_culls_what_is_not_finite(15_000, extraordinary_pairs()));

/// Stronger tests cull more, provided that sums are finite, since relative boxes keep all other pairs.
fn stronger_tests_cull_what_weaker_ones_cull<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if !pair.sums_are_finite() {
        return Ok(());
    }
    let culls = |test| verdict(test, pair).is_culled();
    for (weak, strong) in [
        (StoredSweptBoxes, SweptBoxes),
        (SweptBoxes, RelativeBoxes),
        (SweptBoxes, SegmentBox),
    ] {
        prop_assert!(!culls(weak) || culls(strong), "{weak:?} culls, {strong:?} does not");
    }
    Ok(())
}

formats!(stronger_tests_cull_what_weaker_ones_cull(40_000, pairs_of_any_kind()));

type RationalPoint = [Rational; 3];

fn rational<S: Format>(position: [S; 3]) -> RationalPoint {
    position.map(|x| Rational::from_f64(x.to_f64()).expect("finite"))
}

/// Returns whether `direction` · x strictly separates the two sets, in the same order at both ends, from the definition.
fn keeps_order<S: Format>(pair: &PairCase<S>, direction: [i32; 3]) -> bool {
    let first = points_of_first(pair.kind);
    let heights = pair.points.map(|ends| {
        ends.map(|position| {
            let terms = rational(position).into_iter().zip(direction);
            terms.map(|(x, d)| x * d).sum::<Rational>()
        })
    });
    let (one, other) = heights.split_at(first);
    let below = |low: &[[Rational; 2]], high: &[[Rational; 2]]| {
        low.iter()
            .all(|low| high.iter().all(|high| low[0] < high[0] && low[1] < high[1]))
    };
    below(one, other) || below(other, one)
}

const AXES: [[i32; 3]; 3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

fn relative_boxes_are_what_they_say<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let on_an_axis = AXES.iter().any(|&axis| keeps_order(pair, axis));
    let culled = verdict(RelativeBoxes, pair).is_culled();
    prop_assert!(on_an_axis || !culled);
    prop_assert!(culled || !on_an_axis || !pair.sums_are_finite());
    Ok(())
}

formats!(relative_boxes_cull_exactly_on_axes is relative_boxes_are_what_they_say(6_000, pairs_of_any_kind()));

fn swept_bounds<S: Format>(pair: &PairCase<S>) -> [RationalPoint; 2] {
    let all = || pair.points[1..].iter().flatten().copied().map(rational);
    [
        std::array::from_fn(|axis| all().map(|x| x[axis].clone()).min().expect("six")),
        std::array::from_fn(|axis| all().map(|x| x[axis].clone()).max().expect("six")),
    ]
}

fn a_path_that_meets_the_box_is_kept<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if verdict(SegmentBox, pair).is_culled() {
        prop_assert!(!segment_meets_box(&pair.points[0].map(rational), &swept_bounds(pair)));
    }
    Ok(())
}

formats!(a_path_that_meets_the_swept_box_is_kept is a_path_that_meets_the_box_is_kept(40_000, pairs(PairKind::VertexFace)));

formats!(a_path_that_grazes_the_swept_box_is_kept is a_path_that_meets_the_box_is_kept(40_000, grazes_of_a_box()));

/// A corner of the box, its size, the point where the path passes through it, the path's direction, and its length in either
/// direction.
type PathThroughBox = ([i16; 3], [u8; 3], [u8; 3], [i16; 3], [u8; 2]);

/// A path through a chosen point of a chosen edge, corner or face of the box. It touches the box by construction, and rounding
/// may move every product.
fn a_path_through_the_border_of_the_box_is_kept<S: Format>(
    (corner, size, place, direction, times): PathThroughBox,
) -> TestCaseResult {
    let number = |whole: i64| S::exact(whole, -3);
    let [corner, direction] = [corner, direction].map(|x| x.map(i64::from));
    // The point is at most 4 / 4 of the way along each side.
    let through: [i64; 3] = std::array::from_fn(|axis| 4 * corner[axis] + i64::from(size[axis]) * i64::from(place[axis] % 5));
    let path: [[S; 3]; 2] = [-i64::from(times[0]), i64::from(times[1])]
        .map(|time| std::array::from_fn(|axis| number(through[axis] + time * direction[axis])));
    let target = Aabb {
        lower: corner.map(|x| number(4 * x)),
        upper: std::array::from_fn(|axis| number(4 * corner[axis] + 4 * i64::from(size[axis]))),
    };
    let motion = Motion {
        start: path[0].into(),
        end: path[1].into(),
    };
    prop_assert!(!segment::misses(&motion, &target));
    Ok(())
}

/// All of the numbers fit in 24 bits: 18 for the corner, 23 for the path.
fn paths_through_the_border_of_the_box_are_kept<S: Format>() {
    proptest!(config(64 * 256), |(case in any::<PathThroughBox>())| a_path_through_the_border_of_the_box_is_kept::<S>(case)?);
}

formats!(paths_through_the_border_of_the_box_are_kept);

/// Numbers go up to 8 on a grid of 2⁻¹⁰. Let the path miss the box enlarged by 2⁻⁷ on all sides. Then on a cross axis of the box
/// itself s > 2⁻⁷(|d_j| + |d_k|). The error bound is at most 4u·32(|d_j| + |d_k|) + η, which is far less if d is not zero.
/// Otherwise a box axis separates.
fn a_path_clearly_past_the_box_is_culled<S: Format>() {
    let paths = from_choices(|choices| {
        PairCase::<S>::from_coordinates(PairKind::VertexFace, || {
            let whole = (choices.word() % 16_385) as i64 - 8192;
            S::exact(whole, -10)
        })
    });
    let culled = std::cell::Cell::new(0);
    check(10_000, paths, |pair| {
        let [lower, upper] = swept_bounds(pair);
        let margin = Rational::from((1, 128));
        let larger = [lower.map(|x| x - &margin), upper.map(|x| x + &margin)];
        if !segment_meets_box(&pair.points[0].map(rational), &larger) {
            prop_assert!(verdict(SegmentBox, pair).is_culled());
            culled.set(culled.get() + u32::from(!verdict(SweptBoxes, pair).is_culled()));
        }
        Ok(())
    });
    assert!(culled.get() > 10, "cross axes must matter: {culled:?}");
}

formats!(a_path_clearly_past_the_box_is_culled);
