//! Lengths of vectors in code that runs many times in a step.
//!
//! The results have the bits of glam's methods. Those take square roots from libm, which has no instruction for them on
//! WebAssembly.

use selvedge_core::glam::DVec3;

/// Returns the length of a vector.
#[inline(always)]
pub(crate) fn length(vector: DVec3) -> f64 {
    vector.length_squared().sqrt()
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
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
