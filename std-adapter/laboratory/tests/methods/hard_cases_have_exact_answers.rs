//! Selvedge's methods are right on the hard cases of `selvedge hard-cases`, and on their neighbours in the last place.

use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{ContactVerdict as Verdict, Impact, Limits, contact};
use selvedge_core::{PairKind, Scalar};
use selvedge_laboratory::hard_cases::{ExactContact, HardCase, hard_cases};
use selvedge_laboratory::methods::QueryMethod;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::collides;
use std::cmp::Ordering;

fn pair(case: &HardCase) -> PairCase<f64> {
    let points = case
        .pair
        .motions
        .map(|motion| [motion.start.to_array(), motion.end.to_array()]);
    PairCase::new(case.pair.kind, points)
}

fn to_f32(pair: &PairCase<f64>) -> PairCase<f32> {
    let points = pair.points.map(|ends| ends.map(|x| x.map(f32::from_f64)));
    PairCase::new(pair.kind, points)
}

/// Returns Selvedge's methods, which must never cull a pair that touches. (Tight-Inclusion's bisection must not either, but it is
/// slow.)
fn ours() -> impl Iterator<Item = QueryMethod> {
    let is_ours = |method: &QueryMethod| method.is_certified() && method.name() != "tight_inclusion";
    QueryMethod::ALL.into_iter().filter(is_ours)
}

fn culling<S: Format>(pair: &PairCase<S>) -> Vec<QueryMethod> {
    ours().filter(|method| !method.keeps(pair.pair())).collect()
}

/// Checks that they keep pairs that touch, are not late, exclude nothing that is not finite, and that the exact verdict is exact.
fn is_right<S: Format>(name: &str, pair: &PairCase<S>) {
    let impact = time_of_impact(&pair.pair(), &Limits::default());
    let contact = contact(&pair.pair());
    if !pair.is_finite() {
        assert_eq!(culling(pair), [], "{name}: {pair:?}");
        assert_eq!(contact, Verdict::Undefined, "{name}: {pair:?}");
        return;
    }
    let Some(first) = collides(&pair.question()) else {
        assert_eq!(contact, Verdict::Never, "{name}: {pair:?}");
        return;
    };
    assert_eq!(contact, Verdict::Happens, "{name}: {pair:?}");
    // In every order of roles and time that is the same contact.
    let orders: &[[usize; 4]] = match pair.kind {
        PairKind::VertexFace => &[[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [0, 1, 3, 2]],
        PairKind::EdgeEdge => &[[0, 1, 2, 3], [2, 3, 0, 1], [1, 0, 2, 3], [0, 1, 3, 2]],
    };
    for order in orders.iter().map(|&order| pair.reordered(order)) {
        assert_eq!([culling(&order), culling(&order.reversed())], [[], []], "{name}: {order:?}");
    }
    let Impact::Possible { time, .. } = impact else {
        panic!("{name}: missed {pair:?}");
    };
    let order = first.cmp_f64(time.to_f64());
    assert_ne!(order, Ordering::Less, "{name}: {time} is late for {pair:?}");
}

#[test]
fn ours_are_right_on_all_cases_in_both_formats() {
    for case in hard_cases() {
        let pair = pair(case);
        is_right(&case.name, &pair);
        is_right(&case.name, &to_f32(&pair));
    }
}

/// Returns the pairs with one coordinate moved up or down by one unit in the last place.
fn neighbours<S: Format>(pair: &PairCase<S>) -> impl Iterator<Item = PairCase<S>> {
    let pair = *pair;
    (0..24).flat_map(move |index| {
        [-1, 1].map(|step| {
            let mut pair = pair;
            let number = &mut pair.points[index / 6][index / 3 % 2][index % 3];
            *number = number.nudged(step);
            pair
        })
    })
}

/// Checks that culled neighbours of a collision do not touch, and returns their number.
fn nudges_cull_no_collision<S: Format>(name: &str, pair: &PairCase<S>) -> usize {
    let mut culled = 0;
    for neighbour in neighbours(pair) {
        if let Some(method) = culling(&neighbour).first() {
            let contact = collides(&neighbour.question());
            assert!(contact.is_none(), "{name}: {method} culls {neighbour:?}");
            culled += 1;
        }
    }
    culled
}

#[test]
fn a_nudge_by_one_unit_in_the_last_place_never_turns_a_kept_collision_into_a_cull() {
    let mut culled = 0;
    for case in hard_cases() {
        if matches!(case.contact, ExactContact::First { .. }) {
            culled += nudges_cull_no_collision(&case.name, &pair(case));
            culled += nudges_cull_no_collision(&case.name, &to_f32(&pair(case)));
        }
    }
    // Otherwise this would show nothing.
    assert!(culled > 300, "only {culled} neighbours are culled");
}

/// The certified time of impact excludes cases that are clearly apart and that rounding does not move.
#[test]
fn cases_that_are_clearly_apart_are_excluded() {
    let mut excluded = 0;
    for case in hard_cases() {
        let is_clear = matches!(case.contact, ExactContact::Never) && ["1 m", "10 km"].contains(&case.placement.as_str());
        if is_clear && !case.name.contains("2^-1074") {
            let kept = QueryMethod::Selvedge.keeps(case.pair);
            assert!(!kept, "{} ({}) is kept", case.name, case.placement);
            excluded += 1;
        }
    }
    assert!(excluded > 20, "only {excluded}");
}
