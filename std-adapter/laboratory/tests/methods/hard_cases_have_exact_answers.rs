//! Selvedge's methods are right on the neighbours, in the last place, of the hard cases of `selvedge hard-cases`. That they are
//! right on the cases themselves, which are in the conformance suite, is a promise in `verification`.

use selvedge_core::Scalar;
use selvedge_laboratory::hard_cases::{ExactContact, HardCase, hard_cases};
use selvedge_laboratory::methods::QueryMethod;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::collides;

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
