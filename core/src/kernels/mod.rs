//! The parts that the tests of pairs are built from. Each is written once, for one pair, for several side by side, and for number
//! types of other crates. The feature `kernels` makes them public: baselines and measurements compare with them, and proofs read
//! their operations. They follow the crate's version as all public items do.

#[macro_use]
pub mod points;

pub mod advance;
#[cfg(feature = "kernels")]
pub mod altered;
pub mod coplanarity;
pub mod exact;
pub mod gap;
pub mod lanes;
pub mod separation_lanes;
pub mod vector;

#[cfg(feature = "kernels")]
pub use crate::of_kind;
