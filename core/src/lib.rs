//! Which vertex–face and edge–edge pairs of deforming triangles can *not* meet during a time step.
//!
//! This crate looks at one primitive pair at a time: four points, each moving on a straight line from
//! its position at the start of a step (time 0) to its position at the end (time 1). It answers with a
//! [`Verdict`]: [`Culled`](Verdict::Culled) is a proof that the pair does not touch at any time in [0, 1],
//! [`Kept`](Verdict::Kept) says nothing. Positions are in any length unit of the caller's.
//!
//! ```
//! use selvedge_core::{filter, glam::DVec3, Motion, Verdict, VertexFace};
//!
//! // A vertex that falls from 2 to 1 above a resting triangle.
//! let pair = VertexFace {
//!     vertex: Motion::new(DVec3::new(0.2, 0.2, 2.0), DVec3::new(0.2, 0.2, 1.0)),
//!     face: [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
//! };
//! assert_eq!(filter::certified::non_coplanarity(&pair), Verdict::Culled);
//! ```
//!
//! # What is promised
//! * **Nothing in this crate can miss a contact**, but for what [`elementary::advance::uncertified`] measures. What decides is certified or exact: it covers its own rounding, and never culls
//!   a pair that touches at some time in [0, 1], whatever the input.
//! * That holds in every floating-point environment of IEEE 754 arithmetic that a thread may have switched to: any
//!   rounding direction, flush-to-zero, denormals-are-zero ([`Rounding`] says how). Verdicts may differ from one
//!   environment to another; none of them is wrong.
//! * NaN, infinite or overflowing input is always kept.
//! * No allocation, no `unsafe`, no panic, no dependence on `std`.
//!
//! # The rooms
//! | module | what it does | promise |
//! |---|---|---|
//! | [`motion`] | the two primitive pairs, in [`glam`] types | |
//! | [`coplanarity`] | the signed volume of four moving points, as a cubic in Bernstein form, and its rounding error | proven bound |
//! | [`exact`] | the signs of that cubic's control values, how they compare with a separation, and whether a pair touches, in whole numbers | exact |
//! | [`filter`] | culls pairs that are never coplanar, or never within a separation: a [`Filter`](filter::Filter) of some [`Tier`](filter::Tier) | certified or exact |
//! | [`batch`] | the tests of `boxes` and `filter`, and rounds of advancing, on sixteen pairs side by side, alone or from a mesh | the same verdicts, bit for bit; certified |
//! | [`boxes`] | swept boxes, segment against box, relative boxes, 18-DOPs | exact or certified |
//! | [`separation`] | how far a pair keeps apart, and for how long: for callers that follow the same pairs step by step | certified |
//! | [`narrowing`] | times and lengths in another format, rounded to the safe side | certified |
//! | [`features`], [`distribution`] | representative features of a triangle; a candidate triangle pair to its primitive pairs | each pair once |
//! | [`elementary`] | whether a pair touches; time of impact | exact; certified |
//!
//! # Words
//! The paper that this work starts from (Lv, He, Mi: *Improved Method in Lower Tailoring of Self-collision
//! Detection of Arm Cloth Simulation*) says *lower tailoring* for culling primitive pairs, *higher tailoring*
//! for the broad phase, *PCTP* for a candidate triangle pair and *basic intersection test* for the elementary
//! test. We use the field's words.
#![no_std]
#![forbid(unsafe_code)]

pub use glam;

pub mod batch;
pub mod boxes;
pub mod coplanarity;
pub mod distribution;
pub mod elementary;
pub mod exact;
pub mod features;
pub mod filter;
mod kind;
pub mod lanes;
pub mod motion;
pub mod narrowing;
pub mod points;
pub mod scalar;
pub mod separation;
pub mod vector;
mod verdict;

pub use features::{FeatureEdge, FeatureTriangle, Features};
pub use kind::{PairKind, ParsePairKindError};
pub use lanes::{Lanes, Rounding};
pub use motion::{EdgeEdge, Motion, PrimitivePair, VertexFace};
pub use scalar::{Position, Scalar};
pub use vector::Vector;
pub use verdict::Verdict;

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
