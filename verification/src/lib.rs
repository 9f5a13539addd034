//! What `selvedge-core` and `selvedge` are checked against; never published.
//!
//! | module | what it is |
//! |---|---|
//! | [`oracle`] | exact answers, from the definitions alone |
//! | [`generator`] | inputs, biased to what breaks floating-point geometry; for property tests and fuzz targets |
//! | [`culling`] | core's culling tests by name, one pair at a time |

pub mod culling;
pub mod generator;
pub mod oracle;
