//! The certified time of impact without its error bounds, as a baseline. **Not certified: it misses contacts.**
//!
//! Core's own source runs on numbers whose unit roundoff is declared to be zero. Every threshold that a computed value must
//! exceed to prove something is then zero, except for η, which covers underflow. A direction is never corrected for its error.
//! Nothing else differs. The difference in time is the cost of certification, and the difference in misses and late times is its
//! benefit; `selvedge accuracy` shows both.

use selvedge_core::altered::{self, Constants};
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::{PrimitivePair, Scalar};

/// Returns the time from which the pair is within the separation, as computed. **It may be too late, or miss a contact.**
///
/// ```
/// use selvedge_core::elementary::Limits;
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_laboratory::baselines::uncertified;
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let time = uncertified::time_of_impact(&pair, &Limits::default()).time().unwrap();
/// assert!((time - 0.5).abs() < 1e-9);
/// ```
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> Impact<S> {
    altered::time_of_impact::<NoRounding, S>(pair, limits)
}

/// Declares operations free of rounding.
struct NoRounding;

impl Constants for NoRounding {
    const IS_EXACT: bool = true;
}
