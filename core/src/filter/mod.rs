//! Filters that cull a pair because its four points are never coplanar during the step.
//!
//! [`Filter`] is the choice: how sure, how sharp, and how far apart the pair must stay.
//!
//! | tier | rounding | what it culls |
//! |---|---|---|
//! | [`Tier::MagnitudesByEdge`], [`Tier::MagnitudesByAxis`] | covered by cheap bounds | those that clear the bound |
//! | [`Tier::Permanent`] | covered by the sharpest bound | almost all that [`Tier::Exact`] does |
//! | [`Tier::Widened`] | covered: `f32`, and `f64` where that does not decide | more near coplanarity, for `f32` positions |
//! | [`Tier::Exact`] | none: integer arithmetic | all whose exact control values have one sign |
//! | [`Tier::Subdivided`] | covered | pairs whose step falls into parts that are each free of contact |
//!
//! [`inside`] is the other half of the cubic test, as a filter of its own: pairs that may become coplanar, but beside each other.

pub mod certified;
pub mod inside;
mod subdivided;
mod tier;
mod widened;

pub use subdivided::Depth;
pub use tier::{Filter, Tier};
