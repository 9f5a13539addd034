//! Times and lengths from one format to another, rounded to the safe side.
//!
//! By cutting digits off, which rounds nothing and is no operation in floating point: the same numbers come out whatever direction the thread
//! rounds in and whether or not it flushes subnormal numbers, and of two numbers the smaller never becomes the larger. So what comes first in
//! `f64` comes first, or at the same time, in `f32`. Only what is below the normal numbers of `f32` becomes zero, or the smallest of them.

use crate::elementary::Limits;
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

/// A time in another format: not later, and by less than 2⁻²³ of it, or 2⁻¹²⁶, earlier; of two times the earlier is not later. Of what is not
/// negative; NaN stays NaN.
#[inline]
#[must_use]
pub fn rounded_down<S: Scalar>(time: f64) -> S {
    S::truncated(time)
}

/// A length, or a time, in another format: not less, and by no more than 2⁻²² of it, or 2⁻¹²⁶, more; of two lengths the shorter is not longer.
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
    let below = S::truncated(value);
    if below.to_f64() < value {
        below.next_up().raised_to_normal()
    } else {
        below
    }
}
