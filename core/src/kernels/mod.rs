//! The building blocks of tests and proofs. Each is written once, for one pair, for several side by side, and for verification's
//! own number types.

#[macro_use]
pub mod points;

pub mod advance;
#[cfg(feature = "verification")]
pub mod altered;
pub mod coplanarity;
pub mod exact;
pub mod lanes;
pub mod vector;
