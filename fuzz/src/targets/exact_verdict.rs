use super::pair::{self, Numbers};
use selvedge::PairKind;
use selvedge::core::elementary::{ContactVerdict, contact};
use selvedge::core::kernels::exact::touches;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::collides;

/// The exact verdict, and the one in integers alone, are the oracle's. They stay the same if time is reversed or points trade
/// places, and are undefined for NaN and infinities. This uses numbers of the generator, and small integers.
pub fn exact_verdict(data: &[u8]) {
    match pair::numbers(data) {
        Numbers::Single(case) => check(&case),
        Numbers::Double(case) => check(&case),
    }
    let points = pair::whole(data);
    for kind in PairKind::ALL {
        let small = |position: [i8; 3]| position.map(|x| f64::from(x / 8));
        check(&PairCase::new(kind, points.map(|ends| ends.map(small))));
    }
}

fn check<S: Format>(case: &PairCase<S>) {
    let expected = if case.is_finite() {
        match collides(&case.question()) {
            Some(_) => ContactVerdict::Happens,
            None => ContactVerdict::Never,
        }
    } else {
        ContactVerdict::Undefined
    };
    let order = match case.kind {
        PairKind::VertexFace => [0, 2, 3, 1],
        PairKind::EdgeEdge => [3, 2, 0, 1],
    };
    assert_eq!(verdicts(case), [expected; 2], "{case:?}");
    assert_eq!(verdicts(&case.reversed()), [expected; 2], "{case:?}");
    assert_eq!(verdicts(&case.reordered(order)), [expected; 2], "{case:?}");
}

/// Returns the verdict that tries floating point first, and the one in whole numbers alone.
fn verdicts<S: Format>(case: &PairCase<S>) -> [ContactVerdict; 2] {
    let pair = case.pair();
    let in_whole_numbers = match touches(&pair) {
        Some(true) => ContactVerdict::Happens,
        Some(false) => ContactVerdict::Never,
        None => ContactVerdict::Undefined,
    };
    [contact(&pair), in_whole_numbers]
}
