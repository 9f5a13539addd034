//! What `selvedge-core` and `selvedge` are checked against; never published.
//!
//! | module | what it is |
//! |---|---|
//! | [`oracle`] | exact answers, from the definitions alone |
//! | [`campaign`] | long runs over many pairs, every claim checked by exact arithmetic |
//! | [`generator`] | inputs, biased to what breaks floating-point geometry; for property tests and fuzz targets |
//! | [`hard_cases`] | the hard cases of the literature, by name |
//! | [`minifloat`] | a number format of a few bits, in which every input of a grid can be tried |
//! | [`altered`] | core's kernels with other constants in their error bounds |
//! | [`culling`] | core's culling tests by name, one pair at a time |

pub mod altered;
pub mod campaign;
pub mod culling;
pub mod generator;
pub mod hard_cases;
pub mod minifloat;
pub mod oracle;

/// The examples of the project's readme are tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
