//! Measures Selvedge and compares it with the methods published before it.
//!
//! **Nothing here is a promise.** Some of these methods are known to miss contacts, and are here to show it. The certified and
//! exact methods are in [`selvedge_core`] and [`selvedge`]; an engine links those and does not need this crate.
//!
//! | module | what it is |
//! |---|---|
//! | [`baselines`] | published filters and elementary tests that may miss contacts |
//! | [`methods`] | the table of methods: every published one, and ours, by name, as a choice of stages |
//! | [`pipeline`] | **start here**: runs a method on one step after another, with counts and times |
//! | [`broad_phase`] | the broad phase of the published methods: pairs of triangles whose swept boxes overlap |
//! | [`queries`] | primitive-pair queries of the public continuous collision detection benchmark |
//! | [`scene`] | a built-in motion: a sleeve on a bending arm |
//! | [`study`] | experiments: methods compared, cost against size, benchmark queries, accuracy against time; they return data |
//! | [`hard_cases`] | hard cases of the literature by name, with exact answers |
//! | [`truths`] | the cloth simulation against laws with known answers |
//! | [`report`] | results of studies and simulations as tables, CSV, JSON, plots, pictures, pages and glTF |

#![allow(clippy::must_use_candidate, reason = "what reports and studies return is all that they do")]

pub mod baselines;
pub mod broad_phase;
pub mod hard_cases;
pub mod methods;
pub mod pipeline;
pub mod queries;
pub mod report;
pub mod scene;
pub mod study;
pub mod truths;
