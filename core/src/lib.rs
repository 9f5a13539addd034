//! Which vertex–face and edge–edge pairs of deforming triangles can *not* meet during a time step.
//!
//! This crate looks at one primitive pair at a time: four points, each moving on a straight line from
//! its position at the start of a step (time 0) to its position at the end (time 1). It answers with a
//! [`Verdict`]: [`Culled`](Verdict::Culled) is a proof that the pair does not touch at any time in [0, 1],
//! [`Kept`](Verdict::Kept) says nothing. Positions are in any length unit of the caller's.
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
//! # What is promised
//! * **Nothing in this crate can miss a contact.** What decides is certified or exact: it covers its own rounding, and never culls a
//!   pair that touches at some time in [0, 1], whatever the input.
//! * That holds in every floating-point environment of IEEE 754 arithmetic that a thread may have switched to: any
//!   rounding direction, flush-to-zero, denormals-are-zero ([`Rounding`](lanes::Rounding) says how). Verdicts may differ from one
//!   environment to another; none of them is wrong.
//! * NaN, infinite or overflowing input is always kept.
//! * No allocation, no `unsafe`, no panic, no dependence on `std`.
//!
//! # The rooms
//! | module | what it does | promise |
//! |---|---|---|
//! | [`motion`] | the primitive pair, of either kind, in [`glam`] types | |
//! | [`filter`] | culls pairs that are never coplanar, or never within a separation: a [`Filter`](filter::Filter) of some [`Tier`](filter::Tier) | certified or exact |
//! | [`batch`] | the tests of `boxes` and `filter`, and rounds of advancing, on sixteen pairs side by side, alone or from a mesh | the same verdicts, bit for bit; certified |
//! | [`boxes`] | swept boxes, segment against box, relative boxes | exact or certified |
//! | [`separation`] | how far a pair keeps apart, and for how long: for callers that follow the same pairs step by step | certified |
//! | [`narrowing`] | times and lengths in another format, rounded to the safe side | certified |
//! | [`features`], [`distribution`] | representative features of a triangle; a candidate triangle pair to its primitive pairs | each pair once |
//! | [`elementary`] | whether a pair touches; time of impact | exact; certified |
//! | [`paths`] | time of impact where points move on arcs, with bodies that turn, or on several straight pieces | certified |
//!
//! # Features
//! They only add; a user of single pairs needs none of them.
//!
//! | feature | what it adds |
//! |---|---|
//! | `batch` | [`batch`], and boxes of a hierarchy ([`boxes::moving`]): what `selvedge` is built of. Its types name instruction sets by `fearless_simd`'s |
//! | `verification` | that, and the kernels themselves ([`coplanarity`], [`exact`], [`lanes`] and others, in a module of that name), for the project's laboratory and verification. Nothing is promised of them |
//!
//! # Words
//! The paper that this work starts from (Lv, He, Mi: *Improved Method in Lower Tailoring of Self-collision
//! Detection of Arm Cloth Simulation*) says *lower tailoring* for culling primitive pairs, *higher tailoring*
//! for the broad phase, *PCTP* for a candidate triangle pair and *basic intersection test* for the elementary
//! test. We use the field's words.
#![no_std]
#![forbid(unsafe_code)]
// What only they show is not used without the features, and links to it lead nowhere.
#![cfg_attr(
    not(feature = "verification"),
    allow(
        dead_code,
        unreachable_pub,
        unused_imports,
        rustdoc::broken_intra_doc_links,
        rustdoc::private_intra_doc_links
    )
)]

pub use glam;

#[macro_use]
mod kernels;

#[cfg(feature = "batch")]
pub mod batch;
pub mod boxes;
pub mod distribution;
pub mod elementary;
pub mod features;
pub mod filter;
mod kind;
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

use kernels::{coplanarity, exact, lanes, points, vector};

/// The kernels themselves, for the project's laboratory and verification. Nothing is promised of them.
#[cfg(feature = "verification")]
pub mod verification {
    pub use crate::kernels::{advance, coplanarity, exact, lanes, points, vector};
    pub use crate::of_kind;
}
#[cfg(not(feature = "verification"))]
use kernels as verification;

/// The readme's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
