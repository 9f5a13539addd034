//! The control values of the coplanarity cubic are those of the right polynomial, and rounding errors stay within the proven
//! bounds.

use crate::support::prelude::*;
use crate::support::{cross, determinant, minus};
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

/// Returns the volume P · (B × C) at time i/3, times 27.
fn volume_at_third(points: &WholePoints, i: i128) -> i128 {
    let position = |point: usize, axis: usize| {
        let [start, end] = points[point].map(|ends| i128::from(ends[axis]));
        (3 - i) * start + i * end
    };
    let from_a = |point: usize| [0, 1, 2].map(|axis| position(point, axis) - position(0, axis));
    determinant([3, 1, 2].map(from_a))
}

proptest! {
    #![proptest_config(config(256))]

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
    let from_a = |x: &[[Rational; 3]; 2]| [0, 1].map(|end| minus(&x[end], &a[end]));
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

/// Returns four numbers for the control values: the one for k₀ and k₃ twice, and the other.
fn outer_and_inner<T: Clone>(outer: T, inner: T) -> [T; 4] {
    [outer.clone(), inner.clone(), inner, outer]
}

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

/// - Each monomial of a computed value passes through at most 8 roundings (k₀, k₃) or 10 (3k₁, 3k₂), here to nearest. Each
///   product that underflows loses η₀. There are two for a component of n, four for one of h, and at most one more in the last
///   six additions.
/// - A computed value beyond either of its bounds has the sign of the exact one. The filter relies on this for each of the four
///   values alone.
/// - The bounds are Eᵢ = Cᵢ·P̂ᵢ + (1 + M)²·η with C = 16u, 20u. The bound by magnitudes is 96u times the product of the three
///   largest magnitudes + (1 + M)²·η.
fn control_values_and_their_bounds_are_the_documented_ones<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let tetrahedron = pair.tetrahedron();
    if !is_in_range(tetrahedron.largest_by_axis().largest()) {
        return Ok(());
    }
    let (computed, bounds) = (
        tetrahedron.control_values().0.map(rational),
        tetrahedron.error_bounds().map(rational),
    );
    let by_magnitudes = error_bound_by_magnitudes(tetrahedron.largest_by_axis());
    let by_magnitudes = outer_and_inner(by_magnitudes, S::small(4) * by_magnitudes).map(rational);
    let MovingTetrahedron { b, c, p } = tetrahedron;
    let (largest_p, edges) = (largest([p]), [b, c, p]);
    let underflow: Rational = (largest(edges) + 1_u32).square() * rational(S::UNDERFLOW);
    let u = rational(S::UNIT_ROUNDOFF);
    let counts = outer_and_inner((8, 6, 3, 16_u32), (10, 18, 6, 20));
    for (k, ExactControlValue { value, permanent }) in exact_control_values(pair).iter().enumerate() {
        let (roundings, per_p, alone, count) = counts[k];
        let lost = (Rational::from(&largest_p * per_p) + alone) * lost_by_underflow::<S>() * (relative_error::<S>(6) + 1_u32);
        let allowed: Rational = relative_error::<S>(roundings) * permanent + lost;
        let error = Rational::from(&computed[k] - value).abs();
        prop_assert!(
            error <= allowed,
            "control value {k}: off by {} of {}",
            error.to_f64(),
            allowed.to_f64()
        );
        for bound in [&bounds[k], &by_magnitudes[k]] {
            prop_assert!(computed[k] <= *bound || *value > 0, "control value {k}");
            prop_assert!(-computed[k].clone() <= *bound || *value < 0, "control value {k}");
        }
        is_documented::<S>(&bounds[k], Rational::from(&u * count) * permanent, &underflow)?;
    }
    let along = |axis: usize| {
        let only = |v: Vector<S>| Vector::new([v.x, v.y, v.z][axis], S::ZERO, S::ZERO);
        largest(edges.map(|ends| ends.map(only)))
    };
    let [x, y, z] = [0, 1, 2].map(along);
    is_documented::<S>(&by_magnitudes[0], u * 96_u32 * (x * y * z), &underflow)
}

formats!(control_values_and_their_bounds_are_the_documented_ones(
    15_000,
    pairs_of_any_kind()
));

/// Returns the control points n₀, h/2, n₁ of the normal, exactly, each as the square of its length.
fn squared_normals<S: Format>(pair: &PairCase<S>) -> [Rational; 3] {
    // The normal is the cross product of two moving vectors.
    let [from_0, to_0, from_1, to_1] = match pair.kind {
        PairKind::VertexFace => [1, 2, 1, 3],
        PairKind::EdgeEdge => [0, 1, 2, 3],
    };
    let points = pair.points.map(|ends| ends.map(|x| x.map(rational)));
    let vector = |from: usize, to: usize, end: usize| minus(&points[to][end], &points[from][end]);
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
    if is_in_range(pair.tetrahedron().largest_by_axis().largest()) {
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
