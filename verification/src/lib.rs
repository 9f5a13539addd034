//! The exact oracle and the generator that `selvedge-core` and `selvedge` are checked with. This crate is never published.
//!
//! | module | contents |
//! |---|---|
//! | [`oracle`] | exact answers, from the definitions alone |
//! | [`campaign`] | long runs over many pairs, every claim checked by exact arithmetic |
//! | [`conformance`] | the cases of the conformance suite |
//! | [`generator`] | inputs that are biased to what breaks floating-point geometry, for property tests and fuzz targets |
//! | [`altered`] | the kernels of core with other constants in their error bounds |
//! | [`culling`] | the culling tests of core by name, one pair at a time |
//! | [`witness`] | a checker of the proofs that come with a time of impact |
//! | [`plain`] | the paper's filter as printed, which is not certified |

#![allow(
    missing_docs,
    clippy::must_use_candidate,
    reason = "only this workspace calls it, and many names say all"
)]

pub mod altered;
pub mod campaign;
pub mod conformance;
pub mod culling;
pub mod generator;
pub mod oracle;
pub mod plain;
pub mod random;
pub mod witness;

/// Declares a module with tests in `f32` and in `f64` of a generic function, or of a property with a number of cases and a
/// strategy. The module has the function's name, or another one: `formats!(name is function(1_000, pairs_of_any_kind()))`.
#[macro_export]
macro_rules! formats {
    ($name:ident) => {
        $crate::formats!(@ $name, $name::<f32>(), $name::<f64>());
    };
    ($name:ident($cases:expr, $strategy:expr)) => {
        $crate::formats!($name is $name($cases, $strategy));
    };
    ($name:ident is $property:ident($cases:expr, $strategy:expr)) => {
        $crate::formats!(
            @ $name,
            $crate::generator::check($cases, $strategy, $property::<f32>),
            $crate::generator::check($cases, $strategy, $property::<f64>)
        );
    };
    (@ $name:ident, $in_f32:expr, $in_f64:expr) => {
        mod $name {
            use super::*;

            #[test]
            fn f32() {
                $in_f32;
            }

            #[test]
            fn f64() {
                $in_f64;
            }
        }
    };
}

/// Runs the examples of the project's readme as tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

/// Runs the tutorial's examples as tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/tutorials/rust.md")]
struct Tutorial;
