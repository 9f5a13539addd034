//! `selvedge_core::elementary::contact` and `selvedge_core::kernels::exact::touches` agree with the oracle for every finite
//! pair.

use crate::support::prelude::*;
use crate::support::widths::at_the_limit_of_a_width;
use selvedge_core::elementary::ContactVerdict;
use selvedge_core::elementary::contact::contact_and_evidence;
use selvedge_core::kernels::exact::{self, Evidence};

/// Returns the verdict in integers alone, or `None` if a coordinate is not finite.
fn touches<S: Format>(pair: &PairCase<S>) -> Option<bool> {
    exact::touches(&pair.pair())
}

/// Returns the verdict that tries floating point first.
fn verdict<S: Format>(pair: &PairCase<S>) -> (ContactVerdict, Evidence) {
    contact_and_evidence(&pair.pair())
}

/// Returns the verdict that belongs to the verdict in integers.
fn as_contact(touches: Option<bool>) -> ContactVerdict {
    match touches {
        Some(true) => ContactVerdict::Happens,
        Some(false) => ContactVerdict::Never,
        None => ContactVerdict::Undefined,
    }
}

/// Checks that both give the expected verdict.
fn both_say<S: Format>(pair: &PairCase<S>, truth: bool) -> TestCaseResult {
    prop_assert_eq!(touches(pair), Some(truth), "in whole numbers");
    prop_assert_eq!(verdict(pair).0, as_contact(Some(truth)));
    Ok(())
}

fn agree_with_the_oracle<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    both_say(pair, collides(&pair.question()).is_some())
}

formats!(verdicts_are_the_oracles is agree_with_the_oracle(6_000, pairs_of_any_kind()));

/// Generates coordinates from 0 to a small number. They give contacts at corners, along edges, at the start and end, and all
/// kinds of degeneration.
fn on_a_grid<S: Format>(choices: &mut Choices<'_>) -> PairCase<S> {
    let (limit, kind) = (choices.pick(&[1_u32, 2, 3, 5, 9]), choices.pick(&PairKind::ALL));
    PairCase::from_coordinates(kind, || S::exact(choices.below(limit + 1).into(), 0))
}

formats!(verdicts_are_the_oracles_on_small_whole_numbers is agree_with_the_oracle(4_000, from_choices(on_a_grid)));

formats!(nothing_overflows_at_the_limit_of_a_width is agree_with_the_oracle(800, from_choices(at_the_limit_of_a_width)));

/// Returns pair number `index` of those with coordinates 0 and 1 on `axes` axes, and 0 on the others.
fn of_bits(kind: PairKind, axes: usize, index: usize) -> PairCase<f64> {
    let coordinate = |point: usize, end: usize, axis: usize| {
        let place = (point * 2 + end) * axes + axis;
        if axis < axes && index >> place & 1 == 1 { 1.0 } else { 0.0 }
    };
    let position = |point, end| [0, 1, 2].map(|axis| coordinate(point, end, axis));
    let points = [0, 1, 2, 3].map(|point| [position(point, 0), position(point, 1)]);
    PairCase::new(kind, points)
}

/// The pairs are all those of points of a square, which are coplanar throughout.
#[test]
fn verdicts_are_the_oracles_on_every_pair_in_a_square() {
    for (kind, index) in PairKind::ALL.iter().flat_map(|&k| (0..1 << 16).map(move |i| (k, i))) {
        let pair = of_bits(kind, 2, index);
        let checked = agree_with_the_oracle(&pair);
        assert!(checked.is_ok(), "{checked:?}\n{pair:?}");
    }
}

/// The pairs are every 257th of points of a cube, of 16,777,216 of each kind.
#[test]
fn verdicts_are_the_oracles_on_pairs_in_a_cube() {
    for kind in PairKind::ALL {
        for index in (0..1 << 24).step_by(257) {
            let pair = of_bits(kind, 3, index);
            let checked = agree_with_the_oracle(&pair);
            assert!(checked.is_ok(), "{checked:?}\n{pair:?}");
        }
    }
}

fn pairs_that_touch_by_construction_do<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    both_say(&moment.pair(), true)
}

formats!(pairs_that_touch_by_construction_do(15_000, touching_pairs()));

fn verdicts_are_the_oracles_for_coplanar_pairs<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    agree_with_the_oracle(&moment.pair())
}

formats!(verdicts_are_the_oracles_for_coplanar_pairs(8_000, coplanar_pairs()));

