//! The separation of a pair that is carried along rigidly, if it starts nearer than it should be.
//!
//! In a simulation each pair should keep a separation m. A pair that starts nearer must keep less, or no step could be made. It
//! keeps m_P = min(m, c·d − 3E) with c = 1 − 10⁻⁴. Here d is the [lower bound](super::gap::distance_from_below) of its distance
//! at the start along a direction w, and E the [error](GapError) of gaps between positions at both ends of the step, those of the
//! pair among them. Then both rigid motions are free:
//!
//! * **A translation.** The bound at the end, along the same w, exceeds m_P. *Proof.* Let no coordinate exceed B at either end. A
//!   translation rounds each coordinate once, by at most 2uB, so the exact gap along w changes by at most 2·3·1.01·2uB ≤ 12.2uB.
//!   The two computed gaps are off by 49uB each. So they differ by at most 110.2uB, which is less than 1.73E. Each bound rounds
//!   twice more, by shares of 2u, which 1 − c exceeds in both formats. ∎ Gaps along w are linear in time, so the pair keeps more
//!   than m_P throughout.
//! * **A turn by θ.** Halfway along the straight paths of its points, distances are cos(θ/2) of those at the start, the least of
//!   all times. [`LARGEST_TURN`] keeps cos(θ/2) ≥ 1 − θ²/8 above 1 − ½·10⁻⁴ > c. The rest of 1 − c, and 3E, cover the rounding of
//!   the turn.
//!
//! The first proof takes the *same* direction at both ends, in full precision. The direction of points at a distance d has an
//! error of about uB/d, which tilts a pair of size L by uBL/d. This is as good as any other direction, but two such directions
//! differ by that much. For pairs much longer than their distance that costs more than a share 1 − c of it.
//!
//! No guarantee of freedom depends on m_P: a step is certified with it. It ensures that a step in which all is carried along is
//! accepted, so that a search for a free motion ends. A pair with d ≤ 3E is [nearer than rounding can distinguish](is_too_near).

use super::gap::GapError;
use crate::scalar::Scalar;

/// The share c of a pair's distance that it keeps, if it starts nearer than its separation. The rest of 1 bounds what a pair may
/// lose in a step, and how far a body may turn in it: by 1.1 degrees.
const KEPT: f64 = 1.0 - 1e-4;
/// The largest turn of a body in a step, in radians, that leaves a carried pair its [separation](kept_when_carried).
pub const LARGEST_TURN: f64 = 1.99e-2;

/// Returns the separation that a pair keeps if it is carried along rigidly, at most `separation`. `distance` is the lower bound
/// of its distance at the start. All are lengths in the unit of the positions.
///
/// ```
/// use selvedge_core::separation::{carried::kept_when_carried, gap::GapError};
/// let error = GapError::from_largest_coordinate(1.0);
/// assert_eq!(kept_when_carried(1e-3, 5e-3, error), 1e-3);
/// let kept = kept_when_carried(1e-3, 5e-4, error);
/// assert!(kept < 5e-4 && kept > 0.9998 * 5e-4);
/// ```
#[inline]
#[must_use]
pub fn kept_when_carried<S: Scalar>(separation: S, distance: S, error: GapError<S>) -> S {
    let kept = S::from_f64(KEPT) * distance - lost(error);
    separation.smaller(kept.larger(S::ZERO))
}

/// Returns whether a pair with this lower bound of its distance is nearer than rounding can distinguish. Then it keeps no
/// distance if it is carried.
#[inline]
#[must_use]
#[expect(clippy::neg_cmp_op_on_partial_ord, reason = "a distance that is NaN is too near")]
pub fn is_too_near<S: Scalar>(distance: S, error: GapError<S>) -> bool {
    !(distance > lost(error))
}

/// Returns the length that a carried pair may lose to rounding.
#[inline(always)]
fn lost<S: Scalar>(error: GapError<S>) -> S {
    S::small(3) * error.length()
}
