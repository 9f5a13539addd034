//! Additive continuous collision detection (Li, Kaufman, Jiang: Codimensional Incremental Potential Contact, 2021), as a
//! baseline. **Not certified**: it ignores rounding.
//!
//! No point of one set approaches the other faster than the sum of the two sets' largest speeds, without their common motion. The
//! distance less the separation, divided by that speed, is therefore a time that can be skipped. The method skips nine tenths of
//! it, again and again, until a tenth of the first gap is left.
//!
//! * The tolerance is that tenth. A pair whose gap shrinks to a tenth and grows again is a false alarm, and there are many.
//! * Distances are computed in plain floating point, without an error bound. At the scale of rounding a time may be too late.
//! * The number of rounds is inversely proportional to the first gap. The original does not limit it. Here [`ROUNDS`] is the
//!   limit, and the time reached is returned.
//!
//! This is written from the description. Each round computes positions from the time, instead of adding steps up.

use selvedge_core::elementary::{Impact, Reason};
use selvedge_core::kernels::advance::closest::closest;
use selvedge_core::kernels::advance::corners::Corners;
use selvedge_core::kernels::points::PairPoints;
use selvedge_core::kernels::vector::Vector;
use selvedge_core::{PairKind, PrimitivePair, Scalar};

/// The largest number of rounds.
pub const ROUNDS: u32 = 100_000;

/// Returns the time from which the pair may be within a tenth of its first gap beyond `separation`, in units of length. Rounding
/// can make it wrong: see the module.
///
/// NaN and infinite coordinates exclude nothing.
///
/// ```
/// use selvedge_laboratory::baselines::additive::time_of_impact;
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let time = time_of_impact(&pair, 0.0).time().unwrap();
/// assert!(0.45 < time && time < 0.5);
/// ```
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>, separation: S) -> Impact<S> {
    let points = PairPoints::from(pair);
    match pair.kind {
        PairKind::VertexFace => advance(&points, &Corners::of_vertex_face(&points), 1, separation),
        PairKind::EdgeEdge => advance(&points, &Corners::of_edge_edge(&points), 2, separation),
    }
}

#[inline(always)]
fn advance<S: Scalar, const N: usize>(
    points: &PairPoints<S>,
    corners: &Corners<S, N>,
    first_set: usize,
    separation: S,
) -> Impact<S> {
    let possible = |time, reason| Impact::Possible { time, reason };
    if !(points.is_finite() && separation >= S::ZERO) {
        return possible(S::ZERO, Reason::NotFinite);
    }
    let speed = approach_speed(points, first_set);
    let gap_at = |time: S| closest(&corners.at(time)).squared_distance.sqrt() - separation;
    let mut gap = gap_at(S::ZERO);
    let enough = gap * S::from_f64(0.1);
    let mut time = S::ZERO;
    for _ in 0..ROUNDS {
        if gap <= enough {
            return possible(time, Reason::WithinTolerance);
        }
        let later = time + S::from_f64(0.9) * gap / speed;
        if later > S::ONE {
            return Impact::Never;
        }
        if later > time {
            time = later;
            gap = gap_at(time);
        } else {
            return possible(time, Reason::WithinError);
        }
    }
    possible(time, Reason::LastResort)
}

/// Returns the sum of the largest speeds of a point of each set, without their mean motion.
#[inline(always)]
fn approach_speed<S: Scalar>(points: &PairPoints<S>, first_set: usize) -> S {
    let ([a0, b0, c0, d0], [a1, b1, c1, d1]) = (points.start, points.end);
    let motions = [a1 - a0, b1 - b0, c1 - c0, d1 - d0];
    let [a, b, c, d] = motions;
    let mean = ((a + b) + (c + d)).scaled(S::from_f64(0.25));
    let squared_speed = |motion: &Vector<S>| {
        let relative = *motion - mean;
        relative.dot(relative)
    };
    let mut fastest = [S::ZERO; 2];
    for (index, motion) in motions.iter().enumerate() {
        let [first, second] = &mut fastest;
        let fastest = if index < first_set { first } else { second };
        *fastest = squared_speed(motion).larger(*fastest);
    }
    let [first, second] = fastest;
    first.sqrt() + second.sqrt()
}
