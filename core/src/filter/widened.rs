//! `f64` for the few pairs that `f32` leaves undecided.
//!
//! `f32` positions are `f64` positions, so the certified filter can decide again with a unit roundoff that is 2²⁹ times smaller.
//! It does so only where that can help: not where two control values certainly have opposite signs, and not where all are zero.

use crate::motion::PrimitivePair;
use crate::points::PairPoints;
use crate::scalar::Scalar;
use crate::separation_lanes::SeparationLanes;

/// Returns whether the certified filter culls the pair in `f64`.
pub(super) fn culls<S: Scalar>(pair: &PrimitivePair<S>, separation: S) -> bool {
    let points = PairPoints::from(&pair.widened());
    of_kind!(pair.kind, P => {
        let tetrahedron = points.tetrahedron::<P>();
        tetrahedron.decide::<P>(SeparationLanes::new(separation.to_f64(), 0.0)).culled
    })
}
