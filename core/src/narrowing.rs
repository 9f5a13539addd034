//! Times and lengths from one format to another, rounded to the safe side.
//!
//! # Rounding
//! In any direction rounding to `f32` moves a normal number by at most 2⁻²³ of it. So if the number that a time is rounded to is later,
//! what is 2⁻²² of it earlier has one that is not; and what is 2⁻²² of a length more has one that is not less:
//!
//! ```text
//! (1 − 2⁻²²)(1 + 2⁻⁵²)(1 + 2⁻²³) ≤ 1        (1 + 2⁻²²)(1 − 2⁻⁵²)(1 − 2⁻²³) ≥ 1
//! ```
//!
//! Below 2⁻¹⁰⁰, where subnormal numbers of `f32` may be rounded by more or flushed, a time becomes zero and a length 2⁻¹⁰⁰. Beyond the
//! largest number a length becomes infinite.

use crate::elementary::Limits;
use crate::lanes::power_of_two_f64;
use crate::scalar::Scalar;

/// The same limits in `f64`. A subnormal separation counts as the smallest normal number, as in all tests.
#[inline]
#[must_use]
pub fn widened<S: Scalar>(limits: &Limits<S>) -> Limits<f64> {
    Limits {
        tolerance: limits.tolerance.to_f64(),
        separation: limits.separation.raised_to_normal().to_f64(),
    }
}

/// A time in another format: not later, in any direction of rounding, and by no more than 2⁻²¹ of it, or 2⁻¹⁰⁰, earlier. Of what is
/// neither negative nor more than 2¹²⁷; NaN stays NaN.
#[inline]
#[must_use]
pub fn rounded_down<S: Scalar>(time: f64) -> S {
    let nearest = S::from_f64(time);
    if nearest.to_f64() <= time {
        nearest
    } else if time < power_of_two_f64(-100) {
        S::ZERO
    } else {
        S::from_f64(time * (1.0 - power_of_two_f64(-22)))
    }
}

/// A length, or a time, in another format: not less, in any direction of rounding, and by no more than 2⁻²¹ of it, or 2⁻⁹⁹, more.
/// Infinite if the format has no number so large. Of what is not negative; NaN stays NaN.
///
/// ```
/// use selvedge_core::narrowing::{rounded_down, rounded_up};
/// assert!(f64::from(rounded_up::<f32>(0.1)) >= 0.1 && f64::from(rounded_down::<f32>(0.1)) <= 0.1);
/// ```
#[inline]
#[must_use]
pub fn rounded_up<S: Scalar>(value: f64) -> S {
    // What a thread takes for zero must not become zero.
    let value = value.raised_to_normal();
    let nearest = S::from_f64(value);
    if nearest.to_f64() >= value {
        return nearest;
    }
    let more = value * (1.0 + power_of_two_f64(-22));
    let least = power_of_two_f64(-100);
    let more = S::from_f64(if more < least { least } else { more });
    // Rounding towards zero stops at the largest number.
    if more.to_f64() < value { S::INFINITY } else { more }
}
