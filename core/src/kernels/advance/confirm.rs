//! Proofs in floating point that a contact happens.
//!
//! Drop one axis. Let the projected polygon of the pair's corners strictly contain the origin throughout an interval of time.
//! Then the line through the origin along that axis meets the hull of the corners in one point of continuous height. The height
//! is K/n. K is the signed volume of the first three corners. n, the dropped component of their normal, keeps its sign because
//! the polygon keeps its orientation. So if K certainly has opposite signs at the ends of the interval, the height is zero
//! somewhere in between. There the hull contains the origin, and the sets touch.
//!
//! The polygon turns around the origin if the cross products of consecutive corners all have one sign. (Four turns of less than
//! half a circle each, in one sense, make one full turn, not two.) Each is quadratic in time; its Bernstein coefficients on the
//! interval are c₀×d₀, ½(c₀×d₁ + c₁×d₀), c₁×d₁.
//!
//! # Rounding
//! ε and M are those of the corners (`corners.rs`). A monomial of a coefficient passes through 4 roundings in each of the
//! corners, product, difference, and one sum in the middle: 11ε ≤ 22u in any direction, of a magnitude of 2·M_x·M_y. The bound is
//! 40u·2M_xM_y + η(1 + M)². K at a time is within the error of its control values on the rest of the step, which covers
//! (`volume.rs`) as many roundings. Underflow: 6λ in each component of a corner enters with a factor of M four times, products
//! and sums add 7λ at most, less than η(1 + M)².
//!
//! This cannot confirm contact at the very ends of the step, touching without passing through, and coplanar motion.

use super::corners::Corners;
use super::volume::SignedVolume;
use crate::PairKind;
use crate::lanes::{Lanes, Number, Rounding, roundoffs};
use crate::motion::PrimitivePair;
use crate::points::PairPoints;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The number of intervals that are tried, each eight times as long as the one before.
const INTERVALS: u32 = 18;

/// Returns an interval of time in [0, 1] in which the two sets certainly touch, if one around `near` can be proven. It is
/// certified, in every floating-point environment.
///
/// The best `near` is the time that [`time_of_impact`](crate::elementary::advance::time_of_impact) returns. `None` proves
/// nothing.
///
/// ```
/// use selvedge_core::elementary::{Limits, advance::{certain_contact, time_of_impact}};
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -2.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let time = time_of_impact(&pair, &Limits::default()).time().unwrap();
/// let [from, to] = certain_contact(&pair, time).unwrap();
/// assert!(from < 1.0 / 3.0 && 1.0 / 3.0 < to && to - from < 1e-8);
/// ```
#[must_use]
pub fn certain_contact<S: Scalar>(pair: &PrimitivePair<S>, near: S) -> Option<[S; 2]> {
    let points = PairPoints::from(pair);
    if !(points.is_finite() && near >= S::ZERO && near <= S::ONE) {
        return None;
    }
    match pair.kind {
        PairKind::VertexFace => prove(&Corners::of_vertex_face(&points), near),
        PairKind::EdgeEdge => prove(&Corners::of_edge_edge(&points), near),
    }
}

fn prove<S: Number, const N: usize>(corners: &Corners<S, N>, near: S) -> Option<[S; 2]> {
    if !corners.are_in_range() {
        return None;
    }
    let volume = SignedVolume::new(corners);
    let [from, to] = where_it_changes_sign(&volume, near)?;
    let (start, end) = (corners.at(from), corners.at(to));
    let [xy, yz, zx] = doubled_bounds(corners.extent);
    let contains = contains_origin(&start, &end, |v| [v.x, v.y], xy)
        || contains_origin(&start, &end, |v| [v.y, v.z], yz)
        || contains_origin(&start, &end, |v| [v.z, v.x], zx);
    contains.then_some([from, to])
}

/// Returns twice the bound of a coefficient, which the doubled middle one must exceed: for the projections to xy, yz and zx.
#[inline(always)]
#[must_use]
pub fn doubled_bounds<L: Lanes>(extent: Vector<L>) -> [L; 3] {
    let constant = |value| extent.x.splat(value);
    let size = constant(L::Scalar::ONE) + extent.largest();
    let underflow = constant(L::Scalar::UNDERFLOW) * (size * size);
    let bound = |x: L, y: L| roundoffs(x, 160) * (x * y) + constant(L::Scalar::small(2)) * underflow;
    [
        bound(extent.x, extent.y),
        bound(extent.y, extent.z),
        bound(extent.z, extent.x),
    ]
}

