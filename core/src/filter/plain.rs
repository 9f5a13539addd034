//! The paper's non-coplanarity filter as printed. **Not certified**: rounding can make it cull a colliding pair.
//!
//! Kept as the baseline that the presets `tang_2010` and `lv_2014` reproduce (Lv, He, Mi, equations 1 to 14; the
//! same filter as Tang, Manocha, Tong 2010). The plane's normal in the middle of the step comes from the velocities,
//! n̂ = (n₀ + n₁ − (v_b − v_a)×(v_c − v_a)) / 2, and the signs of A, B, 2C + F and 2D + E are taken as computed.
//! Prefer [`certified`](super::certified).

use crate::motion::PrimitivePair;
use crate::points::PairShape;
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// Culls `pair` if A, B, 2C + F and 2D + E, as computed, all have the same strict sign.
///
/// One deviation from the paper: where a value overflows the pair is kept.
#[inline(always)]
pub fn non_coplanarity<S: Scalar, P: PrimitivePair<S>>(pair: &P) -> Verdict {
    let points = pair.points();
    let [a0, b0, c0, p0] = P::Shape::volume_points(points.start);
    let [a1, b1, c1, p1] = P::Shape::volume_points(points.end);
    let half = S::from_f64(0.5);
    let two = S::small(2);

    let n0 = (b0 - a0).cross(c0 - a0); // (12)
    let n1 = (b1 - a1).cross(c1 - a1); // (13)
    let (velocity_a, velocity_b, velocity_c) = (a1 - a0, b1 - b0, c1 - c0); // (11)
    let middle =
        ((n0 + n1) - (velocity_b - velocity_a).cross(velocity_c - velocity_a)).scaled(half); // (14)
    let (p0, p1) = (p0 - a0, p1 - a1);
    let (a, b) = (p0.dot(n0), p1.dot(n1)); // (1)
    let (c, d) = (p0.dot(middle), p1.dot(middle)); // (2)
    let (e, f) = (p0.dot(n1), p1.dot(n0)); // (3)
    let values = [a, b, two * c + f, two * d + e];

    let positive = values.iter().all(|&value| value > S::ZERO);
    let negative = values.iter().all(|&value| value < S::ZERO);
    Verdict::culled_if((positive || negative) && values.iter().all(|value| value.is_finite()))
}
