//! The coplanarity cubic: its control values are the right polynomial, and rounding moves them no further than proven.

use proptest::prelude::*;
use rug::{Rational, ops::Pow};
use selvedge::pipeline::CullingTest::PlainNonCoplanarity;
use selvedge_core::coplanarity::MovingTetrahedron;
use selvedge_core::filter::certified::is_never_coplanar;
use selvedge_core::{Lanes, PrimitivePair, Rounding, Vector};
use selvedge_verification::culling::verdict;
use selvedge_verification::generator::{Format, PairCase, check, pairs_of_any_kind};
use selvedge_verification::oracle::Kind;
use std::ops::{Add, Mul, Neg, Sub};

/// Whole numbers, so that core's own source computes without rounding. Panics on overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Exact(i128);

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.checked_add(other.0).expect("in range"))
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.checked_sub(other.0).expect("in range"))
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0.checked_mul(other.0).expect("in range"))
    }
}

impl Neg for Exact {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Rounding for Exact {
    const UNIT_ROUNDOFF: Self = Self(0);
    const UNDERFLOW: Self = Self(0);
    const ONE: Self = Self(1);
    const INFINITY: Self = Self(i128::MAX);
    fn small(count: u8) -> Self {
        Self(count.into())
    }
}

impl Lanes for Exact {
    type Scalar = Self;
    type Mask = bool;
    fn splat(self, value: Self) -> Self {
        value
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn larger(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
    fn smaller(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    fn greater(self, other: Self) -> bool {
        self.0 > other.0
    }
}

/// Four points a, b, c, p, each at times 0 and 1.
type WholePoints = [[[i64; 3]; 2]; 4];

fn whole_points(limit: i64) -> impl Strategy<Value = WholePoints> {
    prop::array::uniform4(prop::array::uniform2(prop::array::uniform3(-limit..=limit)))
}

fn exact(points: &WholePoints) -> [[Vector<Exact>; 2]; 4] {
    points.map(|ends| ends.map(|position| position.map(|x| Exact(x.into())).into()))
}

fn tetrahedron(points: &WholePoints) -> MovingTetrahedron<Exact> {
    let points = exact(points);
    MovingTetrahedron::from_points(points.map(|ends| ends[0]), points.map(|ends| ends[1]))
}

/// The volume P · (B × C) at time i/3, times 27, by the rule of Sarrus.
fn volume_at_third(points: &WholePoints, i: i128) -> i128 {
    let position = |point: usize, axis: usize| {
        let [start, end] = points[point].map(|ends| i128::from(ends[axis]));
        (3 - i) * start + i * end
    };
    let from_a = |point: usize| [0, 1, 2].map(|axis| position(point, axis) - position(0, axis));
    let [b, c, p] = [1, 2, 3].map(from_a);
    p[0] * b[1] * c[2] + p[1] * b[2] * c[0] + p[2] * b[0] * c[1]
        - p[2] * b[1] * c[0]
        - p[0] * b[2] * c[1]
        - p[1] * b[0] * c[2]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Two cubics that agree at four times are the same.
    #[test]
    fn control_values_are_the_bernstein_coefficients_of_the_signed_volume(points in whole_points(1 << 30)) {
        let [k0, k1, k2, k3] = tetrahedron(&points).control_values().0.map(|k| k.0);
        prop_assert_eq!(27 * k0, volume_at_third(&points, 0));
        prop_assert_eq!(8 * k0 + 4 * k1 + 2 * k2 + k3, volume_at_third(&points, 1));
        prop_assert_eq!(k0 + 2 * k1 + 4 * k2 + 8 * k3, volume_at_third(&points, 2));
        prop_assert_eq!(27 * k3, volume_at_third(&points, 3));
    }

    /// The paper, equation (14): 2n̂ = n₀ + n₁ − (v_b − v_a)×(v_c − v_a), and its control values 2C + F and 2D + E.
    #[test]
    fn the_blossom_is_the_papers_expression_without_rounding(points in whole_points(1 << 30)) {
        let [a, b, c, p] = exact(&points);
        let [n0, n1] = [0, 1].map(|end| (b[end] - a[end]).cross(c[end] - a[end]));
        let velocity = |x: [Vector<Exact>; 2]| x[1] - x[0];
        let twice_middle =
            n0 + n1 - (velocity(b) - velocity(a)).cross(velocity(c) - velocity(a));
        let [p0, p1] = [0, 1].map(|end| p[end] - a[end]);
        let [_, k1, k2, _] = tetrahedron(&points).control_values().0;
        prop_assert_eq!(k1, p0.dot(twice_middle) + p1.dot(n0));
        prop_assert_eq!(k2, p1.dot(twice_middle) + p0.dot(n1));
    }

    /// Small numbers, so that zeros and every pattern of signs are common.
    #[test]
    fn without_rounding_the_filter_culls_exactly_when_all_control_values_have_one_sign(points in whole_points(3)) {
        let tetrahedron = tetrahedron(&points);
        let signs = tetrahedron.control_values().0.map(|k| k.0.signum());
        prop_assert_eq!(is_never_coplanar(&tetrahedron), signs == [1; 4] || signs == [-1; 4]);
    }

    #[test]
    fn the_plain_filter_is_right_where_nothing_rounds(points in whole_points(20)) {
        let [a, b, c, p] = points.map(|ends| ends.map(|position| position.map(|x| x as f64)));
        let pair = PairCase::new(Kind::VertexFace, [p, a, b, c]);
        let culled = verdict(PlainNonCoplanarity, &pair).is_culled();
        prop_assert_eq!(culled, is_never_coplanar(&tetrahedron(&points)));
    }

    /// The same four points, in the slots that the paper gives them (equations 5 to 11).
    #[test]
    fn an_edge_pair_is_the_tetrahedron_k_u_v_l(points in whole_points(1 << 20)) {
        let points = points.map(|ends| ends.map(|position| position.map(|x| x as f64)));
        let [u, v, k, l] = points;
        let edges = PairCase::new(Kind::EdgeEdge, [u, v, k, l]).edge_edge().tetrahedron();
        let face = PairCase::new(Kind::VertexFace, [l, k, u, v]).vertex_face().tetrahedron();
        prop_assert_eq!((edges.b, edges.c, edges.p), (face.b, face.c, face.p));
    }
}

/// A control value as a sum of monomials of exact differences, and its permanent: the sum of their magnitudes.
struct ExactControlValue {
    value: Rational,
    permanent: Rational,
}

fn rational<S: Format>(x: S) -> Rational {
    Rational::from_f64(x.to_f64()).expect("finite")
}

/// In the order k₀, 3k₁, 3k₂, k₃, from the definition: the coefficient of (1−t)^(3−i)·t^i in det(P, B, C).
fn exact_control_values<S: Format>(pair: &PairCase<S>) -> [ExactControlValue; 4] {
    let order = match pair.kind {
        Kind::VertexFace => [1, 2, 3, 0],
        Kind::EdgeEdge => [2, 0, 1, 3],
    };
    let [a, b, c, p] = order.map(|k| pair.points[k].map(|position| position.map(rational)));
    let from_a = |x: &[[Rational; 3]; 2]| -> [[Rational; 3]; 2] {
        std::array::from_fn(|end| {
            std::array::from_fn(|axis| Rational::from(&x[end][axis] - &a[end][axis]))
        })
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
        for (axes, negative) in even
            .map(|axes| (axes, false))
            .into_iter()
            .chain(odd.map(|axes| (axes, true)))
        {
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

/// Half of the smallest subnormal: the most that a product loses by underflow.
fn lost_by_underflow<S: Format>() -> Rational {
    rational(S::exact(1, S::MIN_EXPONENT)) / 2_u32
}

/// (1 + u)^n − 1.
fn relative_error<S: Format>(roundings: u32) -> Rational {
    (Rational::from(1) + rational(S::UNIT_ROUNDOFF)).pow(roundings) - 1_u32
}

/// The largest magnitude of a component of P, as computed.
fn largest_p<S: Format>(tetrahedron: &MovingTetrahedron<S>) -> Rational {
    let components = tetrahedron.p.map(|p| [p.x, p.y, p.z]);
    let magnitudes = components.into_iter().flatten().map(|x| rational(x).abs());
    magnitudes.max().expect("six components")
}

/// What the filter computes and what is exact; nothing if it overflows.
struct Compared {
    computed: [Rational; 4],
    bounds: [Rational; 4],
    exact: [ExactControlValue; 4],
    largest_p: Rational,
}

fn compared<S: Format>(pair: &PairCase<S>) -> Result<Option<Compared>, TestCaseError> {
    let tetrahedron = pair.tetrahedron();
    let (computed, bounds) = (tetrahedron.control_values().0, tetrahedron.error_bounds());
    for (value, bound) in computed.into_iter().zip(bounds) {
        if !S::is_finite(bound) {
            return Ok(None);
        }
        prop_assert!(
            S::is_finite(value),
            "bound {bound} is finite, value {value} is not"
        );
    }
    Ok(Some(Compared {
        computed: computed.map(rational),
        bounds: bounds.map(rational),
        exact: exact_control_values(pair),
        largest_p: largest_p(&tetrahedron),
    }))
}

/// Each monomial passes through at most 8 roundings (k₀, k₃) or 10 (3k₁, 3k₂). Products that underflow lose η₀ each: two for
/// a component of n, four for one of h; once more through the last six additions at most.
fn control_values_are_off_by_no_more_than_their_roundings<S: Format>(
    pair: &PairCase<S>,
) -> Result<(), TestCaseError> {
    let Some(Compared {
        computed,
        exact,
        largest_p,
        ..
    }) = compared(pair)?
    else {
        return Ok(());
    };
    for (k, (computed, exact)) in computed.iter().zip(&exact).enumerate() {
        let outer = k == 0 || k == 3;
        let (roundings, per_p, alone) = if outer { (8, 6, 3) } else { (10, 18, 6) };
        let underflow = (Rational::from(&largest_p * per_p) + alone)
            * lost_by_underflow::<S>()
            * (relative_error::<S>(6) + 1_u32);
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

#[test]
fn control_values_are_off_by_no_more_than_their_roundings_f64() {
    check(
        20_000,
        pairs_of_any_kind::<f64>(),
        control_values_are_off_by_no_more_than_their_roundings,
    );
}

#[test]
fn control_values_are_off_by_no_more_than_their_roundings_f32() {
    check(
        20_000,
        pairs_of_any_kind::<f32>(),
        control_values_are_off_by_no_more_than_their_roundings,
    );
}

/// The promise that the filter stands on, for each of the four alone.
fn a_control_value_beyond_its_bound_has_the_exact_sign<S: Format>(
    pair: &PairCase<S>,
) -> Result<(), TestCaseError> {
    let Some(Compared {
        computed,
        bounds,
        exact,
        ..
    }) = compared(pair)?
    else {
        return Ok(());
    };
    for k in 0..4 {
        prop_assert!(
            computed[k] <= bounds[k] || exact[k].value > 0,
            "control value {k}"
        );
        prop_assert!(
            -computed[k].clone() <= bounds[k] || exact[k].value < 0,
            "control value {k}"
        );
    }
    Ok(())
}

#[test]
fn a_control_value_beyond_its_bound_has_the_exact_sign_f64() {
    check(
        40_000,
        pairs_of_any_kind::<f64>(),
        a_control_value_beyond_its_bound_has_the_exact_sign,
    );
}

#[test]
fn a_control_value_beyond_its_bound_has_the_exact_sign_f32() {
    check(
        40_000,
        pairs_of_any_kind::<f32>(),
        a_control_value_beyond_its_bound_has_the_exact_sign,
    );
}

/// Eᵢ = Cᵢ·P̂ᵢ + (p_max + 1)·η with C = 8u, 10u, but for the bound's own 13 roundings at most and what its
/// products lose by underflow, which is less than an eighth of the last term.
fn error_bounds_are_the_documented_ones<S: Format>(
    pair: &PairCase<S>,
) -> Result<(), TestCaseError> {
    let Some(Compared {
        bounds,
        exact,
        largest_p,
        ..
    }) = compared(pair)?
    else {
        return Ok(());
    };
    let eta = rational(S::UNDERFLOW);
    let slack = relative_error::<S>(13) + 1_u32;
    for (k, (bound, exact)) in bounds.iter().zip(&exact).enumerate() {
        let count = if k == 0 || k == 3 { 8_u32 } else { 10 };
        let relative = rational(S::UNIT_ROUNDOFF) * count * &exact.permanent;
        let absolute = (Rational::from(&largest_p) + 1_u32) * &eta;
        let documented = relative + &absolute;
        let lost = absolute / 8_u32;
        prop_assert!(
            *bound <= Rational::from(&documented * &slack) + &lost,
            "bound {k} is too large"
        );
        prop_assert!(
            *bound >= documented / &slack - &lost,
            "bound {k} is too small"
        );
    }
    Ok(())
}

#[test]
fn error_bounds_are_the_documented_ones_f64() {
    check(
        10_000,
        pairs_of_any_kind::<f64>(),
        error_bounds_are_the_documented_ones,
    );
}

#[test]
fn error_bounds_are_the_documented_ones_f32() {
    check(
        10_000,
        pairs_of_any_kind::<f32>(),
        error_bounds_are_the_documented_ones,
    );
}
