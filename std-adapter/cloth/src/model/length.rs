//! Lengths of vectors, and the larger of two, in code that runs many times in a step.
//!
//! The lengths have the bits of glam's methods. Those take square roots from libm, which has no instruction for them on
//! WebAssembly.

use selvedge_core::glam::DVec3;

/// Returns the length of a vector.
#[inline(always)]
pub(crate) fn length(vector: DVec3) -> f64 {
    vector.length_squared().sqrt()
}

/// Returns the larger of two numbers, the second if one is NaN. `f64::max` is a call on WebAssembly.
#[inline(always)]
pub(crate) fn larger(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

/// Returns the vector, shortened to a length of `most` if it is longer.
#[inline(always)]
pub(crate) fn shortened(vector: DVec3, most: f64) -> DVec3 {
    let squared = vector.length_squared();
    if squared > most * most {
        most * (vector / squared.sqrt())
    } else {
        vector
    }
}

/// Turns a vector into the plane with this normal, of length one. A vector that is mostly along the normal keeps only its part in
/// the plane.
pub(crate) fn turned_into_plane(vector: DVec3, normal: DVec3) -> DVec3 {
    let within = vector - normal * vector.dot(normal);
    let (all, left) = (length(vector), length(within));
    if left > 0.5 * all { within * (all / left) } else { within }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_vector_that_turns_into_a_plane_keeps_its_length_and_lies_there(angle in -1.0..1.0_f64, size in 1e-3..1e3_f64) {
            let normal = DVec3::new(libm::sin(angle), 0.0, libm::cos(angle));
            let turned = turned_into_plane(DVec3::X * size, normal);
            prop_assert!((length(turned) - size).abs() < 1e-12 * size && turned.dot(normal).abs() < 1e-12 * size);
            prop_assert!(turned_into_plane(normal * size, normal).length() < 1e-12 * size);
        }

        #[test]
        fn the_larger_of_two_is_that_of_the_standard_library(one in prop::num::f64::NORMAL, other in prop::num::f64::NORMAL) {
            prop_assert_eq!(larger(one, other), one.max(other));
            prop_assert_eq!(larger(one, one), one);
            prop_assert_eq!(larger(f64::NAN, other), other);
        }

        #[test]
        fn lengths_have_the_bits_of_glam(
            [x, y, z] in prop::array::uniform3(prop_oneof![-1e3..1e3_f64, prop::num::f64::NORMAL]),
            most in 0.0..1e3_f64,
        ) {
            let vector = DVec3::new(x, y, z);
            prop_assert_eq!(length(vector).to_bits(), vector.length().to_bits());
            let bits = |vector: DVec3| vector.to_array().map(f64::to_bits);
            prop_assert_eq!(bits(shortened(vector, most)), bits(vector.clamp_length_max(most)));
        }
    }
}
