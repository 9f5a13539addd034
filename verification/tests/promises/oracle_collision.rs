//! The oracle's contacts and separations of primitive pairs in motion agree with clipping and with stepping.

use crate::support::distance::{SLACK, advance, distance};
use crate::support::prelude::*;
use crate::support::{at, common_part};
use selvedge_verification::oracle::touches_at;

fn kind() -> impl Strategy<Value = PairKind> {
    prop_oneof![Just(PairKind::VertexFace), Just(PairKind::EdgeEdge)]
}

fn pair_of(coordinate: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Pair> {
    let positions = || prop::array::uniform4(prop::array::uniform3(coordinate.clone()));
    (kind(), positions(), positions()).prop_map(|(kind, start, end)| Pair { kind, start, end })
}

/// Uses few values, so that every degeneracy is common.
fn grid_pair() -> impl Strategy<Value = Pair> {
    pair_of((-1..=1).prop_map(f64::from).boxed())
}

/// Makes pairs of few values in a plane: the points are coplanar throughout.
fn flat_pair() -> impl Strategy<Value = Pair> {
    (pair_of((-2..=2).prop_map(f64::from).boxed()), 0..3_usize).prop_map(|(mut pair, axis)| {
        pair.start.iter_mut().chain(&mut pair.end).for_each(|p| p[axis] = 1.0);
        pair
    })
}

/// Makes pairs on a line, so that every triangle and every pair of edges is degenerate.
fn straight_pair() -> impl Strategy<Value = Pair> {
    pair_of((-3..=3).prop_map(f64::from).boxed()).prop_map(|mut pair| {
        let on_line = |p: &mut [f64; 3]| *p = [p[0], 1.0 - p[0], 2.0 * p[0]];
        pair.start.iter_mut().chain(&mut pair.end).for_each(on_line);
        pair
    })
}

/// Makes pairs of grid values; some are one unit in the last place off, tiny or huge.
fn rough_pair() -> impl Strategy<Value = Pair> {
    let whole = (-2..=2).prop_map(f64::from);
    let coordinate = prop_oneof![
        6 => whole.clone(),
        1 => whole.clone().prop_map(f64::next_up),
        1 => whole.prop_map(f64::next_down),
        2 => -2.0..2.0,
        1 => (-2.0..2.0).prop_map(|x: f64| x * 1e-310),
        1 => (-2.0..2.0).prop_map(|x: f64| x * 1e300),
    ];
    pair_of(coordinate.boxed())
}

fn simple_pair() -> impl Strategy<Value = Pair> {
    prop_oneof![grid_pair(), flat_pair(), straight_pair()]
}

fn any_pair() -> impl Strategy<Value = Pair> {
    prop_oneof![3 => grid_pair(), 1 => flat_pair(), 1 => straight_pair(), 2 => rough_pair()]
}

/// Decides contact at a rational time by construction instead of signs.
fn touches_by_clipping(pair: &Pair, t: &Rational) -> bool {
    let points: Vec<_> = (0..4).map(|i| at(pair.start[i], pair.end[i], t)).collect();
    let (first, second) = points.split_at(points_of_first(pair.kind));
    !common_part(first, second).is_empty()
}

/// Returns all times of the step with a denominator of at most 8.
fn sample_times() -> Vec<Rational> {
    let mut times: Vec<_> = (1..=8).flat_map(|q| (0..=q).map(move |p| Rational::from((p, q)))).collect();
    times.sort();
    times.dedup();
    times
}

/// Checks that the sampled contacts are found, that none of them is before the reported time, and that there is a contact at that
/// time.
fn check_against_clipping(pair: &Pair) -> TestCaseResult {
    let earliest = collides(pair);
    for t in sample_times() {
        let touches = touches_by_clipping(pair, &t);
        prop_assert_eq!(touches_at(pair, &t), touches, "static test at t = {}", t);
        if touches {
            let found = earliest.as_ref().is_some_and(|time| time.cmp_rational(&t).is_le());
            prop_assert!(found, "contact at t = {} missed, reported {:?}", t, earliest);
        }
    }
    if let Some(t) = earliest.as_ref().and_then(|time| time.as_rational()) {
        prop_assert!(touches_by_clipping(pair, t), "no contact at the reported t = {}", t);
    }
    Ok(())
}

/// Checks that the earliest time is where stepping ends.
fn check_against_stepping(pair: &Pair) -> TestCaseResult {
    let stepped = advance(pair, 0.0);
    match collides(pair) {
        None => prop_assert_eq!(stepped, None, "stepping finds a contact"),
        Some(mut time) => {
            let t = time.to_f64_down();
            prop_assert!(distance(pair, t) < 1e-12, "no contact at t = {}", t);
            // The slack is reached earlier than contact, by its cube root in the slowest approach, that of a triple root.
            let before = stepped.map(|s| t - s);
            prop_assert!(before.is_some_and(|b| (-1e-12..5e-3).contains(&b)), "{:?}", before);
            time.refine(100);
            let [low, high] = time.interval();
            prop_assert!(time.cmp_rational(&low).is_ge() && time.cmp_rational(&high).is_le());
            prop_assert!(high - low <= Rational::from(1) >> 100);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1200))]

    #[test]
    fn contacts_are_those_of_clipping(pair in prop_oneof![grid_pair(), flat_pair(), straight_pair(), rough_pair()]) {
        check_against_clipping(&pair)?;
    }

    #[test]
    fn earliest_contact_is_where_stepping_ends(pair in simple_pair()) {
        check_against_stepping(&pair)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn within_is_where_stepping_ends(
        pair in simple_pair(),
        separation in 0.01..1.5,
    ) {
        if advance(&pair, separation).is_none() {
            prop_assert!(!within(&pair, separation));
        } else if advance(&pair, separation - 2.0 * SLACK).is_some() {
            prop_assert!(within(&pair, separation));
        }
    }

    #[test]
    fn within_nothing_is_contact(pair in any_pair()) {
        prop_assert_eq!(within(&pair, 0.0), collides(&pair).is_some());
    }

    #[test]
    fn the_first_time_within_nothing_is_that_of_contact(pair in simple_pair()) {
        prop_assert_eq!(first_within(&pair, 0.0), collides(&pair));
    }

    #[test]
    fn the_first_time_within_is_where_the_distance_comes_down(
        pair in simple_pair(),
        separation in (0..=12).prop_map(|k| f64::from(k) / 4.0),
    ) {
        let first = first_within(&pair, separation);
        prop_assert_eq!(first.is_some(), within(&pair, separation));
        let Some(first) = first else { return Ok(()) };
        if let Some(time) = first.as_rational() {
            prop_assert!(within_at(&pair, time, separation));
        }
        // There is no earlier contact: tested at three times, the last as close as possible.
        let just_before = first.to_f64_down().next_down();
        for time in [just_before, 0.75 * just_before, 0.0] {
            if time >= 0.0 && first.cmp_f64(time).is_gt() {
                let time = Rational::from_f64(time).expect("finite");
                prop_assert!(!within_at(&pair, &time, separation));
            }
        }
    }
}
