//! Filters that cull a pair because its four points are never coplanar during the step.
//!
//! A [`Filter`] has a [`Tier`], which says how sharp it is, and a separation that culled pairs keep.
//!
//! | tier | arithmetic | what it culls |
//! |---|---|---|
//! | [`Tier::Permanent`] | floating point, with a certified error bound | almost all that [`Tier::Exact`] culls |
//! | [`Tier::Widened`] | the same, then `f64` where `f32` does not decide | more nearly coplanar pairs of `f32` positions |
//! | [`Tier::Exact`] | the same, then integers where it does not decide | every pair whose exact control values have one sign |

pub mod certified;
mod tier;
mod widened;

pub use tier::{Filter, Tier};