/// Returns the shortest of the tried intervals around `near` at whose ends the volume certainly has opposite signs.
fn where_it_changes_sign<S: Number>(volume: &SignedVolume<S>, near: S) -> Option<[S; 2]> {
    let (zero, one) = (S::ZERO, S::ONE);
    let mut reach = S::small(8) * S::UNIT_ROUNDOFF;
    for _ in 0..INTERVALS {
        let from = (near - reach).larger(zero);
        let to = (near + reach).smaller(one);
        if volume.has_opposite_signs_at(from, to) {
            return Some([from, to]);
        }
        if from <= zero && to >= one {
            return None;
        }
        reach = reach * S::small(8);
    }
    None
}

/// Returns whether the projected polygon of the corners certainly contains the origin while they move from `start` to `end`.
#[inline(always)]
#[must_use]
pub fn contains_origin<L: Lanes, const N: usize>(
    start: &[Vector<L>; N],
    end: &[Vector<L>; N],
    project: impl Fn(&Vector<L>) -> [L; 2],
    doubled_bound: L,
) -> L::Mask {
    let cross = |[a, b]: [L; 2], [c, d]: [L; 2]| a * d - b * c;
    let (zero, two) = (doubled_bound.splat(L::Scalar::ZERO), doubled_bound.splat(L::Scalar::small(2)));
    let nowhere = zero.greater(zero);
    let (mut all_left, mut all_right) = (!nowhere, !nowhere);
    let mut turn = |from: [&Vector<L>; 2], to: [&Vector<L>; 2]| {
        let ([c0, c1], [d0, d1]) = (from.map(&project), to.map(&project));
        for coefficient in [two * cross(c0, d0), cross(c0, d1) + cross(c1, d0), two * cross(c1, d1)] {
            all_left = all_left & coefficient.greater(doubled_bound);
            all_right = all_right & (-coefficient).greater(doubled_bound);
        }
    };
    // The turns go around the triangle, or around the parallelogram, whose second and third corner are opposite to each other.
    match (start.as_slice(), end.as_slice()) {
        ([a0, b0, c0], [a1, b1, c1]) => {
            turn([a0, a1], [b0, b1]);
            turn([b0, b1], [c0, c1]);
            turn([c0, c1], [a0, a1]);
        }
        ([a0, b0, c0, d0], [a1, b1, c1, d1]) => {
            turn([a0, a1], [b0, b1]);
            turn([b0, b1], [d0, d1]);
            turn([d0, d1], [c0, c1]);
            turn([c0, c1], [a0, a1]);
        }
        _ => return nowhere,
    }
    all_left | all_right
}

#[cfg(test)]
mod tests {
    use super::certain_contact;
    use crate::lanes::Rounding;
    use crate::{Motion, PrimitivePair};
    use glam::DVec3;

    /// Makes a vertex that falls through the middle of a face with sides `a` and `b` in the plane z = 0. It crosses it at half of
    /// the step.
    fn fall(a: f64, b: f64, height: f64) -> PrimitivePair<f64> {
        let at = |z| DVec3::new(a / 4.0, b / 4.0, z);
        PrimitivePair::vertex_face(
            Motion::new(at(height), at(-height)),
            [DVec3::ZERO, a * DVec3::X, b * DVec3::Y].map(Motion::resting),
        )
    }

    #[test]
    fn nothing_is_proven_of_times_outside_of_the_step_or_without_numbers() {
        let mut early = fall(1.0, 1.0, 1.0);
        early.motions[0] = Motion::new(DVec3::new(0.25, 0.25, 1e-9), DVec3::new(0.25, 0.25, -1.0));
        assert!(certain_contact(&early, 1e-9).is_some());
        for wrong in [-1e-9, 1.0 + 1e-9, f64::NAN] {
            assert_eq!(certain_contact(&early, wrong), None, "{wrong}");
        }
        let mut broken = early;
        broken.motions[1].end.x = f64::NAN;
        assert_eq!(certain_contact(&broken, 1e-9), None);
    }

    /// The turns of the middle's three neighbours are a quarter of `a` times `b`; η(1 + M)² is all that counts beside them.
    #[test]
    fn a_face_so_small_that_underflow_could_turn_it_proves_nothing() {
        for height in [0.5, 1.0, 2.0] {
            let least = 4.0 * (1.0 + height) * (1.0 + height) * f64::UNDERFLOW;
            let a = 2.0_f64.powi(-500);
            let is_certain = |area: f64| certain_contact(&fall(a, area / a, height), 0.5).is_some();
            assert!(is_certain(1.02 * least), "{height}");
            assert!(!is_certain(0.98 * least), "{height}");
        }
    }
}
