//! No certified test culls a pair that touches (or is coplanar), in any rounding direction, with subnormal numbers kept or
//! flushed. The compiled code runs with the control register set accordingly.

use crate::support::prelude::*;
use selvedge_core::batch::{BatchTest, Test, Tile, culled_from_tiles};
use selvedge_verification::culling;
use std::hint::black_box;

const BOX_TESTS: [Test; 3] = [Test::SweptBoxes, Test::SegmentBox, Test::RelativeBoxes];

/// Returns every certified test that culls the pair, one by one, and in batches on every level.
fn culling<S: Format>(pair: &PairCase<S>, touches: bool) -> Vec<String> {
    let mut culling = Vec::new();
    let mut note = |culls: bool, name: &dyn Fn() -> String| {
        if culls {
            culling.push(name());
        }
    };
    let (kind, primitives) = (pair.kind, pair.pair());
    let mut tile = Tile::unknown();
    tile.set(5, pair.motions());
    for tier in Tier::ALL {
        let filter = Filter::<S>::new(tier);
        note(filter.verdict(&primitives).is_culled(), &|| format!("{tier:?}"));
        for (name, level) in available_levels() {
            let culled = batch_culls(level, kind, filter, &tile);
            note(culled, &|| format!("{tier:?} on {name}"));
        }
    }
    if touches {
        for test in CertifiedTest::ALL {
            note(culling::verdict(test, pair).is_culled(), &|| format!("{test:?}"));
        }
        for test in BOX_TESTS {
            for (name, level) in available_levels() {
                let culled = batch_culls(level, kind, test, &tile);
                note(culled, &|| format!("{test:?} on {name}"));
            }
        }
    }
    culling
}

fn batch_culls<S: Format>(level: Level, kind: PairKind, test: impl BatchTest<S>, tile: &Tile<S>) -> bool {
    let mut masks = [0];
    culled_from_tiles(level, kind, test, std::slice::from_ref(tile), &mut masks);
    masks != [0]
}

pub(crate) fn nothing_culls<S: Format>(pair: &PairCase<S>, touches: bool) -> TestCaseResult {
    for environment in Environment::all() {
        let culling = environment.run(pair, |pair| culling(pair, touches));
        prop_assert!(culling.is_empty(), "{environment:?}: culled by {culling:?}");
    }
    Ok(())
}

/// Makes a pair of the generator, scaled so that differences or products of two or three are subnormal, or so large that overflow
/// is possible.
fn at_the_limits<S: Format>(meeting: Meeting, choices: &mut Choices<'_>) -> PairCase<S> {
    let kind = choices.pick(&PairKind::ALL);
    let pair = MeetingPair::<S>::choose(kind, meeting, choices).pair();
    let largest = pair.coordinates().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
    if largest == 0.0 {
        return pair;
    }
    let precision = S::PRECISION.cast_signed();
    let near = choices.within(24) as i32;
    let lowest = S::MIN_EXPONENT + precision;
    let wanted = match choices.below(6) {
        0 => lowest + near,
        1 => lowest / 2 + near,
        2 => lowest / 3 + near,
        // The range of the filters, 2³⁰ or 2²⁵⁰, and the sizes at which volumes overflow.
        3 => (if precision == 24 { 30 } else { 250 }) + near / 4,
        4 => S::MAX_EXPONENT / 3 + near,
        _ => S::MAX_EXPONENT - 4 + near.min(0),
    };
    let by = wanted - (largest.log2().floor() as i32);
    // The scale is exact, so the pair still meets: no digit may fall below the smallest subnormal number, or beyond the largest.
    let moved = pair.map(|x| scaled(x, by));
    let back = moved.map(|x| scaled(x, -by));
    if moved.is_finite() && back == pair { moved } else { pair }
}

/// Returns `x`·2^`exponent`, rounded at most once, at the end.
fn scaled<S: Format>(x: S, exponent: i32) -> S {
    let steps = [exponent / 3, exponent / 3, exponent - 2 * (exponent / 3)];
    S::from_f64(steps.iter().fold(x.to_f64(), |x, &step| x * 2.0_f64.powi(step)))
}

