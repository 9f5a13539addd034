//! The same steps without their error bounds. **Not certified: it misses contacts.** A baseline.
//!
//! Every bar that a computed value must exceed to prove something is zero here (but for η, which covers underflow), and nothing
//! else differs: so the difference in time, in misses and in times that are too late is what certification costs, and what it is
//! for. `selvedge accuracy` shows it.

use super::{advanced, raised};
use crate::elementary::{Impact, Limits};
use crate::motion::PrimitivePair;
use crate::scalar::Scalar;

/// From when on the pair is found within the separation, as computed. **May be too late, or miss a contact.**
///
/// ```
/// use selvedge_core::elementary::{Limits, advance::uncertified};
/// use selvedge_core::{glam::DVec3, Motion, VertexFace};
/// let pair = VertexFace {
///     vertex: Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)),
///     face: [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// };
/// let time = uncertified::time_of_impact(&pair, &Limits::default()).time().unwrap();
/// assert!((time - 0.5).abs() < 1e-9);
/// ```
#[inline]
pub fn time_of_impact<S: Scalar, P: PrimitivePair<S>>(pair: &P, limits: &Limits<S>) -> Impact<S> {
    advanced::<P::Shape, S, false>(&pair.points(), &raised(limits), [S::ZERO, S::ONE]).0
}
