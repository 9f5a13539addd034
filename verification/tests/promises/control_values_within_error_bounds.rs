//! The control values of the coplanarity cubic are those of the right polynomial, and rounding errors stay within the proven
//! bounds.

use crate::support::prelude::*;
use rug::Float;
use rug::ops::Pow;
use selvedge_core::kernels::coplanarity::error_bound_by_magnitudes;
use selvedge_verification::plain;

/// Four points a, b, c, p, each at times 0 and 1.
type WholePoints = [[[i64; 3]; 2]; 4];

fn whole_points(limit: i64) -> impl Strategy<Value = WholePoints> {
    prop::array::uniform4(prop::array::uniform2(prop::array::uniform3(-limit..=limit)))
}

/// Whole numbers up to 2¹², as `f64`, on which core's own source computes without rounding: all results are below 2⁴⁸.
fn exact(points: &WholePoints) -> [[Vector<f64>; 2]; 4] {
    points.map(|ends| ends.map(|position| position.map(|x| x as f64).into()))
}

fn tetrahedron(points: &WholePoints) -> MovingTetrahedron<f64> {
    let points = exact(points);
    MovingTetrahedron::from_points(points.map(|ends| ends[0]), points.map(|ends| ends[1]))
}

/// Returns the volume P · (B × C) at time i/3, times 27, by the rule of Sarrus.
fn volume_at_third(points: &WholePoints, i: i128) -> i128 {
    let position = |point: usize, axis: usize| {
        let [start, end] = points[point].map(|ends| i128::from(ends[axis]));
        (3 - i) * start + i * end
    };
    let from_a = |point: usize| [0, 1, 2].map(|axis| position(point, axis) - position(0, axis));
    let [b, c, p] = [1, 2, 3].map(from_a);
    p[0] * b[1] * c[2] + p[1] * b[2] * c[0] + p[2] * b[0] * c[1] - p[2] * b[1] * c[0] - p[0] * b[2] * c[1] - p[1] * b[0] * c[2]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Two cubics that agree at four times are the same.
    #[test]
    fn control_values_are_the_bernstein_coefficients_of_the_signed_volume(points in whole_points(1 << 12)) {
        let [k0, k1, k2, k3] = tetrahedron(&points).control_values().0.map(|k| k as i128);
        prop_assert_eq!(27 * k0, volume_at_third(&points, 0));
        prop_assert_eq!(8 * k0 + 4 * k1 + 2 * k2 + k3, volume_at_third(&points, 1));
        prop_assert_eq!(k0 + 2 * k1 + 4 * k2 + 8 * k3, volume_at_third(&points, 2));
        prop_assert_eq!(27 * k3, volume_at_third(&points, 3));
    }

    /// The paper's equation (14) is 2n̂ = n₀ + n₁ − (v_b − v_a)×(v_c − v_a), and its control values are 2C + F and 2D + E.
    #[test]
    fn the_blossom_is_the_papers_expression_without_rounding(points in whole_points(1 << 12)) {
        let [a, b, c, p] = exact(&points);
        let [n0, n1] = [0, 1].map(|end| (b[end] - a[end]).cross(c[end] - a[end]));
        let velocity = |x: [Vector<f64>; 2]| x[1] - x[0];
        let twice_middle =
            n0 + n1 - (velocity(b) - velocity(a)).cross(velocity(c) - velocity(a));
        let [p0, p1] = [0, 1].map(|end| p[end] - a[end]);
        let [_, k1, k2, _] = tetrahedron(&points).control_values().0;
        prop_assert_eq!(k1, p0.dot(twice_middle) + p1.dot(n0));
        prop_assert_eq!(k2, p1.dot(twice_middle) + p0.dot(n1));
    }

    /// The numbers are small, so that zeros and every pattern of signs are common.
    #[test]
    fn without_rounding_the_filter_culls_exactly_when_all_control_values_have_one_sign(points in whole_points(3)) {
        let tetrahedron = tetrahedron(&points);
        let values = tetrahedron.control_values().0;
        let has_one_sign = values.iter().all(|&k| k > 0.0) || values.iter().all(|&k| k < 0.0);
        prop_assert_eq!(tetrahedron.is_never_coplanar(), has_one_sign);
    }

    #[test]
    fn the_plain_filter_is_right_where_nothing_rounds(points in whole_points(20)) {
        let [a, b, c, p] = points.map(|ends| ends.map(|position| position.map(|x| x as f64)));
        let pair = PairCase::new(PairKind::VertexFace, [p, a, b, c]);
        let culled = plain::culls(&pair);
        prop_assert_eq!(culled, tetrahedron(&points).is_never_coplanar());
    }

    /// The same four points are in the paper's order (equations 5 to 11).
    #[test]
    fn an_edge_pair_is_the_tetrahedron_k_u_v_l(points in whole_points(1 << 20)) {
        let points = points.map(|ends| ends.map(|position| position.map(|x| x as f64)));
        let [u, v, k, l] = points;
        let edges = PairCase::new(PairKind::EdgeEdge, [u, v, k, l]).tetrahedron();
        let face = PairCase::new(PairKind::VertexFace, [l, k, u, v]).tetrahedron();
        prop_assert_eq!((edges.b, edges.c, edges.p), (face.b, face.c, face.p));
    }
}

