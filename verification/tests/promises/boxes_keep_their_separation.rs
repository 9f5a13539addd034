//! Moving boxes that are made for a separation, and are apart, keep it, in every floating-point environment.

use crate::support::bounds::{largest_accepted, largest_of_all};
use crate::support::prelude::*;
use selvedge_core::boxes::mapping::{Inset, Mapping};
use selvedge_core::boxes::moving::MovingBox;

/// Returns boxes of the pair's two sets that are made for `separation` until a time of the step.
fn boxes<S: Format>(pair: &PairCase<S>, separation: S, until: S) -> [MovingBox<f32>; 2] {
    let mut extent = Aabb::<f64>::empty();
    for position in pair.points.iter().flatten() {
        for axis in 0..3 {
            let x = position[axis].to_f64();
            extent.lower[axis] = extent.lower[axis].min(x);
            extent.upper[axis] = extent.upper[axis].max(x);
        }
    }
    let mapping = Mapping::new(&extent, separation, until, false);
    let [a, b, c, d] = pair.points.map(|[start, end]| mapping.vertex(start, end));
    match pair.kind {
        PairKind::VertexFace => [a, b.merged(&c).merged(&d)],
        PairKind::EdgeEdge => [a.merged(&b), c.merged(&d)],
    }
}

/// Returns whether boxes show the pair to be apart by more than `separation` until a time of the step.
fn are_boxes_apart<S: Format>(pair: &PairCase<S>, separation: S, until: S) -> bool {
    let [first, second] = boxes(pair, separation, until);
    first.is_apart_from(&second)
}

/// Returns whether boxes that are made for `separation` show the pair to be apart by more than a smaller one.
fn are_drawn_in_boxes_apart<S: Format>(pair: &PairCase<S>, separation: S, smaller: S) -> bool {
    let [first, second] = boxes(pair, separation, S::ONE);
    let inset = Inset::new(separation.to_f64(), smaller.to_f64()).for_bounds(&first);
    first.drawn_in(inset).is_apart_from(&second)
}

/// Returns the pair until a time, if `f64` has the positions there.
fn cut_short(pair: &Pair, until: f64) -> Option<Pair> {
    let mut cut = *pair;
    for k in 0..4 {
        let end = crate::support::at(pair.start[k], pair.end[k], &Rational::from_f64(until)?);
        for axis in 0..3 {
            cut.end[k][axis] = end[axis].to_f64();
            if end[axis] != cut.end[k][axis] {
                return None;
            }
        }
    }
    Some(cut)
}

fn boxes_that_are_apart_keep_their_separation<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    for until in [1.0, 0.0625] {
        let Some(cut) = cut_short(&pair.question(), until) else {
            continue;
        };
        let until = S::from_f64(until);
        let kept = largest_of_all(pair, |pair| {
            largest_accepted(|separation| are_boxes_apart(pair, separation, until))
        });
        if let Some(separation) = kept {
            prop_assert!(!within(&cut, separation.to_f64()), "{separation} until {until}");
        }
    }
    Ok(())
}

formats!(boxes_that_are_apart_keep_their_separation(600, pairs_of_any_kind()));

fn boxes_that_are_drawn_in_keep_the_smaller_separation<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let kept = largest_of_all(pair, |pair| {
        largest_accepted(|separation| are_boxes_apart(pair, separation, S::ONE))
    });
    // The factors lead from a separation that the pair keeps to one that the boxes of all its points are far within.
    for factor in [0.75, 1.0, 3.0, 300.0] {
        let separation = kept.unwrap_or(S::ONE) * S::from_f64(factor);
        let smaller = largest_of_all(pair, |pair| {
            largest_accepted(|smaller| are_drawn_in_boxes_apart(pair, separation, smaller))
        });
        if let Some(smaller) = smaller {
            prop_assert!(!within(&pair.question(), smaller.to_f64()), "{smaller} of {separation}");
        }
    }
    Ok(())
}

formats!(boxes_that_are_drawn_in_keep_the_smaller_separation(400, pairs_of_any_kind()));

#[test]
fn boxes_that_are_drawn_in_show_nearly_all_that_is_kept_and_nothing_that_is_uncertain() {
    let at = |x: f64| [[x, 0.3, 0.1], [x + 2.0, 0.4, 0.2]];
    let pair = PairCase {
        kind: PairKind::EdgeEdge,
        points: [at(0.0), at(0.5), at(1.5), at(1.75)],
    };
    for separation in [1.5, 4.0, 1e3] {
        let kept = largest_accepted(|smaller| are_drawn_in_boxes_apart(&pair, separation, smaller)).unwrap();
        let lost = 2e-6 * (3.0 + separation);
        assert!(kept < 1.0 && kept > 1.0 - lost, "{kept} of {separation}");
    }
    let [first, second] = boxes(&pair, 0.5, 1.0);
    assert!(first.is_apart_from(&second));
    for smaller in [0.5, 0.75, 0.5 - 1e-20, f64::INFINITY, f64::NAN] {
        let inset = Inset::new(0.5, smaller).for_bounds(&first);
        assert!(!first.drawn_in(inset).is_apart_from(&second), "{smaller}");
    }
    let far = MovingBox::from_motion(&([1e31_f32, 0.0, 0.0], [1e31, 0.0, 0.0]).into());
    let inset = Inset::new(0.5, 0.25);
    assert!(!far.drawn_in(inset.for_bounds(&far)).is_apart_from(&second));
    let everywhere = boxes(&pair.map(|_| f64::NAN), 0.5, 1.0)[0];
    assert!(!everywhere.drawn_in(inset.for_bounds(&everywhere)).is_apart_from(&second));
}

fn boxes_of_what_is_not_finite_are_not_apart<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    // A single point is neither finite nor apart from anything.
    for k in 0..4 {
        let mut one = pair.map(S::made_finite);
        one.points[k] = pair.points[k];
        if one.is_finite() {
            continue;
        }
        for separation in [S::ZERO, S::ONE] {
            let mapping = Mapping::new(&Aabb::everything(), separation, S::ONE, false);
            let [a, b] = [k, (k + 1) % 4].map(|k| mapping.vertex(one.points[k][0], one.points[k][1]));
            prop_assert!(!a.is_apart_from(&b) && !a.merged(&b).is_apart_from(&b));
        }
    }
    Ok(())
}

formats!(boxes_of_what_is_not_finite_are_not_apart(800, extraordinary_pairs()));
