//! The laboratory: measures Selvedge and compares it with the methods published before it.
//!
//! **Nothing here is a promise.** Some of these methods are known to miss contacts, and stand here to show it. What is certified or
//! exact is in [`selvedge_core`] and [`selvedge`]; an engine links those and has no need of this crate.
//!
//! | module | what it is |
//! |---|---|
//! | [`baselines`] | published filters and elementary tests that may miss contacts |
//! | [`methods`] | the one table: every published method, and ours, by name, as a choice of stages |
//! | [`pipeline`] | **start here**: a method on one step after another, counted and timed |
//! | [`broad_phase`] | that of the published methods: pairs of triangles whose swept boxes overlap |
//! | [`queries`] | primitive-pair queries of the public continuous collision detection benchmark |
//! | [`scene`] | built-in motions: a sleeve on a bending arm; a figure that walks in a shirt |
//! | [`study`] | experiments: methods compared, cost against size, benchmark queries, accuracy against time; data only |
//! | [`hard_cases`] | hard cases of the literature by name, with exact answers |
//! | [`report`] | what studies and simulations found, as tables, CSV, JSON, plots, pictures, pages and glTF |

pub mod baselines;
pub mod broad_phase;
pub mod hard_cases;
pub mod methods;
pub mod pipeline;
pub mod queries;
pub mod report;
pub mod scene;
pub mod study;