fn touching_pairs_are_kept_in_every_environment<S: Format>() {
    check(400, touching_pairs::<S>(), |moment| nothing_culls(&moment.pair(), true));
    let limits = from_choices(|choices| at_the_limits::<S>(Meeting::Touching, choices));
    check(800, limits, |pair| nothing_culls(pair, true));
}

formats!(touching_pairs_are_kept_in_every_environment);

fn coplanar_pairs_are_kept_in_every_environment<S: Format>() {
    check(400, coplanar_pairs::<S>(), |moment| nothing_culls(&moment.pair(), false));
    let limits = from_choices(|choices| at_the_limits::<S>(Meeting::Coplanar, choices));
    check(800, limits, |pair| nothing_culls(pair, false));
}

formats!(coplanar_pairs_are_kept_in_every_environment);

fn what_is_not_finite_is_kept_in_every_environment<S: Format>() {
    check(800, extraordinary_pairs::<S>(), |pair| {
        if pair.is_finite() {
            return Ok(());
        }
        nothing_culls(pair, true)
    });
}

formats!(what_is_not_finite_is_kept_in_every_environment);

#[test]
fn environments_are_really_set() {
    let sum = |[a, b]: &[f32; 2]| black_box(*a) + black_box(*b);
    let product = |[a, b]: &[f32; 2]| black_box(*a) * black_box(*b);
    let small = f32::EPSILON / 4.0;
    let subnormal = f32::MIN_POSITIVE / 2.0;
    for environment in Environment::all() {
        let name = format!("{environment:?}");
        let above = environment.run(&[1.0, small], sum);
        assert_eq!(above > 1.0, name.contains("upward"), "{name}");
        let below = environment.run(&[1.0, -small], sum);
        let goes_down = name.contains("downward") || name.contains("towards zero");
        assert_eq!(below < 1.0, goes_down, "{name}");
        let result = environment.run(&[f32::MIN_POSITIVE, 0.5], product);
        assert_eq!(result == 0.0, name.contains("flush"), "{name}");
        // One operand is subnormal.
        let doubled = environment.run(&[subnormal, 2.0], product);
        assert_eq!(doubled == 0.0, name.contains("denormals"), "{name}");
    }
    // The environment is restored.
    assert_eq!(sum(&[1.0, small]), 1.0);
}

/// A vertex at rest above a triangle at rest, by that height. The separation is larger and subnormal; it compares as zero if
/// subnormal numbers are flushed.
fn keeps_within_a_subnormal_separation<S: Format>(height: S, separation: S) {
    let o = S::ZERO;
    let face = [[o, o, o], [S::ONE, o, o], [o, S::ONE, o]];
    let pair = PairCase {
        kind: PairKind::VertexFace,
        points: [[o, o, height], face[0], face[1], face[2]].map(|position| [position; 2]),
    };
    for tier in Tier::ALL {
        let filter = Filter::new(tier).with_separation(separation);
        let filter = filter.expect("finite and not negative");
        let verdict = Environment::FLUSHING.run(&pair, |pair| filter.verdict(&pair.pair()));
        assert!(!verdict.is_culled(), "{tier:?}");
    }
}

#[test]
fn a_subnormal_separation_counts_when_flushing() {
    keeps_within_a_subnormal_separation(3e-39_f32, 4e-39);
    keeps_within_a_subnormal_separation(3e-310_f64, 4e-310);
}

/// Two edges on one line, one inside the other, with coordinates of a few times the smallest subnormal number. A compiler added
/// zero to the compared values, to use one vector operation for them and the sums beside them: see "compilers" in `boxes`.
fn keeps_edges_of_dust_on_one_line<S: Format>() {
    let at = |height: i64| [[S::ZERO, S::ZERO, S::exact(height, S::MIN_EXPONENT)]; 2];
    let pair = PairCase::new(PairKind::EdgeEdge, [at(-4), at(8), at(3), at(2)]);
    assert!(collides(&pair.question()).is_some());
    nothing_culls(&pair, true).expect("kept");
}

formats!(keeps_edges_of_dust_on_one_line);