/// A control value as a sum of monomials of exact differences, and its permanent: the sum of their magnitudes.
struct ExactControlValue {
    value: Rational,
    permanent: Rational,
}

/// Returns the values in the order k₀, 3k₁, 3k₂, k₃, from the definition: the coefficient of (1−t)^(3−i)·t^i in det(P, B, C).
fn exact_control_values<S: Format>(pair: &PairCase<S>) -> [ExactControlValue; 4] {
    let order = match pair.kind {
        PairKind::VertexFace => [1, 2, 3, 0],
        PairKind::EdgeEdge => [2, 0, 1, 3],
    };
    let [a, b, c, p] = order.map(|k| pair.points[k].map(|position| position.map(rational)));
    let from_a = |x: &[[Rational; 3]; 2]| -> [[Rational; 3]; 2] {
        std::array::from_fn(|end| std::array::from_fn(|axis| Rational::from(&x[end][axis] - &a[end][axis])))
    };
    let [p, b, c] = [from_a(&p), from_a(&b), from_a(&c)];
    let mut values = [(); 4].map(|()| ExactControlValue {
        value: Rational::new(),
        permanent: Rational::new(),
    });
    let even = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
    let odd = [[0, 2, 1], [1, 0, 2], [2, 1, 0]];
    for ends in 0..8 {
        let [i, j, k] = [ends & 1, ends >> 1 & 1, ends >> 2];
        let control_value = &mut values[i + j + k];
        for (axes, negative) in even.map(|axes| (axes, false)).into_iter().chain(odd.map(|axes| (axes, true))) {
            let [x, y, z] = axes;
            let monomial = Rational::from(&p[i][x] * &b[j][y]) * &c[k][z];
            control_value.permanent += monomial.clone().abs();
            if negative {
                control_value.value -= monomial;
            } else {
                control_value.value += monomial;
            }
        }
    }
    values
}

/// Returns half of the smallest subnormal number: the most that a product loses by underflow.
fn lost_by_underflow<S: Format>() -> Rational {
    rational(S::exact(1, S::MIN_EXPONENT)) / 2_u32
}

/// Returns (1 + u)^n − 1.
fn relative_error<S: Format>(roundings: u32) -> Rational {
    (Rational::from(1) + rational(S::UNIT_ROUNDOFF)).pow(roundings) - 1_u32
}

/// Returns the largest magnitude of a component, as computed.
fn largest<S: Format>(vectors: impl IntoIterator<Item = [Vector<S>; 2]>) -> Rational {
    let components = vectors.into_iter().flatten().flat_map(|v| [v.x, v.y, v.z]);
    let magnitudes = components.map(|x| rational(x).abs());
    magnitudes.max().expect("some components")
}

/// The computed and the exact values of a pair.
struct Compared {
    computed: [Rational; 4],
    bounds: [Rational; 4],
    exact: [ExactControlValue; 4],
    /// The largest component of P.
    largest_p: Rational,
    /// The largest component of all edges.
    largest: Rational,
}

/// Returns `None` if the pair is outside the range in which the bounds hold.
fn compared<S: Format>(pair: &PairCase<S>) -> Option<Compared> {
    let tetrahedron = pair.tetrahedron();
    if !is_in_range(tetrahedron.largest_by_axis().largest()) {
        return None;
    }
    let MovingTetrahedron { b, c, p } = tetrahedron;
    Some(Compared {
        computed: tetrahedron.control_values().0.map(rational),
        bounds: tetrahedron.error_bounds().map(rational),
        exact: exact_control_values(pair),
        largest_p: largest([p]),
        largest: largest([b, c, p]),
    })
}

