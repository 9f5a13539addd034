//! Two triangles with a common edge: a test that excludes contact beside it.
//!
//! Let e = u − v be the edge, and a and b the vectors from v to the opposite corners. Any point of the first triangle has a part
//! perpendicular to e: that of a times a weight in [0, 1], which is zero only on the edge. For the second triangle it is that of
//! b. A common point has both: s·a⊥ = t·b⊥. Where a⊥·b⊥ < 0, the product with a⊥ gives s = 0, and the one with b⊥ gives t = 0, so
//! the point is on the edge. So two triangles that are **wide open**, by more than a right angle, need no further test; flat ones
//! above all. Since a⊥·b⊥·(e·e) = (a·b)(e·e) − (a·e)(b·e), only a sign is needed.
//!
//! # Rounding
//! An operation errs by ε = 2u in any rounding direction. Each monomial passes through four differences, three operations of each
//! dot product, a product and a difference: 12. Their magnitudes add up to at most 2|a||b|(e·e) ≤ (a·a + b·b)(e·e), which is
//! computed in 13 roundings with its factor: 32u of that exceeds 24u.
//!
//! **Underflow.** With M the largest component, a difference is off by 3λ, a dot product by (18M + 5)λ, and the whole by (216M³ +
//! 60M² + 3)λ, where 2M³ ≤ M² + M⁴: less than 256λ(1 + M²)². η times (1 + a·a + b·b + e·e)² is added, and η ≥ 512λ. **Overflow.**
//! a·a + b·b + e·e must not exceed the square of [`Rounding::LARGEST_EDGE`]. NaN proves nothing.

use crate::lanes::Rounding;
use crate::scalar::Position;
use crate::vector::Vector;

/// Returns true if two triangles with a common edge open by more than a right angle, so that they certainly meet only at the
/// edge. The first two `points` are the ends of the edge, the others the opposite corners.
///
/// The result is certified, in every floating-point environment. False proves nothing.
///
/// ```
/// use selvedge_core::{glam::DVec3, separation::hinge::is_wide_open};
/// let beside = |x: f64, z: f64| is_wide_open([DVec3::ZERO, DVec3::Y, DVec3::new(1.0, 0.5, 0.0), DVec3::new(x, 0.5, z)]);
/// assert!(beside(-1.0, 0.0) && beside(-0.1, 1.0));
/// assert!(!beside(0.1, 1.0) && !beside(1.0, 0.0));
/// ```
#[inline]
#[must_use]
pub fn is_wide_open<P: Position>(points: [P; 4]) -> bool {
    let [v, u, a, b] = points.map(|point| Vector::from(point.into()));
    let (e, a, b) = (u - v, a - v, b - v);
    let (ee, squares) = (e.dot(e), a.dot(a) + b.dot(b));
    let size = P::Scalar::ONE + (squares + ee);
    let error = P::Scalar::small(32) * P::Scalar::UNIT_ROUNDOFF * (squares * ee) + P::Scalar::UNDERFLOW * (size * size);
    let across = a.dot(b) * ee - a.dot(e) * b.dot(e);
    across < -error && squares + ee <= P::Scalar::LARGEST_EDGE * P::Scalar::LARGEST_EDGE
}
