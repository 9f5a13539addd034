//! `f64` for the few pairs that `f32` leaves undecided.
//!
//! `f32` positions are `f64` positions, so the certified filter may be asked again with a unit roundoff that is 2²⁹ times
//! smaller. It is asked only where
//! that can help: not if two control values certainly have opposite signs, or all are zero.

use super::certified::{Bound, decide};
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The certified filter's decision with the bound by the permanent, in `f64`.
pub(super) fn culls<P: PairShape, S: Scalar>(points: &PairPoints<S>, separation: Option<S>) -> bool {
    let tetrahedron = widened(points).tetrahedron::<P>();
    let separation = separation.map(Scalar::to_f64);
    decide::<P, f64>(Bound::Permanent, &tetrahedron, separation).culled
}

/// The same points, exactly.
fn widened<S: Scalar>(points: &PairPoints<S>) -> PairPoints<f64> {
    let widened = |point: Vector<S>| Vector::new(point.x.to_f64(), point.y.to_f64(), point.z.to_f64());
    PairPoints {
        start: points.start.map(widened),
        end: points.end.map(widened),
    }
}
