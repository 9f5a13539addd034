//! Where nothing rounds, the control values of the coplanarity cubic are those of the right polynomial. That rounding errors stay
//! within their bounds is proven (`gappa/coplanarity.g`).

use crate::support::determinant;
use crate::support::prelude::*;
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
