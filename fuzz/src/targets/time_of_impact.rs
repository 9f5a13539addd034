use super::pair::{self, Numbers};
use selvedge::core::PrimitivePair;
use selvedge::core::elementary::advance::certain_contact;
use selvedge::core::elementary::advance::{ROUNDS, TURNS, time_of_impact_and_work};
use selvedge::core::elementary::{Impact, Limits};
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::{AlgebraicTime, collides};
use std::cmp::Ordering;

/// The time of impact never misses and is never late, whatever the tolerance. A confirmed contact is one, and the work is
/// bounded. NaN and infinities exclude nothing.
pub fn time_of_impact(data: &[u8]) {
    let exponent = i32::from(data.last().copied().unwrap_or(0) % 64);
    match pair::numbers(data) {
        Numbers::Single(case) => check(&case, exponent),
        Numbers::Double(case) => check(&case, exponent),
    }
}

fn check<S: Format>(case: &PairCase<S>, exponent: i32) {
    // The oracle takes minutes for exponents that are very far apart.
    let sizes = case.coordinates().map(|x| x.to_f64().abs());
    let sizes = sizes.filter(|&x| x > 0.0 && x.is_finite());
    let (low, high) = sizes.fold((f64::MAX, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    if high > 0.0 && high / low > 1e60 {
        return;
    }
    let size = if high > 0.0 { S::from_f64(high).made_finite() } else { S::ONE };
    let mut first = None;
    for tolerance in [S::ZERO, size * S::exact(1, -exponent)] {
        check_pair(case, &case.pair(), tolerance, &mut first);
    }
}

fn check_pair<S: Format>(case: &PairCase<S>, pair: &PrimitivePair<S>, tolerance: S, first: &mut Option<Option<AlgebraicTime>>) {
    let limits = Limits::accurate_to(tolerance);
    let (impact, work) = time_of_impact_and_work(pair, &limits);
    assert!(work.rounds <= ROUNDS && work.volume_steps <= 1 + 8 * work.rounds);
    assert!(work.turns <= TURNS * work.rounds);
    if !case.is_finite() {
        assert!(matches!(impact, Impact::Possible { .. }), "{case:?}");
        return;
    }
    let first = first.get_or_insert_with(|| collides(&case.question()));
    match (impact, first) {
        (Impact::Never, Some(_)) => panic!("{tolerance}: missed {case:?}"),
        (Impact::Possible { time, .. }, Some(contact)) => {
            assert!(time >= S::ZERO && time <= S::ONE, "{case:?}");
            let order = contact.cmp_f64(time.to_f64());
            assert_ne!(order, Ordering::Less, "{tolerance}: {time} is late for {case:?}");
        }
        (Impact::Possible { time, .. }, None) => {
            let confirmed = certain_contact(pair, time);
            assert_eq!(confirmed, None, "{tolerance}: no contact in {case:?}");
        }
        (Impact::Never, None) => {}
    }
}
