//! The exact oracle and the generator that `selvedge-core` and `selvedge` are checked with. This crate is never published.
//!
//! | module | contents |
//! |---|---|
//! | [`oracle`] | exact answers, from the definitions alone |
//! | [`campaign`] | long runs over many pairs, every claim checked by exact arithmetic |
//! | [`generator`] | inputs that are biased to what breaks floating-point geometry, for property tests and fuzz targets |
//! | [`minifloat`] | a number format of a few bits, in which every input of a grid can be tried |
//! | [`altered`] | the kernels of core with other constants in their error bounds |
//! | [`culling`] | the culling tests of core by name, one pair at a time |
//! | [`plain`] | the paper's filter as printed, which is not certified |

pub mod altered;
pub mod campaign;
pub mod culling;
pub mod generator;
pub mod minifloat;
pub mod oracle;
pub mod plain;

/// Runs the examples of the project's readme as tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
