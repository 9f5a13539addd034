//! `f64` for the few pairs that `f32` leaves undecided.
//!
//! `f32` positions are `f64` positions, so the certified filter may be asked again with a unit roundoff that is 2²⁹ times
//! smaller. It is asked only where
//! that can help: not if two control values certainly have opposite signs, or all are zero.

use crate::coplanarity::Bound;
use crate::motion::PrimitivePair;
use crate::points::PairPoints;
use crate::scalar::Scalar;

/// The certified filter's decision with the bound by the permanent, in `f64`.
pub(super) fn culls<S: Scalar>(pair: &PrimitivePair<S>, separation: Option<S>) -> bool {
    let points = PairPoints::from(&pair.widened());
    let separation = separation.map(Scalar::to_f64);
    of_kind!(pair.kind, P => points.tetrahedron::<P>().decide::<P>(Bound::Permanent, separation).culled)
}
