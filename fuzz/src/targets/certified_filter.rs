use super::pair::{self, Numbers};
use selvedge::PairKind;
use selvedge::core::Verdict;
use selvedge::core::filter::certified::non_coplanarity;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::{InRationals, are_ever_coplanar};

/// A culled pair is never coplanar, and NaN and infinities are kept. If nothing is rounded, the filter culls exactly if the
/// control values of the volume have one sign.
pub fn certified_filter(data: &[u8]) {
    match pair::numbers(data) {
        Numbers::Single(case) => check(&case),
        Numbers::Double(case) => check(&case),
    }
    whole_numbers(&pair::whole(data));
}

fn check<S: Format>(case: &PairCase<S>) {
    let verdict = verdict(case);
    if !case.is_finite() {
        assert_eq!(verdict, Verdict::Kept, "{case:?}");
    } else if verdict.is_culled() {
        let question = case.question();
        assert!(!are_ever_coplanar(&question.start, &question.end), "{case:?}");
    }
    assert_eq!(verdict, self::verdict(&case.reversed()), "{case:?}");
}

fn verdict<S: Format>(case: &PairCase<S>) -> Verdict {
    non_coplanarity(&case.pair())
}

/// Coordinates are below 2⁶, so differences are below 2⁷ and all intermediate results below 2²⁷, exact in `f64`. The error bound,
/// below 20u·2²⁷ + 2¹⁵η (384u·2²¹ + 2¹⁵η by magnitudes), is less than 1, the least control value.
fn whole_numbers(points: &[[[i8; 3]; 2]; 4]) {
    let double = |position: [i8; 3]| position.map(f64::from);
    let case = PairCase::<f64>::new(PairKind::VertexFace, points.map(|ends| ends.map(double)));
    let expected = InRationals::new(&case).have_one_sign();
    assert_eq!(verdict(&case).is_culled(), expected, "{case:?}");
    assert_eq!(case.tetrahedron().is_never_coplanar(), expected);
}
