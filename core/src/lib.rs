//! Certified culling of vertex–face and edge–edge pairs of deforming triangles for continuous collision detection.
//!
//! This crate works on one primitive pair at a time. Its four points move on straight lines from their positions at the start of
//! a step (time 0) to those at the end (time 1). Its tests return a [`Verdict`]. [`Culled`](Verdict::Culled) is a proof that the
//! pair does not touch at any time in [0, 1]; [`Kept`](Verdict::Kept) proves nothing. Positions are in any length unit.
//!
//! ```
//! use selvedge_core::{filter, glam::DVec3, Motion, Verdict, PrimitivePair};
//!
//! // A vertex that falls from 2 to 1 above a resting triangle.
//! let pair = PrimitivePair::vertex_face(
//!     Motion::new(DVec3::new(0.2, 0.2, 2.0), DVec3::new(0.2, 0.2, 1.0)),
//!     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
//! );
//! assert_eq!(filter::certified::non_coplanarity(&pair), Verdict::Culled);
//! ```
//!
//! # Guarantees
//! * **No function of this crate misses a contact.** Decisions are certified or exact: they cover their own rounding. They never
//!   cull a pair that touches at some time in [0, 1], for any input.
//! * That holds in every floating-point environment of IEEE 754 arithmetic: any rounding direction, flush-to-zero,
//!   denormals-are-zero (see [`Rounding`](lanes::Rounding)). Verdicts may differ between environments; none of them is wrong.
//! * A pair with NaN, infinite or overflowing coordinates is always kept.
//! * The crate has no allocation, no `unsafe`, no panic and no dependence on `std`.
//!
//! # Modules
//! | module | what it does | guarantee |
//! |---|---|---|
//! | [`motion`] | moving points and primitive pairs, in [`glam`] types | |
//! | [`filter`] | culls pairs that are never coplanar, or never within a separation: a [`Filter`](filter::Filter) of some [`Tier`](filter::Tier) | certified or exact |
//! | [`batch`] | the tests of `boxes` and `filter`, and rounds of advancing, on sixteen pairs of a mesh side by side | the same verdicts, bit for bit |
//! | [`boxes`] | swept boxes, segment against box, relative boxes | exact or certified |
//! | [`separation`] | how far a pair keeps apart, and for how long: for callers that follow pairs from step to step | certified |
//! | [`narrowing`] | times and lengths in another format, rounded to the safe side | certified |
//! | [`features`], [`distribution`] | representative features of a triangle; the primitive pairs of a candidate triangle pair | each pair once |
//! | [`elementary`] | whether a pair touches; its time of impact | exact; certified |
//! | [`paths`] | time of impact on arcs of rotating bodies and on several straight pieces | certified |
//! | [`kernels`], [`altered`] | the parts that the tests are built from; the same with other rounding constants | as each says |
//!
//! # Features
//! Features only add items. Code that tests single pairs needs none of them.
//!
//! | feature | what it adds |
//! |---|---|
//! | `batch` | [`batch`], and boxes of a hierarchy ([`boxes::moving`]): the basis of `selvedge`. Instruction sets are named by types of `fearless_simd` |
//!
//! # Terms
//! The paper behind this work is Lv, He, Mi: *Improved Method in Lower Tailoring of Self-collision Detection of Arm Cloth
//! Simulation*. It says *lower tailoring* for culling primitive pairs and *higher tailoring* for the broad phase. *PCTP* is a
//! candidate triangle pair, and *basic intersection test* the elementary test. This crate uses the terms of the field.
#![no_std]
#![forbid(unsafe_code)]

pub use glam;

#[macro_use]
pub mod kernels;

pub mod altered;
#[cfg(feature = "batch")]
pub mod batch;
pub mod boxes;
pub mod distribution;
pub mod elementary;
pub mod features;
pub mod filter;
mod kind;
#[cfg(feature = "batch")]
mod mask;
pub mod motion;
#[cfg(feature = "batch")]
pub mod narrowing;
pub mod paths;
pub mod scalar;
#[cfg(feature = "batch")]
pub mod separation;
mod verdict;

pub use features::{FeatureEdge, FeatureTriangle, Features};
pub use kind::{PairKind, ParsePairKindError};
pub use motion::{Motion, PrimitivePair};
pub use scalar::{Position, Scalar};
pub use verdict::Verdict;

use kernels::{coplanarity, exact, lanes, points, separation_lanes, vector};

/// Runs the readme's examples as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
