//! Converts times and lengths from one format to another, rounded to the safe side.
//!
//! Conversion cuts off digits, which is not a floating-point operation. So results do not depend on the thread's rounding
//! direction or on flushing. Order is preserved: of two numbers the smaller never becomes the larger. If a time is first in
//! `f64`, it is first, or at the same time, in `f32`. Only numbers below the normal range of `f32` become zero, or its smallest
//! normal number.

use crate::elementary::Limits;
use crate::scalar::Scalar;

/// Returns the same limits in `f64`. A subnormal separation becomes the smallest normal number, as in all tests.
#[inline]
#[must_use]
pub fn limits_in_f64<S: Scalar>(limits: &Limits<S>) -> Limits<f64> {
    Limits {
        tolerance: limits.tolerance.to_f64(),
        separation: limits.separation.raised_to_normal().to_f64(),
    }
}

/// Converts a time to another format, rounded down: by less than 2⁻²³ of it, or 2⁻¹²⁶. Order is preserved. `time` must not be
/// negative; NaN stays NaN.
#[inline]
#[must_use]
pub fn rounded_down<S: Scalar>(time: f64) -> S {
    S::truncated(time)
}

/// Converts a length or a time to another format, rounded up: by at most 2⁻²² of it, or 2⁻¹²⁶. Order is preserved. The result is
/// infinite if the format has no number so large. `value` must not be negative; NaN stays NaN.
///
/// ```
/// use selvedge_core::narrowing::{rounded_down, rounded_up};
/// assert!(f64::from(rounded_up::<f32>(0.1)) >= 0.1 && f64::from(rounded_down::<f32>(0.1)) <= 0.1);
/// ```
#[inline]
#[must_use]
pub fn rounded_up<S: Scalar>(value: f64) -> S {
    // A thread that flushes may treat a subnormal number as zero.
    let value = value.raised_to_normal();
    let below = S::truncated(value);
    if below.to_f64() < value {
        below.next_up().raised_to_normal()
    } else {
        below
    }
}
