use super::pair::{self, Numbers};
use selvedge::core::kernels::coplanarity::is_in_range;
use selvedge::core::kernels::exact::{UNKNOWN, certain_signs, control_value_signs, is_never_coplanar};
#[cfg(test)]
use selvedge::core::kernels::{points::PairPoints, vector::Vector};
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

/// Returns a pair's kind and format, and the encodings of its coordinates: axis by axis, all points at the start, then at the
/// end.
#[cfg(test)]
pub(crate) fn encodings(data: &[u8]) -> String {
    match pair::numbers(data) {
        Numbers::Single(case) => encoded("f32", &case),
        Numbers::Double(case) => encoded("f64", &case),
    }
}

#[cfg(test)]
fn encoded<S: Format>(format: &str, case: &PairCase<S>) -> String {
    let pair = case.pair();
    let points = PairPoints::from(&pair);
    let axes: [fn(&Vector<S>) -> S; 3] = [|point| point.x, |point| point.y, |point| point.z];
    let all = || points.start.iter().chain(&points.end);
    let numbers = axes
        .iter()
        .flat_map(|of| all().map(|point| format!(" {:x}", of(point).encoding())));
    format!("{:?} {format}{}", pair.kind, numbers.collect::<String>())
}
