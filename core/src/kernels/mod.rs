//! What tests and proofs are made of, each written once: for one pair or for several side by side, and for verification's own numbers.

pub mod advance;
pub mod coplanarity;
pub mod exact;
pub mod lanes;
#[macro_use]
pub mod points;
pub mod vector;
