//! How far two sets keep apart, and for how long that can be relied on: for a caller that follows the same pairs step by step.
//!
//! | module | what it bounds | rounding |
//! |---|---|---|
//! | [`gap`] | the distance along a direction, from below; the direction that a pair remembers | 64u of the largest coordinate, and 2⁻²⁰ for what is stored |
//! | [`clearance`] | the distance that a pair keeps though its points stray from the motion that was looked at | 64u of the largest coordinate and of the distance, 128u of the stray, in `f32` |
//! | [`closest`] | the closest points of a pair at rest | plain floating point: certifies nothing by itself |
//! | [`course`] | how far points may stray from their course, and whether they have | 64u of the largest coordinate, no more than a hundredth of the room |
//! | [`geometry`] | where a pair meets: points, weights, normal | enclosed: 96u of the largest coordinate; a normal is certified by [`gap`] |
//! | [`hinge`] | whether neighbours can touch beside their common edge | 32u of products of squared lengths |
//! | [`truncation`] | how far each point may go for the pair to keep its distance | decides nothing: what it leads to is certified by the others |
//!
//! All are functions of values: the caller keeps the pairs, and what was found out about them.

pub mod clearance;
pub mod closest;
pub mod course;
pub mod gap;
pub mod geometry;
pub mod hinge;
pub mod truncation;

use crate::lanes::{Lanes, Rounding};
use crate::scalar::{Position, Scalar};

/// The largest magnitude of any coordinate; infinite if one of them is NaN or infinite, or their sum is, so that nothing that depends on it
/// is proven. Zero of no positions.
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
