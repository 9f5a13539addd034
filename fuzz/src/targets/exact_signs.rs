use super::pair::{self, Numbers};
use rug::{Integer, Rational};
use selvedge::core::verification::exact::{UNKNOWN, certain_signs, control_value_signs, is_never_coplanar};
use selvedge::core::verification::of_kind;
use selvedge::core::verification::points::PairShape;
use selvedge_verification::generator::{Format, PairCase};
use std::cmp::Ordering;

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
    // The volume of the four points in the order of `PairShape::volume_points`: a, b, c, p.
    let at = |end: usize| {
        let exact = |x: S| Rational::from_f64(x.to_f64()).expect("finite");
        let points = case.points.map(|point| point[end].map(exact));
        of_kind!(case.kind, P => P::volume_points(points))
    };
    let expected = signs([at(0), at(1)]);
    assert_eq!(computed, Some(expected), "{case:?}");
    let has_one_sign = expected[0].is_ne() && expected.iter().all(|&sign| sign == expected[0]);
    assert_eq!(is_never_coplanar(pair, UNKNOWN), has_one_sign, "{case:?}");

    // Within range, signs that exceed their error bounds are right, and may be passed on.
    let tetrahedron = case.tetrahedron();
    let largest = tetrahedron.largest_by_axis().largest();
    if selvedge::core::verification::coplanarity::is_in_range(largest) {
        let known = certain_signs(&tetrahedron.control_values(), tetrahedron.error_bounds());
        for (known, expected) in known.iter().zip(expected) {
            assert!(known.is_none_or(|sign| sign == expected), "{case:?}");
        }
        assert_eq!(is_never_coplanar(pair, known), has_one_sign, "{case:?}");
    }
}

type Point = [Rational; 3];

/// Returns the signs of the control values from the volume at four times: K(0), K(1), K(−1) and K(2) determine the cubic.
fn signs(ends: [[Point; 4]; 2]) -> [Ordering; 4] {
    let volume = |time: i32| {
        let at = |point: usize, axis: usize| {
            let (start, end) = (&ends[0][point][axis], &ends[1][point][axis]);
            Rational::from(end - start) * time + start
        };
        let from_a = |point: usize| -> Point { std::array::from_fn(|axis| at(point, axis) - at(0, axis)) };
        determinant([from_a(3), from_a(1), from_a(2)])
    };
    let [before, v0, v1, v2] = [-1, 0, 1, 2].map(volume);
    // c₀ + c₁t + c₂t² + c₃t³ through the four.
    let c0 = v0;
    let c2 = Rational::from(&v1 + &before) / 2 - &c0;
    let odd = Rational::from(&v1 - &before) / 2;
    let c3 = (v2 - &c0 - Rational::from(&c2 * 4) - Rational::from(&odd * 2)) / 6;
    let c1 = odd - &c3;
    let three = Integer::from(3);
    let k0 = Rational::from(&c0 * &three);
    let k1 = Rational::from(&k0 + &c1);
    let k2: Rational = Rational::from(&k0 + &c1) + &c1 + &c2;
    [k0.cmp0(), k1.cmp0(), k2.cmp0(), v1.cmp0()]
}

fn determinant([a, b, c]: [Point; 3]) -> Rational {
    let minor = |i: usize, j: usize| Rational::from(&b[i] * &c[j]) - Rational::from(&b[j] * &c[i]);
    &a[0] * minor(1, 2) - &a[1] * minor(0, 2) + &a[2] * minor(0, 1)
}