/// Each monomial passes through at most 8 roundings (k₀, k₃) or 10 (3k₁, 3k₂), here to nearest. Each product that underflows
/// loses η₀. There are two for a component of n, four for one of h, and at most one more in the last six additions.
fn control_values_are_off_by_no_more_than_their_roundings<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let Some(Compared {
        computed,
        exact,
        largest_p,
        ..
    }) = compared(pair)
    else {
        return Ok(());
    };
    for (k, (computed, exact)) in computed.iter().zip(&exact).enumerate() {
        let outer = k == 0 || k == 3;
        let (roundings, per_p, alone) = if outer { (8, 6, 3) } else { (10, 18, 6) };
        let underflow =
            (Rational::from(&largest_p * per_p) + alone) * lost_by_underflow::<S>() * (relative_error::<S>(6) + 1_u32);
        let allowed: Rational = relative_error::<S>(roundings) * &exact.permanent + underflow;
        let error = Rational::from(computed - &exact.value).abs();
        prop_assert!(
            error <= allowed,
            "control value {k}: off by {} of {}",
            error.to_f64(),
            allowed.to_f64()
        );
    }
    Ok(())
}

formats!(control_values_are_off_by_no_more_than_their_roundings(
    8_000,
    pairs_of_any_kind()
));

/// Checks that a computed value beyond its bound has the sign of the exact one.
fn signs_are_certain(computed: &[Rational; 4], bounds: &[Rational; 4], exact: &[ExactControlValue; 4]) -> TestCaseResult {
    for k in 0..4 {
        let (computed, bound, value) = (&computed[k], &bounds[k], &exact[k].value);
        prop_assert!(computed <= bound || *value > 0, "control value {k}");
        prop_assert!(-computed.clone() <= *bound || *value < 0, "control value {k}");
    }
    Ok(())
}

/// Returns the bounds of k₀ and k₃, and four times as much for the other two.
fn bounds_by_magnitudes<S: Format>(pair: &PairCase<S>) -> [Rational; 4] {
    let outer = error_bound_by_magnitudes(pair.tetrahedron().largest_by_axis());
    let inner = S::small(4) * outer;
    [outer, inner, inner, outer].map(rational)
}

/// The filter relies on this promise for each of the four values alone.
fn a_control_value_beyond_its_bound_has_the_exact_sign<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    match compared(pair) {
        Some(Compared {
            computed, bounds, exact, ..
        }) => signs_are_certain(&computed, &bounds, &exact),
        None => Ok(()),
    }
}

formats!(a_control_value_beyond_its_bound_has_the_exact_sign(
    15_000,
    pairs_of_any_kind()
));

fn a_control_value_beyond_its_bound_by_magnitudes_has_the_exact_sign<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if let Some(Compared { computed, exact, .. }) = compared(pair) {
        signs_are_certain(&computed, &bounds_by_magnitudes(pair), &exact)?;
    }
    Ok(())
}

formats!(a_control_value_beyond_its_bound_by_magnitudes_has_the_exact_sign(
    15_000,
    pairs_of_any_kind()
));

/// Checks that a computed bound is the documented sum of a relative and an absolute term. It may differ by 16 roundings and the
/// underflow of its products. The underflow is less than an eighth of the absolute term.
fn is_documented<S: Format>(bound: &Rational, relative: Rational, absolute: &Rational) -> TestCaseResult {
    let slack = relative_error::<S>(16) + 1_u32;
    let (documented, lost) = (relative + absolute, Rational::from(absolute / 8_u32));
    let most = Rational::from(&documented * &slack) + &lost;
    prop_assert!(*bound <= most, "{} is too large", bound.to_f64());
    let at_most = Rational::from(bound + &lost) * slack;
    prop_assert!(at_most >= documented, "{} is too small", bound.to_f64());
    Ok(())
}

/// Returns (1 + M)²·η.
fn underflow_term<S: Format>(largest: &Rational) -> Rational {
    (Rational::from(largest) + 1_u32).square() * rational(S::UNDERFLOW)
}

/// The bounds are Eᵢ = Cᵢ·P̂ᵢ + (1 + M)²·η with C = 16u, 20u.
fn error_bounds_are_the_documented_ones<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let Some(Compared {
        bounds, exact, largest, ..
    }) = compared(pair)
    else {
        return Ok(());
    };
    for (k, (bound, exact)) in bounds.iter().zip(&exact).enumerate() {
        let count = if k == 0 || k == 3 { 16_u32 } else { 20 };
        let relative = rational(S::UNIT_ROUNDOFF) * count * &exact.permanent;
        is_documented::<S>(bound, relative, &underflow_term::<S>(&largest))?;
    }
    Ok(())
}

formats!(error_bounds_are_the_documented_ones(4_000, pairs_of_any_kind()));

