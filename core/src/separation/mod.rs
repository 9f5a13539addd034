//! Separations: lower bounds of the distance of two sets, and how long they hold. Callers that follow the same pairs from step to
//! step use them.
//!
//! | module | what it bounds | rounding |
//! |---|---|---|
//! | [`carried`] | the separation that a pair keeps if it is carried along rigidly | 3 errors of a gap, and 10⁻⁴ of the distance |
//! | [`gap`] | the distance along a direction, from below; the direction that a pair remembers | 64u of the largest coordinate, and 2⁻²⁰ for stored values |
//! | [`clearance`] | the distance that a pair keeps although its points stray from their expected motion | 64u of the largest coordinate and of the distance, 128u of the stray, in `f32` |
//! | [`closest`] | the closest points of a pair at rest | plain floating point: certifies nothing by itself |
//! | [`course`] | how far points may stray from their course, and whether they do | 64u of the largest coordinate, at most a hundredth of the room |
//! | [`geometry`] | the points, weights and normal of a contact | enclosed: 96u of the largest coordinate; a normal is certified by [`gap`] |
//! | [`hinge`] | whether neighbours can touch beside their common edge | 32u of products of squared lengths |
//! | [`truncation`] | how far each point may go so that the pair keeps its distance | decides nothing: the others certify its result |
//!
//! All are functions of values: the caller keeps the pairs and the results.

pub mod carried;
pub mod clearance;
pub mod closest;
pub mod course;
pub mod gap;
pub mod geometry;
pub mod hinge;
pub mod truncation;

use crate::lanes::{Lanes, Rounding};
use crate::scalar::{Position, Scalar};

/// Returns the largest magnitude of any coordinate, or zero without positions. It is infinite if a coordinate is NaN or infinite,
/// or if their sum is, so that nothing that depends on it is proven.
///
/// ```
/// use selvedge_core::{glam::DVec3, separation::largest_coordinate};
/// assert_eq!(largest_coordinate(&[DVec3::X, DVec3::new(0.5, -2.0, 0.0)]), 2.0);
/// assert_eq!(largest_coordinate(&[DVec3::X, DVec3::new(0.5, f64::NAN, 0.0)]), f64::INFINITY);
/// ```
#[inline]
#[must_use]
pub fn largest_coordinate<P: Position>(positions: &[P]) -> P::Scalar {
    let mut largest = P::Scalar::ZERO;
    let mut sum = P::Scalar::ZERO;
    for &position in positions {
        let [x, y, z]: [P::Scalar; 3] = position.into();
        let (x, y, z) = (x.abs(), y.abs(), z.abs());
        largest = x.larger(y).larger(z).larger(largest);
        // A maximum may drop NaN.
        sum = sum + ((x + y) + z);
    }
    if sum.is_finite() { largest } else { P::Scalar::INFINITY }
}
