use super::pair::{self, Numbers};
use selvedge::PairKind;
use selvedge::core::Verdict;
use selvedge::core::filter::certified::non_coplanarity;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::coplanar;

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
        assert!(!coplanar(&question.start, &question.end), "{case:?}");
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
    let expected = one_sign(tripled_control_values(points));
    assert_eq!(verdict(&case).is_culled(), expected, "{case:?}");
    assert_eq!(case.tetrahedron().is_never_coplanar(), expected);
}

fn one_sign(values: [i64; 4]) -> bool {
    values.iter().all(|&k| k > 0) || values.iter().all(|&k| k < 0)
}

/// Returns the control values, times three, of the volume spanned by the edges from the second point. They come from its
/// coefficients by powers of the time, c₀ + c₁t + c₂t² + c₃t³, and those from the determinant's definition.
fn tripled_control_values(points: &[[[i8; 3]; 2]; 4]) -> [i64; 4] {
    // Each coordinate as (at time 0, change).
    let linear = |point: usize, axis: usize| {
        let along = points[point].map(|ends| i64::from(ends[axis]));
        [along[0], along[1] - along[0]]
    };
    let edge = |point: usize, axis: usize| {
        let (p, a) = (linear(point, axis), linear(1, axis));
        [p[0] - a[0], p[1] - a[1]]
    };
    let mut coefficients = [0; 4];
    for (axes, sign) in [
        ([0, 1, 2], 1),
        ([1, 2, 0], 1),
        ([2, 0, 1], 1),
        ([0, 2, 1], -1),
        ([2, 1, 0], -1),
        ([1, 0, 2], -1),
    ] {
        let factors = [edge(2, axes[0]), edge(3, axes[1]), edge(0, axes[2])];
        for powers in 0..8 {
            let chosen = [powers & 1, powers >> 1 & 1, powers >> 2];
            let product: i64 = factors.iter().zip(chosen).map(|(f, power)| f[power]).product();
            coefficients[chosen.iter().sum::<usize>()] += sign * product;
        }
    }
    let [c0, c1, c2, c3] = coefficients;
    [3 * c0, 3 * c0 + c1, 3 * c0 + 2 * c1 + c2, 3 * (c0 + c1 + c2 + c3)]
}
