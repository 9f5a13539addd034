//! The closest points of a pair at rest agree with a grid of points of both.

use crate::support::prelude::*;

fn point() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)
}

/// Returns the least distance over a grid of points of both sets.
fn on_a_grid(kind: PairKind, [p, q, r, s]: [DVec3; 4]) -> f64 {
    let mut least = f64::INFINITY;
    for i in 0..=40 {
        for j in 0..=40 {
            let (x, y) = (f64::from(i) / 40.0, f64::from(j) / 40.0);
            let way = match kind {
                PairKind::VertexFace if x + y > 1.0 => continue,
                PairKind::VertexFace => p - (q + (r - q) * x + (s - q) * y),
                PairKind::EdgeEdge => (p + (q - p) * x) - (r + (s - r) * y),
            };
            least = least.min(way.length());
        }
    }
    least
}

proptest! {
    #[test]
    fn no_point_of_a_grid_is_closer(points in prop::array::uniform4(point())) {
        for kind in PairKind::ALL {
            let closest = ClosestPoints::from_points(kind, points);
            let grid = on_a_grid(kind, points);
            prop_assert!(closest.distance() <= grid + 1e-12);
            prop_assert!(closest.distance() >= grid - 0.15);
            let sum: DVec3 = (0..4).map(|k| points[k] * closest.weights[k]).sum();
            prop_assert!((sum - closest.offset).length() < 1e-12);
        }
    }
}
