//! The parts that the tests of pairs are built from. They follow the crate's version, as all public items do.
//!
//! Each is written once, for one pair, for several side by side, and for number types of other crates. Baselines and measurements
//! compare with them, and proofs read their operations. To decide a pair you need none of them: see [`filter`](crate::filter) and
//! [`elementary`](crate::elementary).
//!
//! | module | content |
//! |---|---|
//! | [`lanes`] | numbers, one or several side by side, and the assumptions on their rounding |
//! | [`vector`], [`points`] | vectors and four moving points of such numbers; and from a kind of pair to code for it |
//! | [`coplanarity`] | the signed volume of four moving points, its control values and error bounds |
//! | [`advance`] | the proofs of the time of impact: separating directions and clipped volumes |
//! | [`gap`] | gaps along a direction |
//! | [`exact`] | signs and verdicts in whole numbers |

#[macro_use]
pub mod points;

pub mod advance;
pub mod coplanarity;
pub mod exact;
pub mod gap;
pub mod lanes;
pub mod separation_lanes;
pub mod vector;

pub use crate::of_kind;
