//! The paper's non-coplanarity filter as printed, which ignores rounding. **It is not certified**: it culls a colliding pair now
//! and then.
//!
//! The campaigns run it to show that they find false culls.

use crate::generator::{Format, PairCase};
use selvedge_core::PairKind;

type Point<S> = [S; 3];

fn minus<S: Format>(a: Point<S>, b: Point<S>) -> Point<S> {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn plus<S: Format>(a: Point<S>, b: Point<S>) -> Point<S> {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

fn dot<S: Format>(a: Point<S>, b: Point<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<S: Format>([a, b, c]: Point<S>, [x, y, z]: Point<S>) -> Point<S> {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Returns whether A, B, 2C + F and 2D + E (Lv, He, Mi, equations 1 to 14), as computed, all have the same strict sign.
///
/// One deviation from the paper: the filter keeps a pair if a value, or the sum of their magnitudes, is not finite.
pub fn culls<S: Format>(case: &PairCase<S>) -> bool {
    // The paper's a, b, c and p; for two edges, its k, u, v and l.
    let order = match case.kind {
        PairKind::VertexFace => [1, 2, 3, 0],
        PairKind::EdgeEdge => [2, 0, 1, 3],
    };
    let [a, b, c, p] = order.map(|point| case.points[point]);
    let [normal_0, normal_1] = [0, 1].map(|end| cross(minus(b[end], a[end]), minus(c[end], a[end]))); // (12), (13)
    let [velocity_a, velocity_b, velocity_c] = [a, b, c].map(|[start, end]| minus(end, start)); // (11)
    let twisted = cross(minus(velocity_b, velocity_a), minus(velocity_c, velocity_a));
    let middle = minus(plus(normal_0, normal_1), twisted).map(|x| x * S::HALF); // (14)
    let [p0, p1] = [0, 1].map(|end| minus(p[end], a[end]));
    let twice = |x: S| x + x;
    let values = [
        dot(p0, normal_0),                          // A (1)
        dot(p1, normal_1),                          // B (1)
        twice(dot(p0, middle)) + dot(p1, normal_0), // 2C + F (2, 3)
        twice(dot(p1, middle)) + dot(p0, normal_1), // 2D + E (2, 3)
    ];
    let [a, b, c, d] = values.map(|value| value.abs());
    let sum = (a + b) + (c + d);
    S::is_finite(sum) && (values.iter().all(|&value| value > S::ZERO) || values.iter().all(|&value| value < S::ZERO))
}
