use super::pair::{self, Numbers};
use selvedge::core::kernels::coplanarity::is_in_range;
use selvedge::core::kernels::exact::{UNKNOWN, certain_signs, control_value_signs, is_never_coplanar};
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::InRationals;

/// The exact signs are those of the control values in rationals, by another formula. Signs that rounded values prove are right,
/// too. Pairs with NaN and infinities have none.
pub fn exact_signs(data: &[u8]) {
    match pair::numbers(data) {
        Numbers::Single(case) => check(&case),
        Numbers::Double(case) => check(&case),
    }
}

fn check<S: Format>(case: &PairCase<S>) {
    let pair = &case.pair();
    let computed = control_value_signs(pair);
    if !case.is_finite() {
        assert_eq!(computed, None, "{case:?}");
        assert!(!is_never_coplanar(pair, UNKNOWN), "{case:?}");
        return;
    }
    let expected = InRationals::new(case).signs();
    assert_eq!(computed, Some(expected), "{case:?}");
    let has_one_sign = expected[0].is_ne() && expected.iter().all(|&sign| sign == expected[0]);
    assert_eq!(is_never_coplanar(pair, UNKNOWN), has_one_sign, "{case:?}");

    // Within range, signs that exceed their error bounds are right, and may be passed on.
    let tetrahedron = case.tetrahedron();
    let largest = tetrahedron.largest_by_axis().largest();
    if is_in_range(largest) {
        let known = certain_signs(&tetrahedron.control_values(), tetrahedron.error_bounds());
        for (known, expected) in known.iter().zip(expected) {
            assert!(known.is_none_or(|sign| sign == expected), "{case:?}");
        }
        assert_eq!(is_never_coplanar(pair, known), has_one_sign, "{case:?}");
    }
}