/// The bound is 96u times the product of the three largest magnitudes + (1 + M)²·η.
fn error_bounds_by_magnitudes_are_the_documented_ones<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if compared(pair).is_none() {
        return Ok(());
    }
    let MovingTetrahedron { b, c, p } = pair.tetrahedron();
    let edges = [b, c, p];
    let along = |axis: usize| {
        let only = |v: Vector<S>| Vector::new([v.x, v.y, v.z][axis], S::ZERO, S::ZERO);
        largest(edges.map(|ends| ends.map(only)))
    };
    let [x, y, z] = [0, 1, 2].map(along);
    let underflow = underflow_term::<S>(&largest(edges));
    let relative = rational(S::UNIT_ROUNDOFF) * 96_u32 * (x * y * z);
    is_documented::<S>(&bounds_by_magnitudes(pair)[0], relative, &underflow)
}

formats!(error_bounds_by_magnitudes_are_the_documented_ones(4_000, pairs_of_any_kind()));

/// Returns the control points n₀, h/2, n₁ of the normal, exactly, each as the square of its length.
fn squared_normals<S: Format>(pair: &PairCase<S>) -> [Rational; 3] {
    // The normal is the cross product of two moving vectors.
    let [from_0, to_0, from_1, to_1] = match pair.kind {
        PairKind::VertexFace => [1, 2, 1, 3],
        PairKind::EdgeEdge => [0, 1, 2, 3],
    };
    let points = pair.points.map(|ends| ends.map(|x| x.map(rational)));
    let vector = |from: usize, to: usize, end: usize| -> [Rational; 3] {
        let ends = [&points[from][end], &points[to][end]];
        std::array::from_fn(|axis| Rational::from(&ends[1][axis] - &ends[0][axis]))
    };
    let cross = |a: &[Rational; 3], b: &[Rational; 3]| -> [Rational; 3] {
        std::array::from_fn(|axis| {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i])
        })
    };
    let [a0, a1] = [0, 1].map(|end| vector(from_0, to_0, end));
    let [b0, b1] = [0, 1].map(|end| vector(from_1, to_1, end));
    let (one, other) = (cross(&a0, &b1), cross(&a1, &b0));
    let middle: [Rational; 3] = std::array::from_fn(|axis| Rational::from(&one[axis] + &other[axis]) / 2_u32);
    [cross(&a0, &b0), middle, cross(&a1, &b1)].map(|normal| normal.into_iter().map(Rational::square).sum())
}

fn largest_normal<S: Format>(pair: &PairCase<S>) -> S {
    let kind = pair.kind;
    pair.tetrahedron().largest_normal(kind)
}

fn no_normal_is_longer_than_its_bound<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    if compared(pair).is_some() {
        let bound = rational(largest_normal(pair)).square();
        for (k, squared) in squared_normals(pair).iter().enumerate() {
            prop_assert!(bound >= *squared, "control point {k}");
        }
    }
    Ok(())
}

formats!(no_normal_is_longer_than_its_bound(15_000, pairs_of_any_kind()));

/// The formula is (√(|n|² + η) + 128u·M²)·(1 + 32u). On small integers everything up to the root is exact, and the rest rounds
/// five times.
fn the_bound_of_the_normal_is_the_documented_one<S: Format>() {
    let whole = from_choices(|choices: &mut Choices<'_>| {
        let kind = choices.pick(&[PairKind::VertexFace, PairKind::EdgeEdge]);
        let number = |choices: &mut Choices<'_>| S::exact(choices.within(20), 0);
        let points = [(); 4].map(|()| [(); 2].map(|()| [(); 3].map(|()| number(choices))));
        PairCase::<S>::new(kind, points)
    });
    check(4_000, whole, |pair| {
        let MovingTetrahedron { b, c, p } = pair.tetrahedron();
        let [u, eta] = [S::UNIT_ROUNDOFF, S::UNDERFLOW].map(rational);
        let squared = squared_normals(pair).into_iter().max().expect("three") + eta;
        let length = rational_root(&squared);
        let rounding = Rational::from(128) * &u * largest([b, c, p]).square();
        let documented = (length + rounding) * (Rational::from(32) * &u + 1_u32);
        let error = (rational(largest_normal(pair)) - &documented).abs();
        prop_assert!(error <= documented * u * 5_u32);
        Ok(())
    });
}

formats!(the_bound_of_the_normal_is_the_documented_one);

/// Returns the root to 200 bits.
fn rational_root(square: &Rational) -> Rational {
    let root = Float::with_val(200, square).sqrt();
    root.to_rational().expect("finite")
}