/// Counts each kind of evidence, so that a property cannot hold without testing anything.
#[test]
fn every_kind_of_evidence_is_given() {
    let counts = [const { Cell::new(0) }; 3];
    check(2_000, pairs_of_any_kind::<f64>(), |pair| {
        let count = match verdict(pair).1 {
            Evidence::Separation => &counts[0],
            Evidence::Crossing => &counts[1],
            Evidence::WholeNumbers => &counts[2],
            Evidence::Nothing => return Err(TestCaseError::fail("finite")),
        };
        count.set(count.get() + 1);
        Ok(())
    });
    let counts = counts.map(|count| count.get());
    assert!(counts.iter().all(|&count| count > 3), "{counts:?}");
}

fn what_is_not_finite_is_undefined<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if pair.is_finite() {
        return agree_with_the_oracle(pair);
    }
    prop_assert_eq!(touches(pair), None);
    prop_assert_eq!(verdict(pair), (ContactVerdict::Undefined, Evidence::Nothing));
    Ok(())
}

formats!(what_is_not_finite_is_undefined(8_000, extraordinary_pairs()));

/// The verdict in integers is the same for a pair that is written in another way.
fn same<S: Format>(pair: &PairCase<S>, changed: &PairCase<S>) -> TestCaseResult {
    let expected = touches(pair);
    prop_assert_eq!(touches(changed), expected, "changed to {:?}", changed);
    prop_assert_eq!(verdict(changed).0, as_contact(expected), "{:?}", changed);
    Ok(())
}

fn rewriting_changes_no_verdict<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    same(pair, &pair.reversed())?;
    for axis in 0..3 {
        let mirrored = pair.with_positions(|mut position| {
            position[axis] = -position[axis];
            position
        });
        same(pair, &mirrored)?;
    }
    for axes in [[1, 2, 0], [1, 0, 2]] {
        same(pair, &pair.with_axes(axes))?;
    }
    let orders: &[[usize; 4]] = match pair.kind {
        PairKind::VertexFace => &[[0, 2, 3, 1], [0, 3, 1, 2], [0, 2, 1, 3]],
        PairKind::EdgeEdge => &[[2, 3, 0, 1], [1, 0, 2, 3], [0, 1, 3, 2], [3, 2, 0, 1]],
    };
    orders.iter().try_for_each(|&order| same(pair, &pair.reordered(order)))
}

formats!(rewriting_changes_no_verdict(2_400, pairs_of_any_kind()));

fn scaling_by_powers_of_two_changes_no_verdict<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    // Scales each axis by its own factor: coplanar points, and points in triangles, stay so.
    for exponents in [[40, 40, 40], [-30, -30, -30], [7, -20, 60]] {
        let factors = exponents.map(|exponent| S::exact(1, exponent));
        let by = |x: [S; 3], factors: [S; 3]| [0, 1, 2].map(|axis| x[axis] * factors[axis]);
        let scaled = pair.with_positions(|x| by(x, factors));
        let inverses = exponents.map(|exponent| S::exact(1, -exponent));
        if scaled.is_finite() && scaled.with_positions(|x| by(x, inverses)) == *pair {
            same(pair, &scaled)?;
        }
    }
    Ok(())
}

formats!(scaling_by_powers_of_two_changes_no_verdict(1_200, pairs_of_any_kind()));

// Each verdict is right in any case. This also checks which pairs floating point decides; that may differ.
fn verdicts_are_the_same_in_every_floating_point_environment<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let answers = |pair: &PairCase<S>| (touches(pair), verdict(pair).0);
    let expected = answers(pair);
    for environment in Environment::all() {
        let answers = environment.run(pair, answers);
        prop_assert_eq!(answers, expected, "{:?}", environment);
    }
    Ok(())
}

formats!(verdicts_are_the_same_in_every_floating_point_environment(
    600,
    pairs_of_any_kind()
));

#[test]
fn the_same_numbers_in_f64_have_the_same_verdict() {
    check(20_000, pairs_of_any_kind::<f32>(), |pair| {
        prop_assert_eq!(touches(pair), touches(&pair.widened()));
        prop_assert_eq!(verdict(pair).0, verdict(&pair.widened()).0);
        Ok(())
    });
}

/// A vertex that grazes a border point of a face of the largest size, or misses it by the smallest number.
fn decides_the_largest_spread_there_is<S: Format>() {
    let (small, large) = (S::ZERO.up(), S::LARGEST);
    for (height, happens) in [(S::ZERO, true), (small, false), (-small, false)] {
        let face = [[-large, -large], [large, -large], [small, large]];
        let [a, b, c] = face.map(|[x, y]| [[x, y, S::ZERO], [x, y, S::ZERO]]);
        let vertex = [[small, large, height], [small, S::ZERO, height]];
        let pair = PairCase::new(PairKind::VertexFace, [vertex, a, b, c]);
        for axes in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
            let pair = pair.with_axes(axes);
            let checked = both_say(&pair, happens);
            assert!(checked.is_ok(), "{checked:?}\n{pair:?}");
        }
    }
}

formats!(decides_the_largest_spread_there_is);
