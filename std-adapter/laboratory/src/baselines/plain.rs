//! The paper's non-coplanarity filter as printed. **Not certified**: rounding can make it cull a colliding pair.
//!
//! The presets `tang_2010` and `lv_2014` reproduce this baseline. It is Lv, He, Mi, equations 1 to 14, and the same filter as
//! Tang, Manocha, Tong 2010. The plane's normal in the middle of the step comes from the velocities, n̂ = (n₀ + n₁ − (v_b −
//! v_a)×(v_c − v_a)) / 2. The signs of A, B, 2C + F and 2D + E count as computed. Prefer
//! [`certified`](selvedge_core::filter::certified).

use selvedge_core::batch::PointsTest;
use selvedge_core::kernels::coplanarity::ControlValues;
use selvedge_core::kernels::lanes::{Lanes, Rounding};
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::{PairPoints, PairShape};
use selvedge_core::{PrimitivePair, Scalar, Verdict};

/// Culls `pair` if A, B, 2C + F and 2D + E, as computed, all have the same strict sign.
///
/// The filter deviates from the paper in one point: if a value, or the sum of their magnitudes, overflows, the pair is kept.
#[inline(always)]
pub fn non_coplanarity<S: Scalar>(pair: &PrimitivePair<S>) -> Verdict {
    Verdict::culled_if(of_kind!(pair.kind, P => has_one_sign::<P, S>(&pair.into())))
}

/// The decision of [`non_coplanarity`] for batches: [`ByPoints`](selvedge_core::batch::ByPoints).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plain;

impl PointsTest for Plain {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes>(self, points: &PairPoints<L>) -> L::Mask {
        has_one_sign::<P, L>(points)
    }
}

/// Makes the decision of [`non_coplanarity`] on any number of lanes.
#[inline(always)]
pub fn has_one_sign<P: PairShape, L: Lanes>(points: &PairPoints<L>) -> L::Mask {
    let [a0, b0, c0, p0] = P::volume_points(points.start);
    let [a1, b1, c1, p1] = P::volume_points(points.end);
    let constant = |value| a0.x.splat(value);
    let half = constant(L::Scalar::HALF);
    let two = constant(L::Scalar::small(2));

    let n0 = (b0 - a0).cross(c0 - a0); // (12)
    let n1 = (b1 - a1).cross(c1 - a1); // (13)
    let (velocity_a, velocity_b, velocity_c) = (a1 - a0, b1 - b0, c1 - c0); // (11)
    let middle = ((n0 + n1) - (velocity_b - velocity_a).cross(velocity_c - velocity_a)).scaled(half); // (14)
    let (p0, p1) = (p0 - a0, p1 - a1);
    let (a, b) = (p0.dot(n0), p1.dot(n1)); // (1)
    let (c, d) = (p0.dot(middle), p1.dot(middle)); // (2)
    let (e, f) = (p0.dot(n1), p1.dot(n0)); // (3)
    let (c, d) = (two * c + f, two * d + e);

    // A sum is not finite if a term is not. It may overflow by itself, too.
    let sum = (a.abs() + b.abs()) + (c.abs() + d.abs());
    let finite = constant(L::Scalar::INFINITY).greater(sum);
    ControlValues([a, c, d, b]).one_sign_beyond([constant(L::Scalar::ZERO); 4]) & finite
}
